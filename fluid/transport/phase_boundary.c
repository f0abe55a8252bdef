#include "fluid/transport/phase_boundary.h"

static void SetInflow(PhaseBoundaries *s, const PhaseProperties *properties, const double gravity[2])
{
  const int lightest = PhaseLightest(properties);
  for (int b = 0; b < s->domain->mesh->ntags; b++) {
    const Boundary *boundary = &s->domain->boundary[b];
    s->open[b] = boundary->kind == BOUNDARY_OPEN;
    double sum = 0.0;
    s->contact[b] = boundary->phases.contact_cosine;
    for (int p = 0; p < properties->n; p++) sum += s->inflow[b][p] = boundary->phases.inflow[p];
    if (sum == 0.0) s->inflow[b][lightest] = 1.0;
    s->levels[b].n = boundary->phases.nlevels;
    for (int k = 0; k < s->levels[b].n; k++) s->levels[b].phase[k] = boundary->phases.level_phase[k];
    for (int c = 0; c < 2 && s->levels[b].n; c++)
      s->levels[b].normal[c] = -gravity[c] / hypot(gravity[0], gravity[1]);
  }
}

PetscErrorCode PhaseBoundariesCreate(const FluidDomain *domain, const PhaseProperties *properties,
                                     const double gravity[2], PhaseBoundaries *s)
{
  const Mesh *m = domain->mesh;
  PetscFunctionBeginUser;
  s->domain = domain;
  PetscCall(
      PetscCalloc4(m->ntags, &s->open, m->ntags, &s->inflow, m->ntags, &s->contact, m->ntags, &s->levels));
  PetscCall(PetscMalloc1(6 * m->ne, &s->moment));
  SetInflow(s, properties, gravity);
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseBoundariesDestroy(PhaseBoundaries *s)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree4(s->open, s->inflow, s->contact, s->levels));
  PetscCall(PetscFree(s->moment));
  PetscFunctionReturn(0);
}

/* g.n at x of the instants that the velocity is made of. */
static double PrescribedNormal(const PhaseStep *s, const Boundary *b, const double x[2], const double n[2])
{
  double now[2], before[2] = {0.0, 0.0};
  BoundaryVelocity(b, s->time, x, now);
  if (s->extrapolated != 0.0) BoundaryVelocity(b, s->time - s->dt_before, x, before);
  for (int c = 0; c < 2; c++) now[c] += s->extrapolated * (now[c] - before[c]);
  return BoundaryNormalPart(now, n);
}

/* With the projection's quadrature (Simpson's rule). */
static void SetMoments(PhaseBoundaries *boundaries, const PhaseStep *s)
{
  const FluidDomain *domain = boundaries->domain;
  const Mesh *m = domain->mesh;
  double *moment = boundaries->moment;
  for (int k = 0; k < 3 * m->ne; k++) {
    const Boundary *b = BoundaryOfFace(domain, k / 3, k % 3);
    moment[2 * k] = moment[2 * k + 1] = 0.0;
    if (!b || b->kind != BOUNDARY_VELOCITY) continue;
    const FaceGeometry *face = &domain->geometry[k / 3].face[k % 3];
    const double *ends[2] = {ElementVertex(m, k / 3, (k % 3 + 1) % 3),
                             ElementVertex(m, k / 3, (k % 3 + 2) % 3)};
    const double middle[2] = {0.5 * (ends[0][0] + ends[1][0]), 0.5 * (ends[0][1] + ends[1][1])};
    for (int i = 0; i < 2; i++)
      moment[2 * k + i] = face->length * (PrescribedNormal(s, b, ends[i], face->n) / 6.0 +
                                          PrescribedNormal(s, b, middle, face->n) / 3.0);
  }
}

void PhaseBoundariesSetStep(PhaseBoundaries *s, const PhaseStep *step)
{
  for (int b = 0; b < s->domain->mesh->ntags; b++)
    for (int k = 0; k < s->levels[b].n; k++)
      s->levels[b].d[k] = BoundaryLevel(&s->domain->boundary[b].phases, k, step->time + 0.5 * step->dt);
  SetMoments(s, step);
}
