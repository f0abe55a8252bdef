/* Bodies for the solid's tests, and the little checks that they share. */
#ifndef TESTS_SOLID_BUILD_H
#define TESTS_SOLID_BUILD_H
#include "solid/bodies/shape.h"
#include "solid/solid.h"
#include "tests/check.h"
#include <math.h>

static inline Material MaterialOf(double density, double youngs_modulus, double poisson_ratio, double damping)
{
  return (Material){.density = density,
                    .youngs_modulus = youngs_modulus,
                    .poisson_ratio = poisson_ratio,
                    .damping = damping,
                    .penalty = youngs_modulus};
}

static inline BodySetup BodyAtRest(Material material)
{
  return (BodySetup){.material = material, .stretch = {1.0, 1.0}};
}

static inline void AddMesh(Model *a, MeshSerial *mesh, const BodySetup *setup)
{
  const char *why = NULL;
  double *none = NULL;
  if (setup->six_node) (void)SixNodeSplit(mesh, &none);
  CHECK(!ModelAdd(a, mesh, setup, &why), "%s", why);
  (void)MeshSerialDestroy(mesh);
}

static inline void AddDisc(Model *a, double x, double y, double radius, double size, const BodySetup *setup)
{
  const double centre[2] = {x, y};
  MeshSerial mesh;
  (void)ShapeDisc(centre, radius, size, &mesh);
  AddMesh(a, &mesh, setup);
}

/* A rectangle whose inner nodes are shaken by 0.2 size when `shake` is not 0. */
static inline void AddRectangle(Model *a, double x, double y, double width, double height, double angle,
                                double size, int shake, const BodySetup *setup)
{
  const double centre[2] = {x, y};
  MeshSerial mesh;
  (void)ShapeRectangle(centre, width, height, angle, size, &mesh);
  char *outer = calloc((size_t)mesh.nv, 1);
  for (int k = 0; k < 2 * mesh.nb; k++) outer[mesh.facet[k]] = 1;
  for (int k = 0; shake && k < 2 * mesh.nv; k++)
    if (!outer[k / 2]) mesh.x[k] += 0.2 * size * sin(12.9898 * k + 4.1);
  free(outer);
  AddMesh(a, &mesh, setup);
}

/* The node at x is an end of the spring. */
static inline void EndAt(const Model *a, double x, double y, SpringEnd *end)
{
  for (int e = 0; e < a->nelements; e++)
    for (int i = 0; i < 3; i++) {
      const double *at = a->x + 2 * a->element[3 * e + i];
      if (fabs(at[0] - x) + fabs(at[1] - y) > 1e-12) continue;
      end->element = e;
      for (int k = 0; k < 3; k++) end->weight[k] = k == i;
    }
}

/* One rank's solid, writable. */
static inline SolidView ViewOf(Solid s, double **x, double **v)
{
  SolidView view;
  SolidGetView(s, &view);
  if (x) *x = (double *)(size_t)view.x;
  if (v) *v = (double *)(size_t)view.v;
  return view;
}

/* One step with this load[nnodes][2] on the nodes; NULL: none.  *why as of SolidStepFailure. */
static inline PetscErrorCode TryStep(Solid s, double dt, const double load[], const char **why)
{
  double h;
  PetscCall(SolidStart(s, dt, load));
  while (SolidRemaining(s)) PetscCall(SolidSubstep(s, &h));
  return SolidStepFailure(s, why);
}

/* The same of a step that must be made. */
static inline PetscErrorCode RunStep(Solid s, double dt, const double load[])
{
  const char *why;
  PetscCall(TryStep(s, dt, load, &why));
  CHECK(!why, "%s", why);
  return 0;
}

/* Runs from now on for `time` in steps of dt without load. */
static inline PetscErrorCode Run(Solid s, double time, double dt)
{
  const int steps = (int)ceil(time / dt * (1.0 - 1e-12));
  for (int k = 0; k < steps; k++) PetscCall(RunStep(s, time / steps, NULL));
  return 0;
}

/* Of two bodies together. */
typedef struct {
  double p[2], spin, energy;
} Totals;

static inline PetscErrorCode TotalsOf(Solid s, Totals *t, BodyState b[2])
{
  PetscCall(SolidBodies(s, 2, b));
  *t = (Totals){.energy = b[0].kinetic + b[0].strain + b[1].kinetic + b[1].strain};
  for (int c = 0; c < 2; c++) t->p[c] = b[0].mass * b[0].v[c] + b[1].mass * b[1].v[c];
  for (int k = 0; k < 2; k++)
    t->spin +=
        b[k].mass * (b[k].x[0] * b[k].v[1] - b[k].x[1] * b[k].v[0]) + b[k].inertia * b[k].angular_velocity;
  return 0;
}

/* mine[n], four numbers a node, NAN where this rank has no copy: all copies have the same bits.  Unless
 * `sparse`, each node must be somewhere. */
static inline PetscErrorCode CopiesAgree(const double mine[], int n, int sparse)
{
  double *low = malloc((size_t)n * sizeof *low), *high = malloc((size_t)n * sizeof *high);
  for (int k = 0; k < n; k++) {
    low[k] = isnan(mine[k]) ? HUGE_VAL : mine[k];
    high[k] = isnan(mine[k]) ? -HUGE_VAL : mine[k];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, low, n, MPI_DOUBLE, MPI_MIN, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, high, n, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  for (int k = 0; k < n; k++)
    CHECK(low[k] == high[k] || (sparse && low[k] > high[k]), "node %d: %.17g and %.17g", k / 4, low[k],
          high[k]);
  free(low);
  free(high);
  return 0;
}

static inline PetscErrorCode TotalEnergy(Solid s, int nbodies, double *energy)
{
  BodyState state[8];
  PetscCall(SolidBodies(s, nbodies, state));
  *energy = 0.0;
  for (int b = 0; b < nbodies; b++) *energy += state[b].kinetic + state[b].strain;
  return 0;
}
#endif
