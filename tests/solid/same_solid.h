/* Two solids on the same ranks whose states have the same bits. */
#ifndef TESTS_SOLID_SAME_SOLID_H
#define TESTS_SOLID_SAME_SOLID_H
#include "solid/cracks/joints_impl.h"
#include "tests/solid/breaking.h"

static inline void SameNumbers(const char *what, int n, const double one[], const double two[])
{
  for (int k = 0; k < n; k++)
    CHECK(!memcmp(&one[k], &two[k], sizeof *one), "%s %d: %.17g and %.17g", what, k, one[k], two[k]);
}

static inline void SameNodes(Solid one, Solid two)
{
  const SolidView a = ViewOf(one, NULL, NULL), b = ViewOf(two, NULL, NULL);
  InterfaceMotion interface[2];
  CHECK(a.nnodes == b.nnodes && a.nelements == b.nelements && a.nfacets == b.nfacets &&
            a.revision == b.revision,
        "%d and %d nodes, %d and %d elements, %d and %d facets, revisions %d and %d", a.nnodes, b.nnodes,
        a.nelements, b.nelements, a.nfacets, b.nfacets, a.revision, b.revision);
  for (int n = 0; n < a.nnodes; n++)
    CHECK(a.gid[n] == b.gid[n], "node %d is %lld and %lld", n, a.gid[n], b.gid[n]);
  for (int k = 0; k < 2 * a.nfacets; k++) CHECK(a.facet[k] == b.facet[k], "facet %d differs", k / 2);
  SolidGetInterfaceMotion(one, &interface[0]);
  SolidGetInterfaceMotion(two, &interface[1]);
  SameNumbers("position", 2 * a.nnodes, a.x, b.x);
  SameNumbers("velocity", 2 * a.nnodes, a.v, b.v);
  SameNumbers("start", 2 * a.nnodes, a.start, b.start);
  SameNumbers("load", 2 * a.nnodes, a.load, b.load);
  SameNumbers("interface velocity", 2 * a.nnodes, interface[0].u, interface[1].u);
  SameNumbers("mobility", a.nnodes, interface[0].mobility, interface[1].mobility);
  SameNumbers("acceleration", 2 * a.nnodes, interface[0].acceleration, interface[1].acceleration);
}

/* Of joints that two ranks follow the owner's is the one that counts; the other's last bits may differ. */
static inline void SameJoints(Solid one, Solid two)
{
  const SolidView v = ViewOf(one, NULL, NULL);
  double *damage = malloc((2 * (size_t)v.nelements + 1) * sizeof *damage), *loaded = damage + v.nelements;
  SolidDamage(one, damage);
  SolidDamage(two, loaded);
  for (int e = 0; e < v.nelements; e++)
    CHECK(fabs(damage[e] - loaded[e]) < 1e-12, "damage of element %d: %.17g and %.17g", e, damage[e],
          loaded[e]);
  free(damage);
  for (int k = 0; one->joints && k < one->joints->n; k++) {
    const JointMemory *a = &one->joints->memory[k], *b = &two->joints->memory[k];
    CHECK(a->stage == b->stage, "stage %d and %d of joint %d", a->stage, b->stage, k);
    if (one->joints->joint[k].mine)
      SameNumbers("memory of a joint", 2 * (int)(sizeof(JointEnd) / sizeof(double)), &a->end[0].damage,
                  &b->end[0].damage);
  }
}

static inline PetscErrorCode SameSums(int nbodies, Solid one, Solid two)
{
  BodyState *body = calloc(2 * (size_t)nbodies, sizeof *body), *other = body + nbodies;
  FractureState f[2];
  PetscCall(SolidFracture(one, &f[0]));
  PetscCall(SolidFracture(two, &f[1]));
  CHECK(f[0].active == f[1].active && f[0].broken == f[1].broken && f[0].pieces == f[1].pieces,
        "%d and %d live joints, %d and %d broken, %d and %d pieces", f[0].active, f[1].active, f[0].broken,
        f[1].broken, f[0].pieces, f[1].pieces);
  SameNumbers("energy of fracture", 1, &f[0].energy, &f[1].energy);
  PetscCall(SolidBodies(one, nbodies, body));
  PetscCall(SolidBodies(two, nbodies, other));
  SameNumbers("state of the bodies", nbodies * (int)(sizeof(BodyState) / sizeof(double)), &body->mass,
              &other->mass);
  free(body);
  return 0;
}

static inline void SameStats(Solid one, Solid two)
{
  const SolidStats *a = SolidGetStats(one), *b = SolidGetStats(two);
  CHECK(a->total == b->total && a->substeps == b->substeps && a->searches == b->searches &&
            a->rebalanced == b->rebalanced,
        "%lld and %lld substeps, %d and %d in the last step, %d and %d searches, rebalanced %d and %d times",
        a->total, b->total, a->substeps, b->substeps, a->searches, b->searches, a->rebalanced, b->rebalanced);
  SameNumbers("time", 1, &a->t, &b->t);
  SameNumbers("substep", 1, &a->h, &b->h);
  SameNumbers("best and loss of balance", 2, &one->balance.best, &two->balance.best);
}
#endif
