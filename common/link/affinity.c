#include "common/link/affinity.h"
#include <dlfcn.h>
#include <mpi.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int LocalRanks(void)
{
  static const char *const NAMES[] = {"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS",
                                      "SLURM_NTASKS_PER_NODE"};
  for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; k++) {
    const char *value = getenv(NAMES[k]);
    if (value) return atoi(value);
  }
  return 0;
}

void AffinityEnvironment(void)
{
  if (LocalRanks() > sysconf(_SC_NPROCESSORS_ONLN)) setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
  if (getenv("OPENBLAS_NUM_THREADS") || getenv("OMP_NUM_THREADS")) return;
  /* the variable is read when the library is loaded, before main: tell a library that is here already, too */
  setenv("OPENBLAS_NUM_THREADS", "1", 1);
  void *symbol = dlsym(RTLD_DEFAULT, "openblas_set_num_threads");
  void (*set_threads)(int);
  memcpy(&set_threads, &symbol, sizeof set_threads);
  if (set_threads) set_threads(1);
}

void AffinityAlone(void)
{
  if (LocalRanks() || getenv("PMIX_RANK") || getenv("PMI_RANK")) return;
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
}

static bool Within(const cpu_set_t *inner, const cpu_set_t *outer)
{
  cpu_set_t both;
  CPU_AND(&both, inner, outer);
  return CPU_EQUAL(&both, inner);
}

void AffinityGet(MPI_Comm job, Affinity *share)
{
  MPI_Comm node;
  cpu_set_t mine;
  int n, inside = 0;
  MPI_Comm_split_type(job, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  MPI_Comm_size(node, &n);
  CPU_ZERO(&mine);
  if (sched_getaffinity(0, sizeof mine, &mine)) memset(&mine, 0xff, sizeof mine);
  cpu_set_t *all = malloc((size_t)n * sizeof *all);
  MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all, sizeof mine, MPI_BYTE, node);
  for (int i = 0; i < n; i++) inside += Within(&all[i], &mine);
  free(all);
  MPI_Comm_free(&node);
  share->shared = inside > CPU_COUNT(&mine);
  share->pinned = share->shared && n <= sysconf(_SC_NPROCESSORS_ONLN);
}

void AffinityNotePinned(const char *role, int rank)
{
  if (rank) return;
  fprintf(
      stderr,
      "coracle: note: the %s is bound to cores that other ranks are bound to as well while cores are idle: "
      "start with --bind-to none\n",
      role);
}
