#include "solid/loads.h"

PetscErrorCode LoadsTake(Solid s, const Model *a, const int part[], const int local[])
{
  PetscFunctionBeginUser;
  s->nboundary_loads = a->nloads;
  PetscCall(PetscMalloc3((size_t)a->nloads, &s->boundary_load, (size_t)a->nloaded, &s->loaded,
                         (size_t)a->nloaded, &s->loaded_force));
  for (int k = 0; k < a->nloads; k++) PetscCall(BoundaryLoadCopy(&a->load[k], &s->boundary_load[k]));
  for (int k = 0; k < a->nloaded; k++) {
    const LoadedSide *side = &a->loaded[k];
    if (part[side->element] == s->rank)
      s->loaded[s->nloaded++] = (LoadedSide){local[side->element], side->side, side->load};
  }
  PetscFunctionReturn(0);
}

PetscErrorCode LoadsFree(Solid s)
{
  PetscFunctionBeginUser;
  for (int k = 0; k < s->nboundary_loads; k++) PetscCall(BoundaryLoadFree(&s->boundary_load[k]));
  PetscCall(PetscFree3(s->boundary_load, s->loaded, s->loaded_force));
  PetscFunctionReturn(0);
}

/* The nodes of the edge that a loaded side is, of a six-node triangle half of: from node[0] to the last.  Returns their number. */
static int EdgeNodes(const Solid s, const LoadedSide *side, int node[3])
{
  const Elements *e = &s->elements;
  const int k = side->element, *own = s->element + 3 * k;
  node[0] = own[side->side];
  node[1] = own[(side->side + 1) % 3];
  if (!e->six_node[k]) return 2;
  node[2] = side->side == 0 ? e->far[0][k] : node[1];
  if (side->side == 0) return 3;
  node[1] = node[0];
  node[0] = e->far[1][k];
  return 3;
}

void LoadsAddForces(Solid s)
{
  for (int k = 0; k < s->nloaded; k++) {
    const LoadedSide *side = &s->loaded[k];
    const BoundaryLoad *load = &s->boundary_load[side->load];
    const double thickness = s->material[s->elements.material[side->element]].thickness, t = s->stats.t;
    double x[3][2], rest[3][2], traction[2] = {0.0, 0.0}, pressure = 0.0;
    int node[3];
    const int n = EdgeNodes(s, side, node);
    const double from = n == 3 && side->side ? 0.5 : 0.0, to = n == 3 && !side->side ? 0.5 : 1.0;
    for (int i = 0; i < 2 * n; i++) {
      x[i / 2][i % 2] = s->x[2 * node[i / 2] + i % 2];
      rest[i / 2][i % 2] = s->rest[2 * node[i / 2] + i % 2];
    }
    if (load->pressure.nrows) pressure = thickness * TimeTableValue(&load->pressure, 1, t);
    for (int c = 0; c < 2 && load->traction.nrows; c++)
      traction[c] = thickness * TimeTableValue(&load->traction, 1 + c, t);
    EdgeLoad(n, (const double(*)[2])x, (const double(*)[2])rest, from, to, pressure, traction,
             s->loaded_force[k]);
    for (int i = 0; i < 2 * n; i++) s->force[2 * node[i / 2] + i % 2] += s->loaded_force[k][i / 2][i % 2];
  }
}

/* The same of a table. */
static double SteadyFor(const TimeTable *table, double t, double window)
{
  double until = t;
  if (!table->nrows) return window;
  for (int k = TimeTableNext(table, t); k < table->nrows && TimeTableAt(table, k, 0) < t + window; k++) {
    for (int c = 1; c < table->width; c++)
      if (fabs(TimeTableAt(table, k, c)) > 2.0 * fabs(TimeTableValue(table, c, t))) return until - t;
    until = TimeTableAt(table, k, 0);
  }
  return window;
}

double LoadsSteadyFor(const Solid s, double window)
{
  double least = window;
  for (int k = 0; k < s->nboundary_loads; k++) {
    const BoundaryLoad *load = &s->boundary_load[k];
    least = fmin(least, fmin(SteadyFor(&load->pressure, s->stats.t, window),
                             SteadyFor(&load->traction, s->stats.t, window)));
  }
  return least;
}

void LoadsAddBudget(Solid s)
{
  for (int k = 0; k < s->nloaded; k++) {
    int node[3];
    const int n = EdgeNodes(s, &s->loaded[k], node);
    for (int i = 0; i < 2 * n; i++) {
      const double impulse = s->kick * s->loaded_force[k][i / 2][i % 2];
      s->reaction[s->node_body[node[i / 2]]][i % 2] += impulse;
      s->budget.reaction_work += impulse * s->v[2 * node[i / 2] + i % 2];
    }
  }
}
