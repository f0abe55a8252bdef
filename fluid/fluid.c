/* The fluid's life: create, initial state, step control, views. */
#include "fluid/fluid_impl.h"

static PetscErrorCode CreateElements(Fluid f)
{
  const Mesh *m = f->mesh;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(m->ne + m->ng, &f->geometry, m->ne + m->ng, &f->rho, m->ne + m->ng, &f->mu));
  PetscCall(PetscMalloc1(m->ne, &f->coupling_of));
  PetscCall(PetscCalloc1(m->ne, &f->alpha));
  for (int e = 0; e < m->ne + m->ng; e++) {
    ElementGeometryCompute(ElementVertex(m, e, 0), ElementVertex(m, e, 1), ElementVertex(m, e, 2),
                           f->geometry + e);
    f->rho[e] = f->setup.rho;
    f->mu[e] = f->setup.mu;
  }
  for (int e = 0; e < m->ne; e++) f->coupling_of[e] = -1;
  PetscFunctionReturn(0);
}

PetscErrorCode FluidDefaultOption(const char *name, const char *value)
{
  PetscBool given;
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsHasName(NULL, NULL, name, &given));
  if (!given) PetscCall(PetscOptionsSetValue(NULL, name, value));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidCreate(const Mesh *mesh, const FluidSetup *setup, Fluid *fluid)
{
  Fluid f;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&f));
  f->mesh = mesh;
  f->setup = *setup;
  PetscCall(PetscMalloc1(mesh->ntags, &f->setup.boundary));
  PetscCall(PetscArraycpy(f->setup.boundary, setup->boundary, mesh->ntags));
  PetscCall(BoundaryPrepare(f));
  PetscCall(CreateElements(f));
  PetscCall(MomentumCreate(f));
  PetscCall(PressureCreate(f));
  *fluid = f;
  PetscFunctionReturn(0);
}

PetscErrorCode FluidCreateLike(Fluid like, const Mesh *mesh, Fluid *fluid)
{
  const double start = MPI_Wtime();
  PetscFunctionBeginUser;
  PetscCall(FluidCreate(mesh, &like->setup, fluid));
  (*fluid)->stats.seconds[SETUP] = MPI_Wtime() - start;
  PetscFunctionReturn(0);
}

PetscErrorCode FluidDestroy(Fluid *fluid)
{
  Fluid f = *fluid;
  PetscFunctionBeginUser;
  if (!f) PetscFunctionReturn(0);
  PetscCall(MomentumDestroy(f));
  PetscCall(PressureDestroy(f));
  PetscCall(PetscFree3(f->geometry, f->rho, f->mu));
  PetscCall(PetscFree(f->coupling_of));
  PetscCall(PetscFree(f->coupling));
  PetscCall(PetscFree(f->alpha));
  PetscCall(PetscFree(f->setup.boundary));
  PetscCall(PetscFree(*fluid));
  PetscFunctionReturn(0);
}

/* x of P2 node k of element e */
static void P2NodePosition(const Mesh *m, int e, int k, double x[2])
{
  const double *a = ElementVertex(m, e, k < 3 ? k : (k + 1) % 3),
               *b = ElementVertex(m, e, k < 3 ? k : (k + 2) % 3);
  for (int c = 0; c < 2; c++) x[c] = 0.5 * (a[c] + b[c]);
}

/* p += what open boundaries hold above hydrostatic.  A node's owner need not have the boundary face: hence
 * sum and count. */
static PetscErrorCode AddOpenPressure(Fluid f)
{
  const Mesh *m = f->mesh;
  Vec sum = f->divergence, count = f->phi, both[2] = {sum, count}, local[2];
  PetscScalar *v[2], *p;
  PetscFunctionBeginUser;
  for (int k = 0; k < 2; k++) {
    PetscCall(VecGhostGetLocalForm(both[k], &local[k]));
    PetscCall(VecSet(local[k], 0.0));
    PetscCall(VecGetArray(local[k], &v[k]));
  }
  for (int e = 0; e < m->ne; e++)
    for (int i = 0; i < 3; i++) {
      const Boundary *b = BoundaryOfFace(f, e, i);
      const int node[3] = {(i + 1) % 3, (i + 2) % 3, 3 + i};
      for (int k = 0; k < 3 && b && b->kind == BOUNDARY_OPEN; k++) {
        v[0][m->p2[6 * e + node[k]]] += b->pressure;
        v[1][m->p2[6 * e + node[k]]] += 1.0;
      }
    }
  for (int k = 0; k < 2; k++) {
    PetscCall(VecRestoreArray(local[k], &v[k]));
    PetscCall(VecGhostRestoreLocalForm(both[k], &local[k]));
    PetscCall(VecGhostUpdateBegin(both[k], ADD_VALUES, SCATTER_REVERSE));
    PetscCall(VecGhostUpdateEnd(both[k], ADD_VALUES, SCATTER_REVERSE));
    PetscCall(VecGetArray(both[k], &v[k]));
  }
  PetscCall(VecGetArray(f->p, &p));
  for (int k = 0; k < m->np2_owned; k++) p[k] += v[1][k] > 0.0 ? v[0][k] / v[1][k] : 0.0;
  PetscCall(VecRestoreArray(f->p, &p));
  for (int k = 0; k < 2; k++) PetscCall(VecRestoreArray(both[k], &v[k]));
  PetscCall(VecSet(f->phi, 0.0));
  PetscCall(VecGhostUpdateBegin(f->p, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(f->p, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidSetInitial(Fluid f, double t, FieldFunction velocity, FieldFunction pressure,
                               void *context)
{
  const Mesh *m = f->mesh;
  PetscScalar *u, *p;
  Vec local;
  PetscFunctionBeginUser;
  f->t = t;
  f->dt_previous = 0.0;
  PetscCall(VecGetArray(f->u, &u));
  for (int e = 0; e < m->ne; e++)
    for (int i = 0; i < 3; i++) {
      double v[2] = {0};
      if (velocity) velocity(context, t, ElementVertex(m, e, i), v);
      for (int c = 0; c < 2; c++) u[6 * e + 3 * c + i] = v[c];
    }
  PetscCall(VecRestoreArray(f->u, &u));
  PetscCall(VecCopy(f->u, f->u_previous));
  PetscCall(VecCopy(f->u, f->u_star));
  PetscCall(VecCopy(f->u, f->u_next));
  PetscCall(VecGhostGetLocalForm(f->p, &local));
  PetscCall(VecGetArray(local, &p));
  for (int e = 0; e < m->ne; e++)
    for (int k = 0; k < 6; k++) {
      double x[2];
      P2NodePosition(m, e, k, x);
      p[m->p2[6 * e + k]] = HydrostaticPressure(f, x);
      if (pressure) pressure(context, t, x, p + m->p2[6 * e + k]);
    }
  PetscCall(VecRestoreArray(local, &p));
  PetscCall(VecGhostRestoreLocalForm(f->p, &local));
  if (!pressure) PetscCall(AddOpenPressure(f));
  PetscFunctionReturn(0);
}

double FluidTimeStep(Fluid f)
{
  const Mesh *m = f->mesh;
  const PetscScalar *u;
  double rate = 0.0, speed = 0.0;
  if (VecGetArrayRead(f->u_next, &u)) return 0.0;
  for (int e = 0; e < m->ne; e++)
    for (int i = 0; i < 3; i++) {
      const double *v = u + 6 * e + i;
      double sum = 0.0; /* of |u.grad lambda|: twice the inverse of the time to cross the element */
      for (int k = 0; k < 3; k++) sum += fabs(v[0] * f->geometry[e].g[k][0] + v[3] * f->geometry[e].g[k][1]);
      rate = fmax(rate, 0.5 * sum);
      speed = fmax(speed, v[0] * v[0] + v[3] * v[3]);
    }
  (void)VecRestoreArrayRead(f->u_next, &u);
  f->stats.max_speed = sqrt(speed);
  return rate * f->setup.dt_max > f->setup.cfl ? f->setup.cfl / rate : f->setup.dt_max;
}

PetscErrorCode FluidState(Fluid f, int save)
{
  const Vec live[] = {f->u, f->u_previous, f->p}, kept[] = {f->saved_u, f->saved_previous, f->saved_p};
  PetscFunctionBeginUser;
  for (int k = 0; k < 3; k++) {
    Vec from, to;
    PetscCall(VecGhostGetLocalForm(save ? live[k] : kept[k], &from));
    PetscCall(VecGhostGetLocalForm(save ? kept[k] : live[k], &to));
    PetscCall(VecCopy(from, to));
    PetscCall(VecGhostRestoreLocalForm(save ? live[k] : kept[k], &from));
    PetscCall(VecGhostRestoreLocalForm(save ? kept[k] : live[k], &to));
  }
  if (save)
    f->saved_t = f->t, f->saved_dt = f->dt_previous;
  else
    f->t = f->saved_t, f->dt_previous = f->saved_dt;
  PetscFunctionReturn(0);
}

/* The array of a Vec that stays where it is as long as the Vec lives. */
static const double *View(Vec v)
{
  const PetscScalar *array = NULL, *view;
  (void)VecGetArrayRead(v, &array);
  view = array;
  (void)VecRestoreArrayRead(v, &array); /* nulls array */
  return view;
}

const double *FluidVelocity(Fluid f)
{
  return View(f->u);
}
const double *FluidVelocityStar(Fluid f)
{
  return View(f->u_star);
}
const double *FluidVelocityPlus(Fluid f)
{
  return View(f->u_next);
}
const double *FluidPressure(Fluid f)
{
  return View(f->p);
}
const double *FluidDensity(Fluid f)
{
  return f->rho;
}
const double *FluidViscosity(Fluid f)
{
  return f->mu;
}
const double *FluidSolidFraction(Fluid f)
{
  return f->alpha;
}
const FluidStats *FluidGetStats(Fluid f)
{
  return &f->stats;
}
const Mesh *FluidMesh(Fluid f)
{
  return f->mesh;
}
