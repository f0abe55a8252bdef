/* summary.json in the output folder: what ran, what it cost, and the case's numbers. */
#ifndef CORACLE_SUMMARY_H
#define CORACLE_SUMMARY_H
#include "common/link/server.h"
#include "coupler/output/writer.h"

/* Collective, after ServerFinish; coupler rank 0 writes.  A file that cannot be written ends the job. */
PetscErrorCode SummaryWrite(Server server, const CouplerCase *c, const WriterTotals *totals);
#endif
