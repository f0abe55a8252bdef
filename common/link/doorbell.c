#include "common/link/doorbell.h"
#include <linux/futex.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

/* Of one rank, in cache lines of its own. */
typedef struct {
  _Alignas(128) _Atomic uint32_t rings;
  _Atomic uint32_t asleep;
} Bell;

struct Doorbell_s {
  MPI_Comm node; /* the ranks of this computer */
  MPI_Win window;
  Bell *bell, *mine;
  int *place; /* [size of the job] a rank's bell, or MPI_UNDEFINED */
};

static void FindPlaces(MPI_Comm job, Doorbell d)
{
  MPI_Group all, here;
  int size;
  MPI_Comm_size(job, &size);
  MPI_Comm_group(job, &all);
  MPI_Comm_group(d->node, &here);
  int *rank = malloc((size_t)size * sizeof *rank);
  d->place = malloc((size_t)size * sizeof *d->place);
  for (int i = 0; i < size; i++) rank[i] = i;
  MPI_Group_translate_ranks(all, size, rank, here, d->place);
  free(rank);
  MPI_Group_free(&all);
  MPI_Group_free(&here);
}

int DoorbellOpen(MPI_Comm job, Doorbell *doorbell)
{
  Doorbell d = calloc(1, sizeof *d);
  int me, n, unit;
  char *memory;
  MPI_Aint bytes;
  MPI_Comm_split_type(job, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &d->node);
  MPI_Comm_rank(d->node, &me);
  MPI_Comm_size(d->node, &n);
  FindPlaces(job, d);
  bytes =
      me ? 0 : (MPI_Aint)((size_t)(n + 1) * sizeof(Bell)); /* one more: MPI may align the memory to less */
  MPI_Win_allocate_shared(bytes, 1, MPI_INFO_NULL, d->node, &memory, &d->window);
  MPI_Win_shared_query(d->window, 0, &bytes, &unit, &memory);
  const size_t beyond = (size_t)memory % sizeof(Bell); /* the same for all: pages are larger */
  d->bell = (Bell *)(void *)(beyond ? memory + sizeof(Bell) - beyond : memory);
  d->mine = &d->bell[me];
  atomic_init(&d->mine->rings, 0);
  atomic_init(&d->mine->asleep, 0);
  MPI_Barrier(d->node);
  *doorbell = d;
  return 0;
}

int DoorbellClose(Doorbell *doorbell)
{
  if (!*doorbell) return 0;
  MPI_Win_free(&(*doorbell)->window);
  MPI_Comm_free(&(*doorbell)->node);
  free((*doorbell)->place);
  free(*doorbell);
  *doorbell = NULL;
  return 0;
}

bool DoorbellReaches(Doorbell d, int rank)
{
  return d && d->place[rank] != MPI_UNDEFINED;
}

void DoorbellRing(Doorbell d, int rank)
{
  if (!DoorbellReaches(d, rank)) return;
  Bell *bell = &d->bell[d->place[rank]];
  atomic_fetch_add(&bell->rings, 1);
  if (atomic_load(&bell->asleep)) syscall(SYS_futex, &bell->rings, FUTEX_WAKE, 1, NULL, NULL, 0);
}

uint32_t DoorbellRings(Doorbell d)
{
  return atomic_load(&d->mine->rings);
}

void DoorbellSleep(Doorbell d, uint32_t rings, double seconds)
{
  const struct timespec span = {.tv_sec = (time_t)seconds, .tv_nsec = (long)(1e9 * fmod(seconds, 1.0))};
  atomic_store(&d->mine->asleep, 1);
  syscall(SYS_futex, &d->mine->rings, FUTEX_WAIT, rings, &span, NULL, 0);
  atomic_store(&d->mine->asleep, 0);
}
