// ranks: 1 2 3
/* What is in excess of an element's capacity goes into neighbours, against their filler: each phase's volume and each element's
 * is kept, nothing leaves [0, area], what is swept says how it came there, and where there is room no excess is left. */
#include "tests/phases/flows.h"
#include "tests/phases/set.h"

enum { WATER, FILLER, NPHASES };

/* Water fills 0.6 of the elements below 0.5; those between 0.46 and 0.5, one layer, have room for 0.45 of it. */
static double Share(const StarElement *e)
{
  return e->x[0][1] + e->x[1][1] + e->x[2][1] < 1.5 ? 0.6 : 0.0;
}

static double Capacity(const StarElement *e)
{
  const double y = (e->x[0][1] + e->x[1][1] + e->x[2][1]) / 3.0;
  return y > 0.46 && y < 0.5 ? 0.45 : 1.0;
}

static void CheckElement(const Set *s, int e, const double capacity[], const double volume[],
                         const double swept[])
{
  const double area = 0.5 * StarsTwiceArea(s->stars, e), *v = &volume[NPHASES * e];
  double before = Share(&s->stars->element[e]) * area;
  for (int i = 0; i < 3; i++) before -= swept[NPHASES * (3 * e + i) + WATER];
  CHECK(fabs(v[WATER] + v[FILLER] - area) < 1e-14, "element %d: %g m2 of %g", e, v[WATER] + v[FILLER], area);
  CHECK(v[WATER] > -1e-15 && v[FILLER] > -1e-15, "element %d: volumes %g and %g", e, v[WATER], v[FILLER]);
  CHECK(fabs(v[WATER] - before) < 1e-15, "element %d: the faces passed otherwise than its volume changed", e);
  CHECK(v[WATER] < capacity[e] + 1e-12 * area, "element %d: excess of %g m2", e, v[WATER] - capacity[e]);
}

int main(int argc, char **argv)
{
  const Shaken shaken = {.n = 12, .seed = 3u, .radius = 1.0};
  double *volume, *capacity, *swept, sum[2] = {0.0, 0.0};
  const double *now;
  Mesh *mesh;
  Set s;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  PetscCall(SetMake(mesh, NPHASES, &s));
  PetscCall(PetscMalloc3(NPHASES * mesh->ne, &volume, mesh->ne, &capacity, 3 * NPHASES * mesh->ne, &swept));
  PetscCall(PetscArrayzero(swept, 3 * NPHASES * mesh->ne));
  for (int e = 0; e < mesh->ne; e++) {
    const double area = 0.5 * StarsTwiceArea(s.stars, e);
    volume[NPHASES * e + WATER] = Share(&s.stars->element[e]) * area;
    volume[NPHASES * e + FILLER] = area - volume[NPHASES * e + WATER];
    capacity[e] = Capacity(&s.stars->element[e]) * area;
    sum[0] += volume[NPHASES * e + WATER];
  }
  PetscCall(PhasesSetVolumes(s.phases, volume));
  PetscCall(PhasesExpel(s.phases, WATER, FILLER, capacity, swept));
  PetscCall(PhasesGetVolumes(s.phases, &now));
  for (int e = 0; e < mesh->ne; e++) {
    CheckElement(&s, e, capacity, now, swept);
    sum[1] += now[NPHASES * e + WATER];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, mesh->comm));
  CHECK(fabs(sum[1] - sum[0]) < 1e-14, "%.16g m2 of water become %.16g", sum[0], sum[1]);
  PetscCall(PetscFree3(volume, capacity, swept));
  PetscCall(SetDestroy(&s));
  return PetscFinalize();
}
