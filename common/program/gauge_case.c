#include "common/program/gauge_case.h"
#include "common/link/case_key.h"

static bool IsLine(CoracleCase c, int probe)
{
  char key[CASE_KEY];
  return CoracleCaseHas(c, CaseKey(key, "fluid.probes[%d].solid_line", probe));
}

const char *CaseGaugeKey(CoracleCase c, int probe)
{
  static char key[CASE_KEY];
  return CaseKey(key, "fluid.probes[%d].%s", probe, IsLine(c, probe) ? "solid_line" : "solid_point");
}

int CaseGauges(CoracleCase c, int probe, double point[][2])
{
  double from[2], to[2];
  char key[CASE_KEY];
  if (!IsLine(c, probe)) return CoracleCaseVectorOptional(c, CaseGaugeKey(c, probe), 2, point[0]);
  const char *line = CaseGaugeKey(c, probe);
  CoracleCaseVector(c, CaseKey(key, "%s.from", line), 2, from);
  CoracleCaseVector(c, CaseKey(key, "%s.to", line), 2, to);
  if (from[0] == to[0] && from[1] == to[1])
    CoracleCaseRefuse(c, key, "expected another point than from, (%g, %g)", to[0], to[1]);
  const int n = CoracleCaseIntegerOr(c, CaseKey(key, "%s.points", line), 20, 2, CASE_GAUGES_MAX);
  for (int k = 0; k < 2 * n; k++)
    point[k / 2][k % 2] = from[k % 2] + (k / 2 + 0.5) / n * (to[k % 2] - from[k % 2]);
  return n;
}
