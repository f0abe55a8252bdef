#include "fluid/adapt/adapt_impl.h"

static PetscErrorCode GrowVertices(Adapt *a)
{
  const size_t n = (size_t)a->nv + (size_t)a->nv / 2 + 64;
  PetscFunctionBeginUser;
  PetscCall(PetscRealloc(2 * n * sizeof(double), &a->x));
  PetscCall(PetscRealloc(3 * n * sizeof(double), &a->metric));
  PetscCall(PetscRealloc(n * sizeof(int), &a->corner));
  PetscCall(PetscRealloc(n * sizeof(int), &a->home));
  PetscCall(PetscRealloc(n * sizeof(int), &a->origin));
  PetscCall(PetscRealloc(n * sizeof(int), &a->stamp));
  PetscCall(PetscRealloc(n, &a->kind));
  a->max_v = (int)n;
  PetscFunctionReturn(0);
}

static PetscErrorCode GrowTriangles(Adapt *a)
{
  const size_t n = (size_t)a->ne + (size_t)a->ne / 2 + 128;
  PetscFunctionBeginUser;
  PetscCall(PetscRealloc(3 * n * sizeof(int), &a->vertex));
  PetscCall(PetscRealloc(3 * n * sizeof(int), &a->across));
  PetscCall(PetscRealloc(3 * n * sizeof(int), &a->mark));
  PetscCall(PetscRealloc(n * sizeof(int), &a->region));
  a->max_e = (int)n;
  PetscFunctionReturn(0);
}

PetscErrorCode AdaptReserve(Adapt *a)
{
  PetscFunctionBeginUser;
  if (a->nv + 1 > a->max_v) PetscCall(GrowVertices(a));
  if (a->ne + 2 > a->max_e) PetscCall(GrowTriangles(a));
  PetscFunctionReturn(0);
}

int AdaptNewVertex(Adapt *a)
{
  const int v = a->dead_v;
  if (v == NONE) return a->nv++;
  a->dead_v = a->home[v];
  return v;
}

int AdaptNewTriangle(Adapt *a)
{
  const int e = a->dead_e;
  if (e == NONE) return a->ne++;
  a->dead_e = a->vertex[3 * e + 1];
  return e;
}

void AdaptKillVertex(Adapt *a, int v)
{
  a->corner[v] = NONE;
  a->home[v] = a->dead_v;
  a->dead_v = v;
}

void AdaptKillTriangle(Adapt *a, int e)
{
  a->vertex[3 * e] = NONE;
  a->vertex[3 * e + 1] = a->dead_e;
  a->dead_e = e;
}

void AdaptSetTriangle(Adapt *a, int e, int p, int q, int r)
{
  const int v[3] = {p, q, r};
  for (int i = 0; i < 3; i++) {
    a->vertex[3 * e + i] = v[i];
    a->corner[v[i]] = 3 * e + i;
    a->stamp[v[i]] = a->tick;
  }
}

void AdaptJoin(Adapt *a, int c, int d, int mark)
{
  a->across[c] = d;
  a->mark[c] = mark;
  if (d == NONE) return;
  a->across[d] = c;
  a->mark[d] = mark;
}

/* Corners of the triangles around a vertex from `first` on, counter-clockwise; false if there are too many.
 */
static bool Turn(const Adapt *a, int first, Star *star)
{
  int c = first;
  star->n = 0;
  do {
    if (star->n == MAX_STAR) return false;
    star->corner[star->n++] = c;
    const int o = a->across[Next(c)];
    star->closed = o != NONE;
    if (!star->closed) break;
    c = Next(o);
  } while (c != first);
  return true;
}

bool AdaptStar(const Adapt *a, int v, Star *star)
{
  int first = a->corner[v];
  if (!Turn(a, first, star)) return false;
  if (star->closed) return true;
  for (int o = a->across[Prev(first)]; o != NONE; o = a->across[Prev(first)]) first = Prev(o); /* clockwise */
  return Turn(a, first, star);
}
