/* Whether a word is a misspelling of another: for "did you mean ...?" */
#include "common/link/case_impl.h"
#include <string.h>

static int Least(int a, int b, int c)
{
  return a < b ? (a < c ? a : c) : (b < c ? b : c);
}

/* Restricted Damerau-Levenshtein distance by the usual table, three rows at a time. */
int CaseEditDistance(const char *a, const char *b, int limit)
{
  const int n = (int)strlen(a), m = (int)strlen(b);
  int row[3][CASE_NAME + 1];
  if (n > CASE_NAME || m > CASE_NAME || n - m > limit || m - n > limit) return limit + 1;
  for (int j = 0; j <= m; j++) row[0][j] = j;
  for (int i = 1; i <= n; i++) {
    int *now = row[i % 3], *last = row[(i + 2) % 3], *before = row[(i + 1) % 3];
    now[0] = i;
    for (int j = 1; j <= m; j++) {
      now[j] = Least(last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1]));
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && before[j - 2] + 1 < now[j])
        now[j] = before[j - 2] + 1;
    }
  }
  return row[n % 3][m] > limit ? limit + 1 : row[n % 3][m];
}

bool CaseSimilar(const char *a, const char *b)
{
  const size_t n = strlen(a);
  const int limit = n < 4 ? 1 : n < 8 ? 2 : 3;
  return CaseEditDistance(a, b, limit) <= limit && strcmp(a, b) != 0;
}
