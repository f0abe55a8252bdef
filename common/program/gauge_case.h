/* Where a case has pressure gauges on solids, which all participants read: the solid checks them, the coupler moves them, the fluid has the pressure. */
#ifndef CORACLE_GAUGE_CASE_H
#define CORACLE_GAUGE_CASE_H
#include "common/link/case_file.h"

enum { CASE_GAUGES_MAX = 256 }; /* of a case */

/* Not collective: of fluid.probes[probe] the points at the start of the run, m: one of a solid_point; of a solid_line at the middles of as many equal
 * parts as it has points; none of another probe.  Their number, at most CASE_GAUGES_MAX. */
int CaseGauges(CoracleCase c, int probe, double point[][2]);
/* The key of such a probe, in a static buffer. */
const char *CaseGaugeKey(CoracleCase c, int probe);
#endif
