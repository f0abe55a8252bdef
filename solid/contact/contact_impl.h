/* The contact's own data, for contact.c, contact_search.c and contact_pair.c. */
#ifndef SOLID_CONTACT_IMPL_H
#define SOLID_CONTACT_IMPL_H
#include "solid/contact/contact_halo.h"
#include "solid/contact/contact_kernel.h"
#include "solid/solid_impl.h"

enum { JOINED = -5 }; /* in place of a wall: an active joint holds both */

/* An edge that may touch a target before the next search. */
typedef struct {
  int facet, target, pair;
  double strength; /* p times the target's rest area doubled: over its area now, that is p/J */
} Candidate;

/* Contacting couple (Munjiza): two elements, facets of which are candidates against the other.  Two triangles that do not
 * overlap lie on either side of a line along a side of one of them: while they do along the one that did last, none of
 * the candidates touches. */
typedef struct {
  int target[2];   /* the first is this rank's */
  int node[2][3];  /* theirs */
  int first, n;    /* candidates */
  int separating;  /* side i, opposite to node i, of target[0], or 3 + i of target[1]; -1: none is known */
  double distance; /* when searched, not less is between them, m */
  PetscBool discs; /* one is of a rigid disc, or both */
} Couple;

/* An edge that may touch a wall. */
typedef struct {
  int facet, axis, pair;
  double outward, at; /* -1 or 1, and the wall's coordinate */
} WallCandidate;

/* One edge and all that it touches of one material of one body (its own too) or of a wall: friction has its history here, so that
 * it does not start anew when the edge slides from one element of the other to the next. */
typedef struct {
  int facet, other; /* other: a body, or a wall < 0 */
  int material;     /* the other's; 0 of a wall */
  int edge;         /* 3 element + side: the facet, whatever its number becomes */
  int next;         /* pair of the same facet, -1: none */
  ContactLaw law;
  double slip; /* of the spring when the last substep began, m */
  double now;  /* with the motion of the last substep */
  /* this evaluation's sums over targets */
  double normal, inside, vn, vt; /* N; share of the edge; velocities times the normal force */
  double phi, largest_phi;       /* its mean over the edge; its maximum */
  ContactResponse response;
} Pair;

/* Of a body's surface at rest, m. */
typedef struct {
  double longest; /* edge */
  double side;    /* a quarter of its perimeter */
} Extent;

/* What is kept of a pair while candidates are searched or a step is redone. */
typedef struct {
  int edge, other, material;
  double slip;
} Slip;

typedef struct {
  int n, capacity;
  Slip *slip;
} Slips;

/* A candidate that touches now. */
typedef struct {
  int couple;   /* -1 - k: wall candidate k */
  int of, side; /* the edge is that of target[of] from node `side` to the next; unset at a wall */
  int pair;
  double scale; /* of the integrals to a force over the edge's length, N/m */
  Point along;  /* from the edge's start to its end, m */
  ContactIntegrals integrals;
} ActivePair;

struct Contact_s {
  int ntargets, nall;          /* this rank's; with those of the halo */
  Target *target;              /* [nall] */
  int *facet_start, *facet;    /* [ntargets + 1], [nfaces] a target's facets */
  int ncontactors, *contactor; /* [ncontactors] targets that have facets */
  int *contactor_of;           /* [ntargets] its place among them, or -1 */
  int *facet_target;           /* [nfaces] */
  int ncandidates, candidate_capacity, nwalls, wall_capacity, npairs, pair_capacity, nactive, active_capacity;
  int ncouples, couple_capacity;
  Candidate *candidate;
  Couple *couple;
  WallCandidate *wall;
  Pair *pair;
  ActivePair *active;     /* [nactive] */
  int nnear, *near;       /* [couple_capacity] couples that may touch before the next check of motion */
  int npressed, *pressed; /* [pair_capacity] pairs whose sums and response are not 0 */
  int *first_pair;        /* [nfaces] -1: none */
  Slips history, saved;
  PetscBool restored; /* history, not the pairs, holds the slips */
  PetscBool rough;    /* any friction or damping: velocities are needed */
  Halo halo;          /* NULL on one rank */
  double *height;     /* [nbodies] smallest height of the surface elements at rest, m */
  Extent *extent;     /* [nbodies] */
  int nholding;       /* prescribed motions that hold their nodes, in what follows */
  double *compliance; /* [nbodies] largest (half the edges' lengths at a node)/(its mass), m/kg; 0: held */
  double *intact_compliance; /* [nbodies] that before any crack, of prescribed bodies too */
  double *mass;              /* [nbodies] of what can move, kg/m; HUGE_VAL: held as a whole */
  double *areal_mass; /* [nbodies] mass behind a metre of surface, 4 M/perimeter, kg/m2; HUGE_VAL: likewise */
  double *searched;   /* [nnodes][2] positions of the last search */
  double shortest_buffer;
  double *skin;    /* [nbodies] half of it, or what a fast body needs: candidates lie within both bodies' */
  double *bulge;   /* [nbodies] of a rigid disc: by how much the circle lies beyond its edges, m; else 0 */
  double *margin;  /* [nbodies] skin and bulge */
  double *waiting; /* [nbodies] m: least distance of the body's pairs that are no candidates yet */
  Point walls;     /* what they did to this rank's edges, N */
  double rate[4];  /* bounds of omega^2 by bodies and by walls, 1/s2; of 2 xi omega by both, 1/s */
};

static inline Point ContactPosition(const Contact c, const Solid s, int node)
{
  return node < s->nnodes ? PointAt(s->x, node) : PointAt(HaloPositions(c->halo), node - s->nnodes);
}

/* An active joint holds them together. */
static inline PetscBool ContactJoined(const Solid s, int facet, const Target *t)
{
  return (PetscBool)(s->facet_across[facet] == t->number);
}

static inline double ContactRestLength(const Solid s, int facet)
{
  const int *edge = s->facet + 2 * facet;
  return sqrt(PointSquared(PointMinus(PointAt(s->rest, edge[1]), PointAt(s->rest, edge[0]))));
}

static inline PetscBool ContactIsDisc(const Solid s, int body)
{
  return (PetscBool)(s->body[body].circle > 0.0);
}

/* contact.c: collective, before a search: masses are those of what prescribed motions hold until the step's end. */
PetscErrorCode ContactHold(Contact c, Solid s);

/* contact_near.c */
/* Farther than both bodies' skins they cannot touch before the next search.  Of one body: a pair that shares a node
 * never touches by itself, neighbours at rest only once they have come closer, and a buffer that is long
 * because the body as a whole is fast is not needed.  *distance: not less is between them. */
PetscBool ContactMayBeActive(const Contact c, const Solid s, int facet, const Target *t, double *distance);

/* contact_discs.c */
/* The sector of each target of rigid discs, and c->bulge: collective. */
PetscErrorCode DiscsMeasure(Contact c, const Solid s);
/* Scale, direction and integrals of a candidate, one of whose targets at least is a disc's; contactor: the target of its edge.  0: they do not touch. */
int DiscActive(const Contact c, const Solid s, const Candidate *candidate, int contactor, ActivePair *a);
/* Direction and integrals. */
int DiscActiveAtWall(const Contact c, const Solid s, const WallCandidate *w, ActivePair *a);

/* contact_forces.c: Couple.separating as it is now. */
int ContactSeparatingSide(const Contact c, const Solid s, const Couple *k);

/* contact_pair.c */
/* The pair of the facet and the other's material, made with the slip that history has of it. */
PetscErrorCode ContactPairOf(Contact c, Solid s, int facet, int other, int material, ContactLaw law,
                             int *pair);
/* The slips that there are, sorted; borrowed until the next search. */
PetscErrorCode ContactSlips(Contact c, int *n, const Slip **slip);
/* Puts the pairs' slips into history, for those that the next search makes; there are none till then. */
PetscErrorCode ContactForgetPairs(Contact c);
/* The springs of a contact that has no pairs yet; sorts them. */
PetscErrorCode ContactTakeSlips(Contact c, int n, Slip slip[]);
/* Friction and damping of two materials; other < 0: the walls. */
void ContactMaterials(const Solid s, int material, int other, double *friction, double *damping);
#endif
