/* What the fake participants agree on: every value that travels is a function of who it belongs to and of the
 * step, so that each side knows what it must receive.  Node ids and element ids are unique in the job. */
#ifndef TEST_ANALYTIC_H
#define TEST_ANALYTIC_H
#include "common/link/case_file.h"
#include "common/link/coracle.h"
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { STEPS = 7, REMESH_STEP = 3, ADAPT_STEP = 5 };

/* Step 2 is made twice, step 3 (where the solid's mesh changes) twice, step 6 three times. */
static inline int Redos(int step)
{
  return step == 2 || step == REMESH_STEP ? 1 : step == 6 ? 2 : 0;
}
static inline double StepSize(int step)
{
  return 0.1 / step;
} /* s */

/* --- the solid: rank 1 is empty ------------------------------------------------------------------------- */
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
  return rank == 1 ? 0 : 3 + remeshed;
}
static inline int ElementCount(int rank, int remeshed)
{
  return rank == 1 ? 0 : 2 + rank + remeshed;
}
static inline int FacetNode(int rank, int e, int i)
{
  return (e + 2 * i + rank) % 4;
}
static inline int ElementNode(int rank, int e, int i)
{
  return (2 * e + i + rank) % 4;
}

static inline double NodePosition(long long id, int c, int step)
{
  return 0.25 * (double)id + 10.0 * c + 0.001 * step;
}
/* Linear in time, so that the sum of midpoint values over any substeps is its exact mean. */
static inline double NodeVelocity(long long id, int c, double t)
{
  return sin((double)id) + c + (2.0 + c) * t;
}
static inline double NodeForce(long long id, int c, int step)
{
  return cos((double)id) * (1 + c) + step;
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
    for (int i = 0; i < 36; i++) (&k.implicit_inertia[0][0][0][0])[i] = 7.0 * id - i + step;
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

/* --- misbehaving on demand ------------------------------------------------------------------------------ */
typedef enum { FAULT_NONE, FAULT_KILL, FAULT_EXIT, FAULT_FINALIZE, FAULT_HANG, FAULT_NAN, FAULT_CLOSE } Fault;
static const char *const FAULT_WORDS[] = {"none", "kill", "exit", "finalize", "hang", "nan", "close", NULL};

/* Does what `fault` says; returns only for those that the caller must do himself. */
static inline void Misbehave(Fault fault)
{
  if (fault == FAULT_KILL) raise(SIGKILL);
  if (fault == FAULT_EXIT) exit(0);
  if (fault == FAULT_FINALIZE) {
    MPI_Finalize();
    exit(0);
  }
  while (fault == FAULT_HANG) pause();
}
#endif
