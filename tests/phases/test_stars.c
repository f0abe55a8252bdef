// ranks: 1 2 3 5
/* Stars are whole on every rank: their angles close, their elements are the same everywhere and in the same
 * order; what owners have arrives. */
#include "tests/phases/flows.h"

/* Angle of element e at corner i. */
static double Angle(const StarElement *e, int i)
{
  const double *o = e->x[i], *p = e->x[(i + 1) % 3], *q = e->x[(i + 2) % 3];
  return atan2(GeometryTurn(o, p, q), (p[0] - o[0]) * (q[0] - o[0]) + (p[1] - o[1]) * (q[1] - o[1]));
}

static double Full(const double x[2])
{
  const int sides = (x[0] <= 0.0 || x[0] >= 1.0) + (x[1] <= 0.0 || x[1] >= 1.0);
  return sides == 0 ? 2.0 * M_PI : sides == 1 ? M_PI : 0.5 * M_PI;
}

static void CheckStar(const Stars *s, int v)
{
  double sum = 0.0;
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    const StarElement *e = &s->element[s->around[k] / 3];
    sum += Angle(e, s->around[k] % 3);
    CHECK(e->vertex[s->around[k] % 3] == s->gid[v] && s->vertex[s->around[k] / 3][s->around[k] % 3] == v,
          "element %d around vertex %d", (int)e->egid, (int)s->gid[v]);
    CHECK(k == s->start[v] || s->element[s->around[k - 1] / 3].egid < e->egid, "order around vertex %d",
          (int)s->gid[v]);
  }
  CHECK(fabs(sum - Full(s->point[v])) < 1e-10, "vertex %d of %d: its elements fill an angle of %g", v,
        s->nwhole, sum);
}

/* Owners' places arrive under the right element. */
static void CheckExchange(const Stars *s)
{
  double(*x)[6] = malloc((size_t)(s->nl + 1) * sizeof *x);
  for (int e = 0; e < s->ne; e++) memcpy(x[e], s->element[e].x, sizeof *x);
  StarsExchange(s, sizeof *x, x);
  for (int e = 0; e < s->nl; e++) {
    CHECK(!memcmp(x[e], s->element[e].x, sizeof *x), "element %d is another one at its owner",
          (int)s->element[e].egid);
    for (int i = 0; i < 3; i++) {
      const int o = s->neighbor[e][i];
      CHECK(s->element[e].ring > 1 || (o < 0) == (s->element[e].tag[i] >= 0), "face %d of element %d", i, e);
    }
  }
  free(x);
}

int main(int argc, char **argv)
{
  Mesh *mesh;
  Stars *stars;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UnstructuredMesh(PETSC_COMM_WORLD, 0.06, &mesh));
  PetscCall(StarsCreate(mesh, &stars));
  for (int v = 0; v < stars->nwhole; v++) CheckStar(stars, v);
  CheckExchange(stars);
  PetscCall(StarsDestroy(&stars));
  PetscCall(MeshDestroy(&mesh));
  return PetscFinalize();
}
