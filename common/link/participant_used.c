/* What a participant has used of processors and time, also in the runs that it resumes. */
#include "common/link/participant.h"
#include "common/link/resources.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>

static void UsedPath(const Participant *p, const char *folder, size_t size, char path[])
{
  snprintf(path, size, "%s/%s.seconds", folder, ROLE_NAMES[p->role]);
}

void ParticipantUsed(const Participant *p, double used[NUSED])
{
  const double now[NUSED] = {ProcessorSeconds(), WaitClock() - p->start, p->waiter.waited};
  for (int k = 0; k < NUSED; k++) used[k] = p->used[k] + now[k];
}

void ParticipantSaveUsed(Participant *p, const char *folder)
{
  char path[4200];
  double mine[NUSED], most[NUSED], cpu;
  ParticipantUsed(p, mine);
  MPI_Reduce(mine, most, NUSED, MPI_DOUBLE, MPI_MAX, 0, p->app);
  MPI_Reduce(&mine[USED_CPU], &cpu, 1, MPI_DOUBLE, MPI_SUM, 0, p->app);
  if (p->rank) return;
  UsedPath(p, folder, sizeof path, path);
  FILE *file = fopen(path, "w");
  if (file) fprintf(file, "%.17g %.17g %.17g\n", cpu, most[USED_WALL], most[USED_WAITING]);
  if (!file || fclose(file)) ParticipantFail(p, "%s: %s", path, strerror(errno));
}

void ParticipantLoadUsed(Participant *p, const char *folder)
{
  char path[4200];
  UsedPath(p, folder, sizeof path, path);
  FILE *file = fopen(path, "r");
  if (!file || fscanf(file, "%lf %lf %lf", &p->used[0], &p->used[1], &p->used[2]) != NUSED)
    ParticipantFail(p, "key 'resume': %s is no whole checkpoint: %s cannot be read", folder, path);
  fclose(file);
}
