/* What the fake participants agree on: every value that travels is a function of who it belongs to and of the
 * step, so that each side knows what it must receive.  Node ids and element ids are unique in the job. */
#ifndef TEST_ANALYTIC_H
#define TEST_ANALYTIC_H
#include "common/link/case_file.h"
#include "common/link/coracle.h"
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { STEPS = 7, REMESH_STEP = 3, ADAPT_STEP = 5 };

#define REASON                                                                                               \
  "the test wants a shorter step" /* of one rank, in step 3 and 7 of the solid, in step 4 of the fluid */

/* Attempt 0 of step 4 is made by the fluid alone. */
static inline int FluidRejects(int step, int attempt)
{
  return step == 4 && attempt == 0;
}
static inline int SolidRejects(int step, int attempt)
{
  return (step == REMESH_STEP && attempt == 1) || (step == 7 && attempt == 0);
}
/* Step 2 is made twice, step 6 three times, and others as they are rejected. */
static inline int Redos(int step)
{
  return step == REMESH_STEP || step == 6 ? 2 : step == 2 || step == 4 || step == 7 ? 1 : 0;
}
static inline double StepSize(int step)
{
  return 0.1 / step;
} /* s */

/* The end of a step, s. */
static inline double StepEnd(int step)
{
  double t = 0.0;
  for (int k = 1; k <= step; k++) t += StepSize(k);
  return t;
}

/* --- the solid: rank 1 is empty, the others have a strip of triangles each ------------------------------- */
/*
 *       1---3---5        nodes 0, 2, ... below, 1, 3, ... above; element e has the nodes e, e + 1, e + 2;
 *      / \ / \ /         facets run around the strip: 0 -> 2 -> 4 -> 5 -> 3 -> 1 -> 0
 *     0---2---4
 */
static inline int NodeCount(int rank, int remeshed)
{
  return rank == 1 ? 0 : 4 + rank + 2 * remeshed;
}
static inline long long NodeId(int rank, int i)
{
  return 1000LL * rank + 7 * i + 3;
}
static inline int FacetCount(int rank, int remeshed)
{
  return NodeCount(rank, remeshed);
}
static inline int ElementCount(int rank, int remeshed)
{
  return rank == 1 ? 0 : NodeCount(rank, remeshed) - 2;
}
/* Node i of facet e of a strip of n nodes. */
static inline int FacetNode(int n, int e, int i)
{
  const int k = (e + i) % n, below = (n + 1) / 2;
  return k < below ? 2 * k : 2 * (n - k) - 1;
}
static inline int ElementNode(int e, int i)
{
  static const int TURN[2][3] = {{0, 2, 1}, {0, 1, 2}}; /* counter-clockwise */
  return e + TURN[e % 2][i];
}

/* Velocity linear in time, so that the sum of midpoint values over any substeps is its exact integral. */
static inline double NodeVelocity(long long id, int c, double t)
{
  return sin((double)id) + c + (2.0 + c) * t;
}
static inline double NodePosition(long long id, int c, double t)
{
  const int i = (int)(id % 1000 - 3) / 7;
  const double start = c ? 100.0 * (i % 2) : 100.0 * i + 10.0 * (double)(id / 1000);
  return start + t * NodeVelocity(id, c, 0.5 * t);
}
static inline double NodeForce(long long id, int c, int step)
{
  return cos((double)id) * (1 + c) + step;
}

/* Steps with films. */
static inline int HasFilm(int step)
{
  return step % 2 == 0 || step == REMESH_STEP;
}
/* Component k of load (0, 1) and resistance (2 .. 5). */
static inline double NodeFilm(long long id, int k, int step)
{
  return sin((double)id) * (2 + k) - step;
}

/* --- the fluid: rank 2 is empty ------------------------------------------------------------------------- */
static inline int CellCount(int rank, int adapted)
{
  return rank == 2 ? 0 : 5 + 2 * rank + 3 * adapted;
}
static inline int CellId(int rank, int i, int adapted)
{
  return 100 * rank + 3 * i + 50 * adapted;
}
static inline double CellDensity(int id)
{
  return 1000.0 + id;
}
static inline int CellOfDensity(double rho)
{
  return (int)lrint(rho - 1000.0);
}
static inline double CellViscosity(int id, int step)
{
  return 0.5 * id + 0.001 * step;
}
static inline double CellVertex(int id, int i, int c)
{
  return id + 0.1 * i + 0.01 * c;
}
static inline double CellFlow(int id, int field, int k, int step)
{
  return sin(id + 0.1 * k) + field + 0.5 * step;
}
static inline double CellProposal(int rank, int step)
{
  return 0.01 * (rank + 1) + 0.001 * step;
}
/* Coupled cells with an implicit inertia, in some steps none. */
static inline int CellHasInertia(int id, int step)
{
  return step % 2 == 0 && id % 3 == 0;
}
/* Not all cells are coupled. */
static inline int CellCoupled(int id)
{
  return id % 2 == 0;
}

static inline CoracleCoupling CellCoupling(int id, int step)
{
  CoracleCoupling k;
  double *value = &k.a[0][0][0][0];
  memset(&k, 0, sizeof k);
  for (int i = 0; i < 36; i++) value[i] = id + 0.01 * i + 1e-3 * step;
  if (CellHasInertia(id, step)) {
    k.flags = CORACLE_HAS_INERTIA;
    for (int i = 0; i < 9; i++) (&k.implicit_inertia[0][0])[i] = 7.0 * id - i + step;
    for (int i = 0; i < 4; i++) (&k.inertia_tensor[0][0])[i] = 0.25 * i + step;
    for (int i = 0; i < 4; i++) (&k.kept[0][0])[i] = 0.5 * i - step;
  }
  if (id % 5 == 0) k.flags |= CORACLE_HAS_SHELL;
  for (int i = 0; i < 2; i++) k.velocity[i] = 6.0 * id + i - step;
  for (int i = 0; i < 6; i++) {
    (&k.s[0][0])[i] = 2.0 * id + i + step;
    (&k.us[0][0])[i] = 4.0 * id + i + step;
  }
  for (int i = 0; i < 9; i++) (&k.ms[0][0])[i] = 3.0 * id + i + step;
  k.alpha = 1.0 / (1 + id);
  k.shell = 0.5 / (1 + id);
  return k;
}
static inline double CellCorrection(int id, int k, int step)
{
  return 5.0 * id + k + 0.5 * step;
}

/* --- the gauges: none until step 2, then as many as the step's number ------------------------------------- */
static inline int GaugeCount(int step)
{
  return step < 2 ? 0 : step;
}
static inline CoracleGauge GaugeAt(int i, int step)
{
  return (CoracleGauge){{10.0 * i + step, 20.0 * i - step}, {0.6 + i, 0.8 * step}};
}

/* --- misbehaving on demand ------------------------------------------------------------------------------ */
typedef enum {
  FAULT_NONE,
  FAULT_KILL,
  FAULT_EXIT,
  FAULT_FINALIZE,
  FAULT_HANG,
  FAULT_NAN,
  FAULT_CLOSE,
  FAULT_ORDER,     /* a call out of order */
  FAULT_CLOCKWISE, /* of the solid: an element, ... */
  FAULT_TWICE,
  FAULT_OPEN, /* a facet less than the boundary has */
  FAULT_TURNED,
  FAULT_IDS,
  FAULT_DRIFT,   /* positions that the velocities do not give */
  FAULT_MISSING, /* of the fluid: no pressure where it is needed */
  FAULT_SEGV,    /* signals */
  FAULT_BUS,
  FAULT_FPE,
  FAULT_TERM,
  FAULT_OVERFLOW, /* of the stack */
  FAULT_LOAD      /* of the solid: asks for the load of the pressure and changes its mesh */
} Fault;
static const char *const FAULT_WORDS[] = {
    "none",   "kill", "exit",  "finalize", "hang", "nan", "close", "order", "clockwise", "twice", "open",
    "turned", "ids",  "drift", "missing",  "segv", "bus", "fpe",   "term",  "overflow",  "load",  NULL};

/* --- a job that is not the whole world ------------------------------------------------------------------- */
/* With TEST_SPECTATOR set the participants split themselves from the world's other ranks first; the argument
 * `spectator` makes a program one of these. */
static inline MPI_Comm TestJob(int argc, char **argv)
{
  const int spectator = argc > 1 && !strcmp(argv[1], "spectator");
  MPI_Comm job;
  if (!getenv("TEST_SPECTATOR")) return MPI_COMM_NULL;
  MPI_Init(NULL, NULL);
  MPI_Comm_split(MPI_COMM_WORLD, spectator ? MPI_UNDEFINED : 0, 0, &job);
  if (!spectator) return job;
  MPI_Finalize();
  exit(0);
}
static inline int TestEnd(MPI_Comm *job)
{
  if (*job == MPI_COMM_NULL) return 0;
  MPI_Comm_free(job);
  return MPI_Finalize();
}

/* More of the stack than there is, 4 kB a level. */
static inline int Overflow(int levels)
{
  volatile char page[4096];
  page[levels % 4096] = 1;
  return levels ? Overflow(levels - 1) + page[levels % 4096] : 0;
}

/* Does what `fault` says; returns only for those that the caller must do himself. */
static inline void Misbehave(Fault fault)
{
  if (fault == FAULT_KILL) raise(SIGKILL);
  if (fault == FAULT_SEGV) raise(SIGSEGV);
  if (fault == FAULT_BUS) raise(SIGBUS);
  if (fault == FAULT_FPE) raise(SIGFPE);
  if (fault == FAULT_TERM) raise(SIGTERM);
  if (fault == FAULT_OVERFLOW) exit(Overflow(INT_MAX));
  if (fault == FAULT_EXIT) exit(0);
  if (fault == FAULT_FINALIZE) {
    MPI_Finalize();
    exit(0);
  }
  while (fault == FAULT_HANG) pause();
}
#endif
