/* The loads on a body's boundaries, from the case. */
#include "solid/bodies/case_body.h"

/* The table at the key if its first item is a list (or, of one value, any item), of rows of time and n values; else one row of what is constant. */
static TimeTable ReadRows(CoracleCase c, const char *key, int n, double constant[3])
{
  char first[CASE_KEY];
  TimeTable table = {1, n + 1, constant};
  if (CoracleCaseHas(c, CaseKey(first, n > 1 ? "%s[0][0]" : "%s[0]", key)))
    table.row = CoracleCaseTable(c, key, n + 1, &table.nrows);
  else if (n > 1)
    CoracleCaseVector(c, key, n, constant + 1);
  else
    constant[1] = CoracleCaseNumber(c, key, -HUGE_VAL, HUGE_VAL);
  return table;
}

PetscErrorCode CaseReadLoads(CoracleCase c, int body, BodySetup *setup, CaseLoads *loads)
{
  char key[CASE_KEY], item[CASE_KEY], sub[CASE_KEY];
  PetscFunctionBeginUser;
  setup->nloads = CoracleCaseCount(c, BodyKey(key, body, "loads"));
  PetscCall(PetscCalloc2((size_t)setup->nloads, &loads->load, 2 * (size_t)setup->nloads, &loads->constant));
  for (int k = 0; k < setup->nloads; k++) {
    NamedLoad *load = &loads->load[k];
    (void)CaseKey(item, "%s[%d]", key, k);
    load->boundary = CoracleCaseString(c, CaseKey(sub, "%s.boundary", item));
    if (CoracleCaseHas(c, CaseKey(sub, "%s.pressure", item)))
      load->load.pressure = ReadRows(c, sub, 1, loads->constant[2 * k]);
    if (CoracleCaseHas(c, CaseKey(sub, "%s.traction", item)))
      load->load.traction = ReadRows(c, sub, 2, loads->constant[2 * k + 1]);
    if (!load->load.pressure.nrows && !load->load.traction.nrows && CoracleCaseFaultless(c))
      CoracleCaseRefuse(c, item, "expected a pressure or a traction");
  }
  setup->load = loads->load;
  PetscFunctionReturn(0);
}

PetscErrorCode CaseFreeLoads(CaseLoads *loads)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(loads->load, loads->constant));
  PetscFunctionReturn(0);
}
