// ranks: 1 2 3
/* What is in excess of an element's capacity goes into the nearest elements with room, against their filler: each phase's volume
 * and each element's is kept, nothing leaves [0, area], what is swept says how it came there, and no excess is left. */
#include "tests/phases/flows.h"
#include "tests/phases/set.h"

enum { WATER, FILLER, NPHASES };

/* What of an element is water at the start, and what of it may be water, by its centroid. */
typedef struct {
  const char *name;
  double (*share)(double x, double y), (*capacity)(double x, double y);
} Situation;

/* Water fills 0.6 of the elements below 0.5; those between 0.46 and 0.5, one layer, have room for 0.45 of it. */
static double Shallow(double x, double y)
{
  (void)x;
  return y < 0.5 ? 0.6 : 0.0;
}

static double Layer(double x, double y)
{
  (void)x;
  return y > 0.46 && y < 0.5 ? 0.45 : 1.0;
}

static int InPlate(double x, double y)
{
  return x < 0.7 && y > 0.4 && y < 0.6;
}

static int InBody(double x, double y)
{
  return x > 0.1 && x < 0.4 && y > 0.1 && y < 0.3;
}

/* Water fills all below 0.8 but a plate from the left wall; below the plate a body of 0.4 of its elements is full of water. */
static double Deep(double x, double y)
{
  return y < 0.8 && !InPlate(x, y) ? 1.0 : 0.0;
}

static double PlateAndBody(double x, double y)
{
  return InPlate(x, y) ? 0.0 : InBody(x, y) ? 0.6 : 1.0;
}

static const Situation SITUATIONS[] = {{"shallow", Shallow, Layer}, {"deep", Deep, PlateAndBody}};

static double AtCentroid(double (*function)(double x, double y), const StarElement *e)
{
  return function((e->x[0][0] + e->x[1][0] + e->x[2][0]) / 3.0, (e->x[0][1] + e->x[1][1] + e->x[2][1]) / 3.0);
}

static void CheckElement(const Set *s, int e, const Situation *is, const double volume[],
                         const double swept[])
{
  const StarElement *element = &s->stars->element[e];
  const double area = StarsArea(s->stars, e), *v = &volume[NPHASES * e];
  const double capacity = AtCentroid(is->capacity, element);
  double before = AtCentroid(is->share, element) * area;
  for (int i = 0; i < 3; i++) {
    const double out = swept[NPHASES * (3 * e + i) + WATER];
    CHECK(capacity > 0.0 || out == 0.0, "%s, element %d: %g m2 of water pass the plate", is->name, e, out);
    before -= out;
  }
  CHECK(fabs(v[WATER] + v[FILLER] - area) < 1e-14, "%s, element %d: %g m2 of %g", is->name, e,
        v[WATER] + v[FILLER], area);
  CHECK(v[WATER] > -1e-15 && v[FILLER] > -1e-15, "%s, element %d: volumes %g and %g", is->name, e, v[WATER],
        v[FILLER]);
  CHECK(fabs(v[WATER] - before) < 1e-14, "%s, element %d: the faces passed otherwise than its volume changed",
        is->name, e);
  CHECK(v[WATER] < (capacity + 1e-12) * area, "%s, element %d: excess of %g m2", is->name, e,
        v[WATER] - capacity * area);
}

static PetscErrorCode Check(const Set *s, const Situation *is)
{
  double *volume, *capacity, *swept, sum[2] = {0.0, 0.0};
  const double *now;
  const int ne = s->mesh->ne;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(NPHASES * ne, &volume, ne, &capacity, 3 * NPHASES * ne, &swept));
  PetscCall(PetscArrayzero(swept, 3 * NPHASES * ne));
  for (int e = 0; e < ne; e++) {
    const double area = StarsArea(s->stars, e);
    volume[NPHASES * e + WATER] = AtCentroid(is->share, &s->stars->element[e]) * area;
    volume[NPHASES * e + FILLER] = area - volume[NPHASES * e + WATER];
    capacity[e] = AtCentroid(is->capacity, &s->stars->element[e]) * area;
    sum[0] += volume[NPHASES * e + WATER];
  }
  PetscCall(PhasesSetVolumes(s->phases, volume));
  PetscCall(PhasesExpel(s->phases, WATER, FILLER, capacity, NULL, swept));
  PetscCall(PhasesGetVolumes(s->phases, &now));
  for (int e = 0; e < ne; e++) {
    CheckElement(s, e, is, now, swept);
    sum[1] += now[NPHASES * e + WATER];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->mesh->comm));
  CHECK(fabs(sum[1] - sum[0]) < 1e-14, "%s: %.16g m2 of water become %.16g", is->name, sum[0], sum[1]);
  PetscCall(PetscFree3(volume, capacity, swept));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const Shaken shaken = {.n = 12, .seed = 3u, .radius = 1.0};
  Mesh *mesh;
  Set s;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  PetscCall(SetMake(mesh, NPHASES, &s));
  for (size_t k = 0; k < sizeof SITUATIONS / sizeof *SITUATIONS; k++) PetscCall(Check(&s, &SITUATIONS[k]));
  PetscCall(SetDestroy(&s));
  return PetscFinalize();
}
