/* summary.json, piece by piece, by one rank: what ran, and the numbers that its participants report.
 *
 *     {
 *       SummaryFileHead            the case, version, revision, mode
 *       SummaryFileField           a number; between head and participants
 *       SummaryFileParticipants    "participants": {"solid": {"elements": 54, ...}, ...}
 *     } */
#ifndef CORACLE_SUMMARY_FILE_H
#define CORACLE_SUMMARY_FILE_H
#include <stdio.h>

typedef struct {
  char role[32], key[64];
  double value;
} SummaryRow;

/* {0}: none yet. */
typedef struct {
  int n, capacity;
  SummaryRow *report; /* [n] */
} SummaryReports;

/* Adds a report (reports: SummaryReports; as ServerReports calls it). */
void SummaryReport(void *reports, const char *role, const char *key, double value);
void SummaryReportsFree(SummaryReports *reports);
void SummaryFileHead(FILE *file, const char *name, const char *note, const char *mode);
/* NaN and infinity become null. */
void SummaryFileField(FILE *file, const char *key, double value);
void SummaryFileParticipants(FILE *file, const SummaryReports *reports, int n, const char *const roles[]);
#endif
