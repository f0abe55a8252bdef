/* Which elements are in both meshes?  An element of either mesh is shown to a rank that its hash chooses (a
 * directory), where equal ones meet; the directory answers the old element's rank, which alone then knows
 * where its element goes. */
#include "common/transfer/match.h"
#include "common/transfer/transfer_impl.h"

typedef struct {
  double x[3][2];
  int rank, element;
} Entry;

/* To an old element: all 0 when it is in the old mesh only. */
enum { ANSWER_FOUND, ANSWER_RANK, ANSWER_TARGET, ANSWER_TURN, ANSWERS };

PetscErrorCode TransferElementsOf(const Mesh *mesh, TransferElements *elements)
{
  PetscFunctionBeginUser;
  elements->n = mesh->ne;
  PetscCall(PetscMalloc2(mesh->ne, &elements->element, mesh->ne, &elements->x));
  for (int e = 0; e < mesh->ne; e++) {
    elements->element[e] = e;
    MeshCorners(mesh, e, elements->x[e]);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode TransferElementsDestroy(TransferElements *elements)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(elements->element, elements->x));
  PetscFunctionReturn(0);
}

/* Keeps elements that are not unchanged. */
static void KeepChanged(TransferElements *elements, const char unchanged[])
{
  int n = 0;
  for (int e = 0; e < elements->n; e++) {
    if (unchanged[e]) continue;
    elements->element[n] = elements->element[e];
    for (int i = 0; i < 6; i++) elements->x[n][i / 2][i % 2] = elements->x[e][i / 2][i % 2];
    n++;
  }
  elements->n = n;
}

/* What of a mesh meets on this rank's part of the directory. */
static PetscErrorCode Show(MPI_Comm comm, const TransferElements *elements, Scatter *route, Entry **entry,
                           double (**x)[3][2])
{
  const int n = elements->n;
  int size, me, *rank, *source;
  Entry *shown;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCallMPI(MPI_Comm_rank(comm, &me));
  PetscCall(PetscMalloc3(n, &rank, n, &source, n, &shown));
  for (int e = 0; e < n; e++) {
    const double(*corner)[2] = (const double(*)[2])elements->x[e];
    rank[e] = (int)((MatchHash(corner) >> 32) % (uint64_t)size); /* tables in match.c use the low bits */
    source[e] = e;
    shown[e] = (Entry){.rank = me, .element = e};
    for (int i = 0; i < 6; i++) shown[e].x[i / 2][i % 2] = corner[i / 2][i % 2];
  }
  PetscCall(ScatterCreate(comm, n, rank, source, route));
  PetscCall(PetscMalloc2(ScatterArriving(*route), entry, ScatterArriving(*route), x));
  PetscCall(ScatterForward(*route, sizeof *shown, shown, *entry));
  for (int k = 0; k < ScatterArriving(*route); k++) {
    for (int i = 0; i < 6; i++) (*x)[k][i / 2][i % 2] = (*entry)[k].x[i / 2][i % 2];
  }
  PetscCall(PetscFree3(rank, source, shown));
  PetscFunctionReturn(0);
}

/* answer[old->n][ANSWERS] */
static PetscErrorCode Ask(MPI_Comm comm, const TransferElements *old, const TransferElements *new,
                          double answer[])
{
  Scatter from, to;
  Entry *entry_from, *entry_to;
  double(*x_from)[3][2], (*x_to)[3][2], *reply;
  int *match;
  PetscFunctionBeginUser;
  PetscCall(Show(comm, old, &from, &entry_from, &x_from));
  PetscCall(Show(comm, new, &to, &entry_to, &x_to));
  PetscCall(PetscMalloc1(ScatterArriving(to), &match));
  PetscCall(PetscCalloc1(ANSWERS * (size_t)ScatterArriving(from), &reply));
  PetscCall(MatchTriangles(ScatterArriving(from), (const double(*)[3][2])x_from, ScatterArriving(to),
                           (const double(*)[3][2])x_to, match));
  for (int k = 0; k < ScatterArriving(to); k++) {
    if (match[k] < 0) continue;
    double *r = &reply[ANSWERS * (size_t)(match[k] / 3)];
    r[ANSWER_FOUND] = 1.0;
    r[ANSWER_RANK] = entry_to[k].rank;
    r[ANSWER_TARGET] = entry_to[k].element;
    r[ANSWER_TURN] = match[k] % 3;
  }
  PetscCall(PetscArrayzero(answer, ANSWERS * (size_t)old->n));
  PetscCall(ScatterReverseAdd(from, ANSWERS, reply, answer));
  PetscCall(PetscFree(match));
  PetscCall(PetscFree(reply));
  PetscCall(PetscFree2(entry_from, x_from));
  PetscCall(PetscFree2(entry_to, x_to));
  PetscCall(ScatterDestroy(&from));
  PetscCall(ScatterDestroy(&to));
  PetscFunctionReturn(0);
}

/* Unchanged elements go to the ranks that the answers name. */
static PetscErrorCode MakeCopies(Transfer t, int n, const double answer[], char unchanged[])
{
  TransferCopy *sent;
  int *rank, *source, m = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(n, &rank, n, &source, n, &sent));
  for (int e = 0; e < n; e++) {
    const double *a = &answer[ANSWERS * (size_t)e];
    unchanged[e] = a[ANSWER_FOUND] > 0.0;
    sent[e] = (TransferCopy){(int)a[ANSWER_TARGET], (int)a[ANSWER_TURN]};
    if (!unchanged[e]) continue;
    rank[m] = (int)a[ANSWER_RANK];
    source[m++] = e;
  }
  PetscCall(ScatterCreate(t->comm, m, rank, source, &t->copy_scatter));
  t->ncopies = ScatterArriving(t->copy_scatter);
  PetscCall(PetscMalloc1(t->ncopies, &t->copy));
  PetscCall(ScatterForward(t->copy_scatter, sizeof *sent, sent, t->copy));
  PetscCall(PetscFree3(rank, source, sent));
  PetscFunctionReturn(0);
}

PetscErrorCode TransferMatch(Transfer t, TransferElements *old)
{
  double *answer;
  char *unchanged;
  PetscFunctionBeginUser;
  PetscCall(TransferElementsOf(t->from, old));
  PetscCall(TransferElementsOf(t->to, &t->changed));
  PetscCall(PetscMalloc1(ANSWERS * (size_t)old->n, &answer));
  PetscCall(PetscCalloc1(PetscMax(old->n, t->changed.n), &unchanged));
  PetscCall(Ask(t->comm, old, &t->changed, answer));
  PetscCall(MakeCopies(t, old->n, answer, unchanged));
  KeepChanged(old, unchanged);
  PetscCall(PetscArrayzero(unchanged, t->changed.n));
  for (int k = 0; k < t->ncopies; k++) unchanged[t->copy[k].target] = 1;
  KeepChanged(&t->changed, unchanged);
  PetscCall(PetscFree(answer));
  PetscCall(PetscFree(unchanged));
  PetscFunctionReturn(0);
}
