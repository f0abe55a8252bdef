#include "fluid/phase_transport.h"
#include "common/mesh/mesh_checkpoint.h"
#include "fluid/phases/flux.h"

/* Outflow from an element near an interface in one go, as a share of its area. */
#define COURANT_MAX 0.9

struct PhaseTransport_s {
  const FluidDomain *domain; /* borrowed */
  PhaseProperties properties;
  double gravity[2];
  Stars *stars;
  Phases phases;
  char *open;                                    /* [ntags] fluxes are free there */
  double (*inflow)[PHASES_MAX];                  /* [ntags] fractions of what comes in */
  double *contact;                               /* [ntags] cosine of the contact angle */
  PhasesLevel *level;                            /* [ntags] */
  InverseDensity *begin, *end, *inverse_density; /* [ne] at the ends of the step, and what the step sees */
  double *saved;                                 /* [ne][n] volumes */
  double *flux, *beta, *velocity;                /* [ne][3], [ne][6], [ne][3][2] of the step */
  double *swept, *part, *moment; /* [ne][3][n] of the step and of its part, m2; [ne][3][2] prescribed */
  int *single;                   /* [nl] at the start of the step */
  PhaseBudget budget, saved_budget;
};

int PhaseLightest(const PhaseProperties *p)
{
  int lightest = 0;
  for (int k = 1; k < p->n; k++)
    if (p->rho[k] < p->rho[lightest]) lightest = k;
  return lightest;
}

/* --- life ----------------------------------------------------------------------------------------------- */

/* What comes in through an open boundary, or is prescribed: the lightest phase, unless the boundary says which. */
static void SetInflow(PhaseTransport t)
{
  const int lightest = PhaseLightest(&t->properties);
  for (int b = 0; b < t->domain->mesh->ntags; b++) {
    const Boundary *boundary = &t->domain->boundary[b];
    t->open[b] = boundary->kind == BOUNDARY_OPEN;
    t->contact[b] = boundary->contact_cosine;
    t->inflow[b][boundary->has_phase ? boundary->phase : lightest] = 1.0;
    if (!boundary->has_level) continue;
    t->level[b].phase = 1 - lightest;
    t->level[b].below.d = boundary->level;
    for (int c = 0; c < 2; c++) t->level[b].below.n[c] = -t->gravity[c] / hypot(t->gravity[0], t->gravity[1]);
  }
}

PetscErrorCode PhaseTransportCreate(const FluidDomain *domain, const PhaseProperties *properties,
                                    const double gravity[2], PhaseTransport *transport)
{
  const Mesh *m = domain->mesh;
  const int n = properties->n;
  PhaseTransport t;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&t));
  t->domain = domain;
  t->properties = *properties;
  for (int c = 0; c < 2; c++) t->gravity[c] = gravity[c];
  PetscCall(StarsCreate(m, &t->stars));
  PetscCall(PhasesCreate(t->stars, n, &t->phases));
  PetscCall(
      PetscCalloc4(m->ntags, &t->open, m->ntags, &t->inflow, m->ntags, &t->contact, m->ntags, &t->level));
  PetscCall(PetscMalloc4(m->ne, &t->begin, m->ne, &t->end, m->ne, &t->inverse_density,
                         (size_t)n * (size_t)m->ne, &t->saved));
  PetscCall(
      PetscMalloc4(3 * m->ne, &t->flux, 6 * m->ne, &t->beta, 6 * m->ne, &t->velocity, 6 * m->ne, &t->moment));
  PetscCall(PetscMalloc3(3 * n * m->ne, &t->swept, 3 * n * m->ne, &t->part, t->stars->nl, &t->single));
  SetInflow(t);
  *transport = t;
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportDestroy(PhaseTransport *transport)
{
  PhaseTransport t = *transport;
  PetscFunctionBeginUser;
  if (!t) PetscFunctionReturn(0);
  PetscCall(PhasesDestroy(&t->phases));
  PetscCall(StarsDestroy(&t->stars));
  PetscCall(PetscFree4(t->open, t->inflow, t->contact, t->level));
  PetscCall(PetscFree4(t->begin, t->end, t->inverse_density, t->saved));
  PetscCall(PetscFree4(t->flux, t->beta, t->velocity, t->moment));
  PetscCall(PetscFree3(t->swept, t->part, t->single));
  PetscCall(PetscFree(*transport));
  PetscFunctionReturn(0);
}

/* volume[n], m2, of all ranks. */
static PetscErrorCode SumVolumes(PhaseTransport t, double volume[])
{
  int n;
  const double *v = PhaseTransportVolumes(t, &n);
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(volume, n));
  for (int k = 0; k < n * t->stars->ne; k++) volume[k % n] += v[k];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, volume, n, MPI_DOUBLE, MPI_SUM, t->domain->mesh->comm));
  PetscFunctionReturn(0);
}

/* --- state ---------------------------------------------------------------------------------------------- */

/* After the effective densities at the end of the step. */
static PetscErrorCode AddSurfaceTension(PhaseTransport t)
{
  double(*force)[2];
  PetscFunctionBeginUser;
  if (t->properties.surface_tension == 0.0) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(t->stars->ne, &force));
  PetscCall(PhasesGetSurfaceForce(t->phases, t->properties.surface_tension, t->contact, (double *)force));
  for (int e = 0; e < t->stars->ne; e++) InverseDensityAddSurface(force[e], &t->end[e]);
  PetscCall(PetscFree(force));
  PetscFunctionReturn(0);
}

/* Lines, and what follows from them. */
static PetscErrorCode Reconstruct(PhaseTransport t)
{
  PetscFunctionBeginUser;
  PetscCall(PhasesReconstruct(t->phases));
  PetscCall(PhasesGetInverseDensity(t->phases, t->properties.rho, t->gravity, t->end));
  PetscCall(AddSurfaceTension(t));
  PhaseTransportSettle(t);
  PetscFunctionReturn(0);
}

void PhaseTransportSetUniform(PhaseTransport t, int e, double rho)
{
  const double surface[2] = {t->inverse_density[e].surface[0], t->inverse_density[e].surface[1]};
  InverseDensityUniform(rho, t->gravity, &t->inverse_density[e]);
  if (t->properties.surface_tension != 0.0) InverseDensityAddSurface(surface, &t->inverse_density[e]);
}

void PhaseTransportSettle(PhaseTransport t)
{
  for (int e = 0; e < t->stars->ne; e++) t->inverse_density[e] = t->end[e];
}

PetscErrorCode PhaseTransportFill(PhaseTransport t, int nregions, const Region region[])
{
  PetscFunctionBeginUser;
  PetscCall(PhasesFill(t->phases, nregions, region));
  PetscCall(SumVolumes(t, t->budget.initial));
  PetscCall(Reconstruct(t));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportRemap(PhaseTransport from, Transfer transfer, PhaseTransport to)
{
  PetscFunctionBeginUser;
  PetscCall(PhasesRemap(from->phases, transfer, to->phases));
  to->budget = from->budget;
  PetscCall(Reconstruct(to));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportSaveState(PhaseTransport t)
{
  const double *volume;
  PetscFunctionBeginUser;
  PetscCall(PhasesGetVolumes(t->phases, &volume));
  PetscCall(PetscArraycpy(t->saved, volume, (size_t)t->properties.n * (size_t)t->stars->ne));
  t->saved_budget = t->budget;
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportRestoreState(PhaseTransport t)
{
  PetscFunctionBeginUser;
  PetscCall(PhasesSetVolumes(t->phases, t->saved));
  t->budget = t->saved_budget;
  PetscCall(Reconstruct(t));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportSave(PhaseTransport t, Checkpoint to)
{
  int n;
  const double *volume = PhaseTransportVolumes(t, &n);
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(t->domain->mesh->comm, &rank));
  PetscCall(CheckpointPutDoubles(to, "phases", t->stars->ne, n, volume));
  PetscCall(CheckpointPutDoubles(to, "initial phases", rank ? 0 : 1, n, t->budget.initial));
  PetscCall(CheckpointPutDoubles(to, "phases out", rank ? 0 : 1, n, t->budget.out));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportLoad(PhaseTransport t, const PetscInt row[], Checkpoint from)
{
  double *volume;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)t->properties.n * (size_t)t->stars->ne, &volume));
  PetscCall(MeshLoadDoubles(t->domain->mesh, row, from, "phases", t->properties.n, volume));
  PetscCall(PhasesSetVolumes(t->phases, volume));
  PetscCall(PetscFree(volume));
  PetscCall(CheckpointGetDoubles(from, "initial phases", 0, 1, t->properties.n, t->budget.initial));
  PetscCall(CheckpointGetDoubles(from, "phases out", 0, 1, t->properties.n, t->budget.out));
  PetscCall(Reconstruct(t));
  PetscFunctionReturn(0);
}

void PhaseTransportMaterial(PhaseTransport t, double rho[], double mu[])
{
  int n;
  const double *volume = PhaseTransportVolumes(t, &n);
  for (int e = 0; e < t->stars->ne; e++) {
    const double area = t->domain->geometry[e].area;
    rho[e] = mu[e] = 0.0;
    for (int p = 0; p < n; p++) {
      rho[e] += t->properties.rho[p] * volume[n * e + p] / area;
      mu[e] += t->properties.mu[p] * volume[n * e + p] / area;
    }
    if (mu[e] < 0.0) mu[e] = 0.0;
  }
}

const PhaseProperties *PhaseTransportProperties(PhaseTransport t)
{
  return &t->properties;
}

const InverseDensity *PhaseTransportInverseDensity(PhaseTransport t)
{
  return t->inverse_density;
}

const double *PhaseTransportVolumes(PhaseTransport t, int *n)
{
  const double *volume = NULL;
  *n = t->properties.n;
  (void)PhasesGetVolumes(t->phases, &volume);
  return volume;
}

Phases PhaseTransportPhases(PhaseTransport t)
{
  return t->phases;
}

PetscErrorCode PhaseTransportBudget(PhaseTransport t, PhaseBudget *budget)
{
  PetscFunctionBeginUser;
  *budget = t->budget;
  PetscCall(SumVolumes(t, budget->volume));
  PetscFunctionReturn(0);
}

/* --- the step ------------------------------------------------------------------------------------------- */

/* g.n at x of the instants that the velocity is made of. */
static double PrescribedNormal(const PhaseStep *s, const Boundary *b, const double x[2], const double n[2])
{
  double now[2], before[2] = {0.0, 0.0};
  BoundaryVelocity(b, s->time, x, now);
  if (s->extrapolated != 0.0) BoundaryVelocity(b, s->time - s->dt_before, x, before);
  for (int c = 0; c < 2; c++) now[c] += s->extrapolated * (now[c] - before[c]);
  return now[0] * n[0] + now[1] * n[1];
}

/* int lambda g.n on boundary faces, with the projection's quadrature (Simpson's rule). */
static void SetMoments(PhaseTransport t, const PhaseStep *s)
{
  const Mesh *m = t->domain->mesh;
  for (int k = 0; k < 3 * m->ne; k++) {
    const Boundary *b = BoundaryOfFace(t->domain, k / 3, k % 3);
    t->moment[2 * k] = t->moment[2 * k + 1] = 0.0;
    if (!b || b->kind != BOUNDARY_VELOCITY) continue;
    const FaceGeometry *face = &t->domain->geometry[k / 3].face[k % 3];
    const double *ends[2] = {ElementVertex(m, k / 3, (k % 3 + 1) % 3),
                             ElementVertex(m, k / 3, (k % 3 + 2) % 3)};
    const double middle[2] = {0.5 * (ends[0][0] + ends[1][0]), 0.5 * (ends[0][1] + ends[1][1])};
    for (int i = 0; i < 2; i++)
      t->moment[2 * k + i] = face->length * (PrescribedNormal(s, b, ends[i], face->n) / 6.0 +
                                             PrescribedNormal(s, b, middle, face->n) / 3.0);
  }
}

static int NearInterface(PhaseTransport t, int e)
{
  if (t->single[e] < 0) return 1;
  for (int i = 0; i < 3; i++) {
    const int o = t->stars->neighbor[e][i];
    if (o >= 0 && t->single[o] != t->single[e]) return 1;
  }
  return 0;
}

/* Into how many parts the step is divided, so that no element near an interface loses more than its content. */
static PetscErrorCode CountParts(PhaseTransport t, double dt, int *parts)
{
  double courant = 0.0;
  PetscFunctionBeginUser;
  for (int e = 0; e < t->stars->ne; e++) {
    if (!NearInterface(t, e)) continue;
    double out = 0.0;
    for (int i = 0; i < 3; i++) out += fmax(t->flux[3 * e + i], 0.0);
    courant = fmax(courant, out * dt / t->domain->geometry[e].area);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &courant, 1, MPI_DOUBLE, MPI_MAX, t->domain->mesh->comm));
  *parts = (int)fmax(1.0, ceil(courant / COURANT_MAX));
  PetscFunctionReturn(0);
}

/* The heavier phase leaves what the solid fills of elements, which the lighter one fills with it. */
static PetscErrorCode LeaveSolid(PhaseTransport t, const double solid[])
{
  const int light = PhaseLightest(&t->properties);
  double *capacity;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(t->stars->ne, &capacity));
  for (int e = 0; e < t->stars->ne; e++)
    capacity[e] = fmax(1.0 - solid[e], 0.0) * t->domain->geometry[e].area;
  PetscCall(PhasesExpel(t->phases, 1 - light, light, capacity, t->swept));
  PetscCall(PetscFree(capacity));
  PetscFunctionReturn(0);
}

/* Adds what this step has swept through the boundary. */
static PetscErrorCode AddOut(PhaseTransport t)
{
  const int n = t->properties.n;
  double out[PHASES_MAX] = {0.0};
  PetscFunctionBeginUser;
  for (int k = 0; k < 3 * t->stars->ne; k++)
    for (int p = 0; p < n && t->domain->mesh->neighbor[k] < 0; p++) out[p] += t->swept[k * n + p];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, out, n, MPI_DOUBLE, MPI_SUM, t->domain->mesh->comm));
  for (int p = 0; p < n; p++) t->budget.out[p] += out[p];
  PetscFunctionReturn(0);
}

static PetscErrorCode Advect(PhaseTransport t, double dt, const double solid[])
{
  const int n = 3 * t->properties.n * t->stars->ne;
  const PhasesInflow inflow = {(const double(*)[PHASES_MAX])t->inflow, t->level};
  int parts;
  PetscFunctionBeginUser;
  PetscCall(CountParts(t, dt, &parts));
  PetscCall(PetscArrayzero(t->swept, n));
  for (int k = 0; k < parts; k++) {
    if (k) PetscCall(PhasesReconstruct(t->phases));
    PetscCall(PhasesAdvect(t->phases, dt / parts, t->flux, t->velocity, &inflow, t->part));
    for (int i = 0; i < n; i++) t->swept[i] += t->part[i];
  }
  PetscCall(AddOut(t));
  if (solid) PetscCall(LeaveSolid(t, solid));
  PetscCall(Reconstruct(t));
  PetscFunctionReturn(0);
}

/* The phase that alone lies on both sides of face i of e before and after the step and passes it, or -1. */
static int PhaseOfFace(PhaseTransport t, int e, int i)
{
  const int o = t->stars->neighbor[e][i], p = t->single[e], n = t->properties.n;
  if (p < 0 || PhasesSingle(t->phases, e) != p) return -1;
  if (o >= 0 && (t->single[o] != p || PhasesSingle(t->phases, o) != p)) return -1;
  for (int q = 0; q < n; q++)
    if (q != p && t->swept[(3 * e + i) * n + q] != 0.0) return -1;
  return p;
}

/* m with the masses that passed the faces: linear along a face inside a phase, else constant. */
static void MassFlux(PhaseTransport t, double dt, double mass_flux[])
{
  const int n = t->properties.n;
  for (int e = 0; e < t->stars->ne; e++) {
    const StarElement *element = &t->stars->element[e];
    double normal[3][2];
    for (int i = 0; i < 3; i++) {
      const int p = PhaseOfFace(t, e, i);
      double length, mass = 0.0;
      FluxNormalParts(element, &t->beta[6 * e], i, normal[i], &length);
      for (int q = 0; q < n; q++) mass += t->properties.rho[q] * t->swept[(3 * e + i) * n + q];
      for (int k = 0; k < 2; k++)
        normal[i][k] = p >= 0 ? t->properties.rho[p] * normal[i][k] : mass / (dt * length);
    }
    FluxLinearField(element, (const double(*)[2])normal, &mass_flux[6 * e]);
  }
}

PetscErrorCode PhaseTransportStep(PhaseTransport t, const PhaseStep *s)
{
  const FluxBoundary boundary = {t->open, t->moment};
  FluxReport report;
  PetscFunctionBeginUser;
  SetMoments(t, s);
  PetscCall(FluxEquilibrate(t->stars, s->u, &boundary, t->flux, t->beta, &report));
  PetscCall(FluxVertexVelocity(t->stars, t->beta, t->velocity));
  for (int e = 0; e < t->stars->nl; e++) t->single[e] = PhasesSingle(t->phases, e);
  for (int e = 0; e < t->stars->ne; e++) t->begin[e] = t->end[e];
  PetscCall(Advect(t, s->dt, s->solid));
  for (int e = 0; e < t->stars->ne; e++)
    InverseDensityMiddle(&t->begin[e], &t->end[e], &t->inverse_density[e]);
  MassFlux(t, s->dt, s->mass_flux);
  PetscFunctionReturn(0);
}
