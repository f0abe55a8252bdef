/* What the computer that a rank runs on has to offer, and settings that follow from it. */
#ifndef CORACLE_MACHINE_H
#define CORACLE_MACHINE_H
#include <mpi.h>
#include <stdbool.h>

typedef struct {
  bool shared; /* more ranks than cores where this rank may run */
  bool pinned; /* ...and that only because they were bound to the same cores: others on this computer are idle
                */
} Affinity;

/* Before MPI_Init: MPI gives its core away while it waits when ranks outnumber cores (Open MPI knows by
 * itself only when its mapper does), and a threaded BLAS runs one thread a rank unless OPENBLAS_NUM_THREADS
 * or OMP_NUM_THREADS says more. */
void AffinityEnvironment(void);
/* Before MPI_Init of a program that may run by itself.  If no launcher has started it, Open MPI forks no daemon for it and
 * makes no folder in /tmp, which would be the same one for all such processes, each removing it at its end. */
void AffinityAlone(void);
/* Collective over the job, after MPI_Init. */
void AffinityGet(MPI_Comm job, Affinity *share);
/* Says once for each role that its ranks are bound on top of others. */
void AffinityNotePinned(const char *role, int rank);
#endif
