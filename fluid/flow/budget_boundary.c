/* The forces on the boundaries, as the scheme has them. */
#include "fluid/flow/budget_step.h"

/* At both nodes of a face: the velocity at the step's theta and that velocity less the one prescribed, if one is. */
static void FaceVelocities(Fluid f, const BudgetStep *s, const Boundary *b, int e, const int node[2],
                           double u[2][2], double slip[2][2])
{
  for (int r = 0; r < 2; r++) {
    const double *x = ElementVertex(f->domain.mesh, e, node[r]);
    double now[2] = {0.0, 0.0}, next[2] = {0.0, 0.0};
    if (b->kind == BOUNDARY_VELOCITY) {
      BoundaryVelocity(b, s->t, x, now);
      BoundaryVelocity(b, s->t + s->dt, x, next);
    }
    for (int c = 0; c < 2; c++) {
      const int k = 6 * e + 3 * c + node[r];
      u[r][c] = s->theta * s->u_star[k] + (1.0 - s->theta) * s->u[k];
      slip[r][c] = u[r][c] - s->theta * next[c] - (1.0 - s->theta) * now[c];
    }
  }
}

/* With the points of FaceInflow. */
static void FaceConvection(Fluid f, const Boundary *b, const FaceGeometry *face, const double m[2][2],
                           const double u[2][2], const double slip[2][2], double force[2])
{
  const double share = b->kind == BOUNDARY_FREE_SLIP            ? 0.0
                       : b->kind == BOUNDARY_OPEN && !f->phases ? 0.5
                                                                : 1.0;
  for (int q = 0; q < 2; q++) {
    const double n[2] = {1.0 - FACE_GAUSS[q], FACE_GAUSS[q]};
    const double out = 0.5 * face->length *
                       (n[0] * (m[0][0] * face->n[0] + m[0][1] * face->n[1]) +
                        n[1] * (m[1][0] * face->n[0] + m[1][1] * face->n[1]));
    for (int c = 0; c < 2; c++)
      force[c] += out * (n[0] * u[0][c] + n[1] * u[1][c]) -
                  share * fmin(out, 0.0) * (n[0] * slip[0][c] + n[1] * slip[1][c]);
  }
}

static void AddFace(Fluid f, const BudgetStep *s, int e, int i, double force[FORCE_PARTS][2])
{
  const Boundary *b = BoundaryOfFace(&f->domain, e, i);
  const FaceGeometry *face = f->domain.geometry[e].face + i;
  const FaceSide k = FaceSideOf(&f->domain, s->mu, e, i, 1.0, PENALTY_BOUNDARY);
  const int node[2] = {k.a, k.b}, *p2 = f->domain.p2->node + 6 * e;
  const double pressure = (s->p[p2[k.a]] + 4.0 * s->p[p2[3 + i]] + s->p[p2[k.b]]) / 6.0;
  double u[2][2], slip[2][2], m[2][2], t[2][6], project[2][2], stress[2] = {0.0, 0.0};
  FaceVelocities(f, s, b, e, node, u, slip);
  for (int r = 0; r < 2; r++)
    for (int c = 0; c < 2; c++) m[r][c] = s->flux[6 * e + 3 * c + node[r]];
  Traction(k.e->g, k.mu, face->n, t);
  BoundaryProjection(b, face->n, project);
  for (int c = 0; c < 2; c++) {
    for (int q = 0; q < 6; q++)
      stress[c] -= t[c][q] * (s->theta * s->u_star[6 * e + q] + (1.0 - s->theta) * s->u[6 * e + q]);
    stress[c] += 0.5 * k.eta * (slip[0][c] + slip[1][c]);
  }
  for (int c = 0; c < 2; c++) {
    force[FORCE_PRESSURE][c] += face->length * pressure * face->n[c];
    force[FORCE_VISCOUS][c] += face->length * (project[c][0] * stress[0] + project[c][1] * stress[1]);
  }
  FaceConvection(f, b, face, (const double(*)[2])m, (const double(*)[2])u, (const double(*)[2])slip,
                 force[FORCE_CONVECTION]);
}

void BudgetAddBoundaries(Fluid f, const BudgetStep *s, BoundaryForce force[])
{
  for (int k = 0; k < f->domain.nfaces; k++) {
    const int face = f->domain.face[k];
    AddFace(f, s, face / 3, face % 3, force[f->domain.mesh->tag[face]]);
  }
}
