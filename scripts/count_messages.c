/* What a program's ranks send, and what they compute outside of MPI: a library to preload (LD_PRELOAD), by MPI's profiling interface.
 * scripts/scaling.py builds and reads it.  In MPI_Finalize each rank appends to the file COUNT_MESSAGES the line
 *
 *     rank  cpu  messages  bytes  exchanged  exchanged_bytes  reductions  gathers
 *
 * rank: in MPI_COMM_WORLD;  cpu: s, of the processor outside of MPI, where polling ranks spend time, too;  messages, bytes: to ranks of the same
 * participant (of libraries, too);  exchanged: to other participants, over communicators as large as the world;  reductions: collective
 * calls whose data do not grow with the ranks (their latency grows with log2 of the ranks);  gathers: those whose data do. */
#include <fcntl.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

static double INSIDE; /* s of the processor within MPI */
static long MESSAGES[2], BYTES[2], REDUCTIONS, GATHERS;

/* Persistent requests and what one start of each sends. */
enum { MAX_PERSISTENT = 1 << 16 };
static struct {
  MPI_Request request;
  MPI_Comm comm;
  long bytes;
} PERSISTENT[MAX_PERSISTENT];

static double Cpu(void)
{
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void Sent(MPI_Comm comm, long bytes)
{
  int n, world;
  PMPI_Comm_size(comm, &n);
  PMPI_Comm_size(MPI_COMM_WORLD, &world);
  MESSAGES[n == world]++;
  BYTES[n == world] += bytes;
}

static long Bytes(int count, MPI_Datatype type)
{
  int size;
  PMPI_Type_size(type, &size);
  return (long)count * size;
}

/* The place of a request in the table, or of the first free place after its own. */
static size_t Place(MPI_Request request)
{
  size_t k = ((size_t)request >> 4) % MAX_PERSISTENT;
  for (size_t n = 0; n < MAX_PERSISTENT && PERSISTENT[k].request && PERSISTENT[k].request != request; n++)
    k = (k + 1) % MAX_PERSISTENT;
  return k;
}

static void Started(MPI_Request request)
{
  const size_t k = Place(request);
  if (PERSISTENT[k].request == request && PERSISTENT[k].comm) Sent(PERSISTENT[k].comm, PERSISTENT[k].bytes);
}

/* MPI_<name> with a clock around it, and `count` before. */
#define WRAP(name, parameters, arguments, count)                                                             \
  int MPI_##name parameters                                                                                  \
  {                                                                                                          \
    count;                                                                                                   \
    const double begin = Cpu();                                                                              \
    const int status = PMPI_##name arguments;                                                                \
    INSIDE += Cpu() - begin;                                                                                 \
    return status;                                                                                           \
  }

#define SEND (const void *b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c)
#define SENT Sent(c, Bytes(n, t))
WRAP(Send, SEND, (b, n, t, to, tag, c), SENT)
WRAP(Ssend, SEND, (b, n, t, to, tag, c), SENT)
#define ISEND (const void *b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c, MPI_Request *r)
WRAP(Isend, ISEND, (b, n, t, to, tag, c, r), SENT)
WRAP(Issend, ISEND, (b, n, t, to, tag, c, r), SENT)
WRAP(Recv, (void *b, int n, MPI_Datatype t, int from, int tag, MPI_Comm c, MPI_Status *s),
     (b, n, t, from, tag, c, s), )
WRAP(Irecv, (void *b, int n, MPI_Datatype t, int from, int tag, MPI_Comm c, MPI_Request *r),
     (b, n, t, from, tag, c, r), )
WRAP(Wait, (MPI_Request * r, MPI_Status *s), (r, s), )
WRAP(Waitall, (int n, MPI_Request r[], MPI_Status s[]), (n, r, s), )
WRAP(Waitany, (int n, MPI_Request r[], int *k, MPI_Status *s), (n, r, k, s), )
WRAP(Waitsome, (int n, MPI_Request r[], int *m, int k[], MPI_Status s[]), (n, r, m, k, s), )
WRAP(Test, (MPI_Request * r, int *done, MPI_Status *s), (r, done, s), )
WRAP(Testall, (int n, MPI_Request r[], int *done, MPI_Status s[]), (n, r, done, s), )
WRAP(Probe, (int from, int tag, MPI_Comm c, MPI_Status *s), (from, tag, c, s), )
WRAP(Iprobe, (int from, int tag, MPI_Comm c, int *there, MPI_Status *s), (from, tag, c, there, s), )
WRAP(Start, (MPI_Request * r), (r), Started(*r))
WRAP(Startall, (int n, MPI_Request r[]), (n, r), for (int k = 0; k < n; k++) Started(r[k]))

int MPI_Send_init ISEND
{
  const int status = PMPI_Send_init(b, n, t, to, tag, c, r);
  const size_t k = Place(*r);
  PERSISTENT[k].request = *r;
  PERSISTENT[k].comm = c;
  PERSISTENT[k].bytes = Bytes(n, t);
  return status;
}

/* A receive may have the handle of a send that was freed. */
int MPI_Recv_init(void *b, int n, MPI_Datatype t, int from, int tag, MPI_Comm c, MPI_Request *r)
{
  const int status = PMPI_Recv_init(b, n, t, from, tag, c, r);
  const size_t k = Place(*r);
  if (PERSISTENT[k].request == *r) PERSISTENT[k].comm = 0;
  return status;
}

#define PAIR const void *x, void *y
#define REDUCE (PAIR, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c)
#define REDUCED REDUCTIONS++
WRAP(Barrier, (MPI_Comm c), (c), REDUCED)
WRAP(Bcast, (void *b, int n, MPI_Datatype t, int root, MPI_Comm c), (b, n, t, root, c), REDUCED)
WRAP(Reduce, (PAIR, int n, MPI_Datatype t, MPI_Op o, int root, MPI_Comm c), (x, y, n, t, o, root, c), REDUCED)
WRAP(Allreduce, REDUCE, (x, y, n, t, o, c), REDUCED)
WRAP(Scan, REDUCE, (x, y, n, t, o, c), REDUCED)
WRAP(Exscan, REDUCE, (x, y, n, t, o, c), REDUCED)
WRAP(Reduce_scatter_block, REDUCE, (x, y, n, t, o, c), GATHERS++)
WRAP(Ibarrier, (MPI_Comm c, MPI_Request *r), (c, r), REDUCED)
WRAP(Iallreduce, (PAIR, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c, MPI_Request *r), (x, y, n, t, o, c, r),
     REDUCED)

#define BLOCKS (const void *x, int n, MPI_Datatype t, void *y, int m, MPI_Datatype u, MPI_Comm c)
WRAP(Allgather, BLOCKS, (x, n, t, y, m, u, c), GATHERS++)
WRAP(Alltoall, BLOCKS, (x, n, t, y, m, u, c), GATHERS++)
WRAP(Allgatherv,
     (const void *x, int n, MPI_Datatype t, void *y, const int m[], const int d[], MPI_Datatype u,
      MPI_Comm c),
     (x, n, t, y, m, d, u, c), GATHERS++)
WRAP(Alltoallv,
     (const void *x, const int n[], const int e[], MPI_Datatype t, void *y, const int m[], const int d[],
      MPI_Datatype u, MPI_Comm c),
     (x, n, e, t, y, m, d, u, c), GATHERS++)
WRAP(Gather, (const void *x, int n, MPI_Datatype t, void *y, int m, MPI_Datatype u, int root, MPI_Comm c),
     (x, n, t, y, m, u, root, c), GATHERS++)
WRAP(Gatherv,
     (const void *x, int n, MPI_Datatype t, void *y, const int m[], const int d[], MPI_Datatype u, int root,
      MPI_Comm c),
     (x, n, t, y, m, d, u, root, c), GATHERS++)
WRAP(Scatterv,
     (const void *x, const int n[], const int d[], MPI_Datatype t, void *y, int m, MPI_Datatype u, int root,
      MPI_Comm c),
     (x, n, d, t, y, m, u, root, c), GATHERS++)

int MPI_Finalize(void)
{
  const char *path = getenv("COUNT_MESSAGES");
  const int file = path ? open(path, O_WRONLY | O_CREAT | O_APPEND, 0666) : -1;
  char line[256];
  int rank;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const int n = snprintf(line, sizeof line, "%d %.9g %ld %ld %ld %ld %ld %ld\n", rank, Cpu() - INSIDE,
                         MESSAGES[0], BYTES[0], MESSAGES[1], BYTES[1], REDUCTIONS, GATHERS);
  if (file >= 0 && write(file, line, (size_t)n) != n) perror(path); /* short appends of ranks do not mix */
  if (file >= 0) close(file);
  return PMPI_Finalize();
}
