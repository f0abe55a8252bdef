/* Six-node triangles: splitting keeps area, boundaries and regions; forces are - d(energy)/dx and give no momentum; a field that is
 * quadratic, pure bending, is in equilibrium inside; no joints. */
#include "tests/solid/build.h"

static void CheckSplit(void)
{
  const double centre[2] = {0.3, 0.2};
  double area[2] = {0.0, 0.0}, length[2] = {0.0, 0.0}, *none = NULL;
  int nodes, boundary = 0;
  MeshSerial m;
  (void)ShapeRectangle(centre, 0.4, 0.2, 0.3, 0.1, &m);
  for (int split = 0; split < 2; split++) {
    for (int e = 0; e < m.ne; e++)
      area[split] += 0.5 * TensorDeterminant(TensorOfEdges(PointAt(m.x, m.vertex[3 * e]),
                                                           PointAt(m.x, m.vertex[3 * e + 1]),
                                                           PointAt(m.x, m.vertex[3 * e + 2])));
    for (int b = 0; b < m.nb; b++) {
      const Point d = PointMinus(PointAt(m.x, m.facet[2 * b]), PointAt(m.x, m.facet[2 * b + 1]));
      if (!strcmp(m.tag_name[m.facet_tag[b]], "left")) length[split] += hypot(d.x, d.y);
    }
    nodes = m.nv;
    boundary = m.nb;
    if (split == 0) (void)SixNodeSplit(&m, &none);
  }
  CHECK(fabs(area[1] / area[0] - 1.0) < 1e-14 && fabs(length[1] / 0.2 - 1.0) < 1e-14,
        "area %g of %g, left %g of %g", area[1], area[0], length[1], length[0]);
  CHECK(m.ne == 4 * 16 && nodes == 15 + 30 && boundary == 24, "%d elements, %d nodes, %d facets", m.ne, nodes,
        boundary);
  (void)MeshSerialDestroy(&m);
}

static PetscErrorCode Square(int law, int plane_stress, Model *a, Solid *s)
{
  const SolidSetup options = {.courant = 0.5};
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1e6, 0.3, 0.0));
  setup.material.law = law;
  setup.material.plane_stress = plane_stress;
  setup.material.thickness = 0.25;
  setup.six_node = 1;
  AddRectangle(a, 0.0, 0.0, 1.0, 1.0, 0.0, 0.25, 1, &setup);
  return SolidCreate(PETSC_COMM_SELF, a, &options, s);
}

static PetscErrorCode Energy(Solid s, double *energy)
{
  BodyState state;
  PetscCall(SolidBodies(s, 1, &state));
  *energy = state.strain;
  return 0;
}

/* At large strains of every node's own. */
static PetscErrorCode CheckForces(int law, int plane_stress)
{
  const double moved = 1e-6;
  double *x, worst = 0.0, largest = 0.0, sum[3] = {0.0, 0.0, 0.0};
  const double *now;
  Model a = {0};
  Solid s;
  PetscCall(Square(law, plane_stress, &a, &s));
  const SolidView v = ViewOf(s, &x, NULL);
  for (int k = 0; k < 2 * v.nnodes; k++) x[k] = 1.1 * x[k] + 0.01 * sin(12.9898 * k + 4.1);
  double *force = calloc(2 * (size_t)v.nnodes, sizeof *force);
  PetscCall(SolidForces(s, &now));
  memcpy(force, now, 2 * (size_t)v.nnodes * sizeof *force);
  for (int n = 0; n < v.nnodes; n++) {
    sum[0] += force[2 * n];
    sum[1] += force[2 * n + 1];
    sum[2] += x[2 * n] * force[2 * n + 1] - x[2 * n + 1] * force[2 * n];
  }
  for (int k = 0; k < 2 * v.nnodes; k++) {
    const double at = x[k];
    double energy[2] = {0.0, 0.0};
    x[k] = at + moved;
    PetscCall(Energy(s, &energy[1]));
    x[k] = at - moved;
    PetscCall(Energy(s, &energy[0]));
    x[k] = at;
    worst = fmax(worst, fabs(force[k] + (energy[1] - energy[0]) / (2.0 * moved)));
    largest = fmax(largest, fabs(force[k]));
  }
  if (getenv("VERBOSE")) printf("law %d: forces to %g of %g\n", law, worst, largest);
  CHECK(worst < 1e-6 * largest, "law %d: force and energy differ by %g of %g", law, worst, largest);
  CHECK(fabs(sum[0]) + fabs(sum[1]) + fabs(sum[2]) < 1e-11 * largest,
        "law %d: forces add up to %g %g, their moment %g", law, sum[0], sum[1], sum[2]);
  free(force);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* Plane stress, nu = 0.3: u = kappa x y, v = - kappa (x^2 + nu y^2)/2 has the stress E kappa y along x and no other. */
static PetscErrorCode CheckBending(void)
{
  const double kappa = 1e-6, tension = 1e6 * 0.25 * kappa;
  double *x, inside = 0.0;
  const double *force;
  Model a = {0};
  Solid s;
  PetscCall(Square(LAW_NEO_HOOKEAN, 1, &a, &s));
  const SolidView v = ViewOf(s, &x, NULL);
  for (int n = 0; n < v.nnodes; n++) {
    const Point p = PointAt(v.rest, n);
    x[2 * n] += kappa * p.x * p.y;
    x[2 * n + 1] -= 0.5 * kappa * (p.x * p.x + 0.3 * p.y * p.y);
  }
  PetscCall(SolidForces(s, &force));
  for (int n = 0; n < v.nnodes; n++)
    if (fabs(v.rest[2 * n]) < 0.4999 && fabs(v.rest[2 * n + 1]) < 0.4999)
      inside = fmax(inside, hypot(force[2 * n], force[2 * n + 1]));
  CHECK(inside < 1e-5 * 0.25 * tension, "bending leaves %g inside, of a tension of %g N/m", inside, tension);
  double *stress = calloc(3 * (size_t)v.nelements, sizeof *stress), worst = 0.0;
  SolidStress(s, stress);
  for (int e = 0; e < v.nelements; e++) {
    const int *n = v.element + 3 * e;
    const double y = (v.rest[2 * n[0] + 1] + v.rest[2 * n[1] + 1] + v.rest[2 * n[2] + 1]) / 3.0;
    worst = fmax(worst, fabs(stress[3 * e] - 1e6 * kappa * y));
    worst = fmax(worst, fmax(fabs(stress[3 * e + 1]), fabs(stress[3 * e + 2])));
  }
  CHECK(worst < 1e-5 * 1e6 * kappa, "stress is %g off", worst);
  free(stress);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

static void CheckJoints(void)
{
  const double centre[2] = {0.0, 0.0};
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1e6, 0.3, 0.0));
  double *none = NULL;
  const char *why = NULL;
  Model a = {0};
  MeshSerial m;
  setup.joints.all = setup.six_node = 1;
  (void)ShapeRectangle(centre, 1.0, 1.0, 0.0, 0.5, &m);
  (void)SixNodeSplit(&m, &none);
  CHECK(ModelAdd(&a, &m, &setup, &why) && strstr(why, "six-node"), "joints: %s", why);
  (void)MeshSerialDestroy(&m);
  (void)ModelDestroy(&a);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  CheckSplit();
  for (int k = 0; k < 4; k++) PetscCall(CheckForces(k / 2, k % 2));
  PetscCall(CheckBending());
  CheckJoints();
  return PetscFinalize();
}
