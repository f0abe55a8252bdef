/* All faults of a case at once: it is read again and again, each time without what was wrong before. */
#include "common/link/case_impl.h"
#include <stdlib.h>
#include <string.h>

void CaseFault(CaseFaults *faults, const char *key, const char *message)
{
  faults->stuck = faults->n == CASE_FAULTS;
  for (int i = 0; i < faults->n; i++) faults->stuck = faults->stuck || !strcmp(faults->key[i], key);
  if (!faults->stuck) {
    faults->key[faults->n] = strdup(key);
    faults->message[faults->n++] = strdup(message);
  }
  longjmp(faults->next, 1);
}

bool CaseExcused(Case c, const char *key)
{
  for (int i = 0; c->faults && i < c->faults->n; i++)
    if (!strcmp(c->faults->key[i], key)) return true;
  return false;
}

/* A scalar of a map goes, so that its default holds; lists and maps stay, for what is below them. */
void CaseFaultsApply(Case c)
{
  for (int i = 0; i < c->faults->n; i++) CaseTreeRemove(c->root, c->faults->key[i]);
}

bool CaseFaultless(Case c)
{
  return !c->faults || c->faults->n == 0;
}

/* One reading: true when it went through. */
static bool ReadOnce(int argc, char **argv, CaseReader read, void *context, CaseFaults *faults)
{
  static Case c; /* static: they outlive the jump */
  static char problem[CASE_MESSAGE];
  c = NULL;
  if (setjmp(faults->next)) {
    CaseClose(&c);
    return false;
  }
  if (CaseLoad(argc, argv, problem, &c)) CaseFault(faults, "", problem);
  c->faults = faults;
  CaseFaultsApply(c);
  read(c, context);
  c->faults = NULL;
  CaseClose(&c);
  return true;
}

int CaseCheck(int argc, char **argv, CaseReader read, void *context,
              void (*tell)(void *context, const char *message))
{
  static CaseFaults faults;
  faults.n = 0;
  faults.stuck = false;
  while (!ReadOnce(argc, argv, read, context, &faults) && !faults.stuck) {
  }
  for (int i = 0; i < faults.n; i++) {
    tell(context, faults.message[i]);
    free(faults.message[i]);
  }
  if (faults.stuck && faults.key[0][0]) tell(context, "(the rest can be checked when these are right)");
  for (int i = 0; i < faults.n; i++) free(faults.key[i]);
  return faults.n;
}

int CaseKeysOf(int argc, char **argv, CaseReader read, void *context,
               void (*fail)(void *context, const char *message), FILE *out)
{
  Case c;
  CaseOpen(argc, argv, fail, context, &c);
  c->listing = true;
  read(c, context);
  CaseListKeys(c, out);
  CaseClose(&c);
  return 0;
}
