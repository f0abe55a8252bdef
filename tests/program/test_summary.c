/* summary.json has all reports, however many a participant makes, and stays JSON whatever their names are. */
#include "common/program/summary_file.h"
#include "tests/check.h"
#include <string.h>

enum { MANY = 1000 };

int main(void)
{
  static const char *const ROLES[] = {"solid"};
  static char text[100000], key[64];
  SummaryReports reports = {0};
  for (int k = 0; k < MANY; k++) {
    snprintf(key, sizeof key, "key %d", k);
    SummaryReport(&reports, "solid", key, k);
  }
  SummaryReport(&reports, "solid", "a \"word\"", 1.0);
  FILE *f = tmpfile();
  CHECK(f, "no file");
  SummaryFileParticipants(f, &reports, 1, ROLES);
  rewind(f);
  text[fread(text, 1, sizeof text - 1, f)] = 0;
  fclose(f);
  for (int k = 0; k < MANY; k++) {
    snprintf(key, sizeof key, "\"key %d\": %d", k, k);
    CHECK(strstr(text, key), "not in the file: %s", key);
  }
  CHECK(strstr(text, "\"a \\\"word\\\"\": 1}"), "%s", text);
  SummaryReportsFree(&reports);
  CHECK(!reports.n && !reports.report, "not freed");
  return 0;
}
