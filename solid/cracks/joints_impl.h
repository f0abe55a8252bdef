/* The joints' own data, for joints_create.c, joints.c and break.c.
 *
 *        \  1 /         The star of a node that has joints: the corners of all elements there, on whatever
 * rank, 0  \  /  2       and the edges between them, that tie two corners each.  A tie is cut when its joint
 * comes to
 *     -----\/-----      life; corners that ties still connect are one node.  The corners of a node that has
 * split get 5   /\   3       a node of their own for each connected part; the part with the lowest corner
 * keeps the old /  4 \         one.  All ranks that have the node have all its parts, and their stars are the
 * same. */
#ifndef SOLID_JOINTS_IMPL_H
#define SOLID_JOINTS_IMPL_H
#include "solid/cracks/joint.h"
#include "solid/solid_impl.h"
#include <stdint.h>

enum { STAR_CORNERS = 64 }; /* of one node, at most: bits of a Fan */

typedef uint64_t Fan; /* some of a star's corners */

typedef struct {
  int element, corner; /* in the assembly */
  int place;           /* this rank's element k, elements.n + g for ghost g, or -1 */
  int node;            /* local, now */
  double mass;
} Corner;

typedef struct {
  int corner[2]; /* within the star */
  int joint;     /* on this rank, or -1: never cut */
} Tie;

/* Another rank's element that this rank looks at. */
typedef struct {
  int node[3];
  Tensor inverse;
  ElementLaw law;
  Point force[3];
} Ghost;

typedef enum { JOINT_WHOLE, JOINT_LIVE, JOINT_BROKEN } JointStage;

/* What a step changes. */
typedef struct {
  JointStage stage;
  int since[2]; /* revisions of the solid with which it came to life, and with which it broke; 0: not yet */
  JointEnd end[2]; /* strong = 0: its nodes are still one */
} JointMemory;

typedef struct {
  int number;        /* the same on all ranks */
  int first, second; /* its elements, in the assembly */
  int body;
  int place[2];     /* its elements, as in Corner */
  int side[2];      /* of its elements */
  int star[2];      /* of its ends, -1: not on this rank */
  int corner[2][2]; /* [end][element] in corner, where this rank has both elements */
  PetscBool held;   /* this rank has both elements and follows the joint; */
  PetscBool mine;   /* it has the first of them, and adds the forces */
  double length;    /* at rest, m */
  JointLaw law;
} Joint;

/* Whole joints with both ends within the body that this rank adds the forces of: what is looked at in every
 * substep, as arrays, so that the loop is vectorised. */
typedef struct {
  int n, *joint;
  int *place[2], *node[2];
  double *inverse_square[2]; /* of the strengths, 1/Pa2 */
  double *friction;
} Watch;

/* An end of a whole joint of this rank at the surface or at the tip of a crack: if its tie is cut its node
 * splits, one part with the fan of element 0 and another with that of element 1. */
typedef struct {
  int joint, end;
  Fan fan[2];
  double width; /* of the joints between the fans there, half their lengths, m */
} Brink;

struct Joints_s {
  int nstars, ncorners, nties;
  int *star_corner, *star_tie; /* [nstars + 1] */
  Corner *corner, *saved_corner;
  Tie *tie;
  int n, nghosts; /* joints with an end on this rank, by number */
  Joint *joint;
  JointMemory *memory, *saved; /* [n] */
  Ghost *ghost;
  int nlive;
  int *live; /* [n] held joints that are alive */
  Watch watch;
  int nbrinks;
  Brink *brink;        /* [2 n] */
  char (*edge)[2];     /* [n] that end is on the brink, while its joint is whole */
  int *touched;        /* [nstars] scratch: the star's ties have been cut; */
  int ntouched, *cut;  /* [ntouched] those stars */
  long long first_gid; /* corner i of element e makes node first_gid + 3 e + i */
  double rate;         /* 1/s2, over all ranks */
};

/* brink.c */
/* Finds anew the ends on the brink of the stars that are touched, or of all. */
void JointsFindBrinks(Joints j, Solid s, PetscBool all);
/* Forces and stresses of other ranks' elements, as SolidInternalForces has left this rank's. */
void JointsGhostForces(Joints j, Solid s);
/* The traction, Pa, with which element 1's fan holds element 0's at an end: of the whole joint on the brink,
 * or of a living one whose nodes have parted. */
Point JointsBrinkTraction(Joints j, Solid s, const Brink *b);
Brink JointsPartedBrink(Joints j, int joint, int end);

/* joints.c: lists of living and of whole joints, and the ends that have just parted. */
void JointsList(Joints j, Solid s);
void JointsBeginEnds(Joints j, Solid s);
PetscErrorCode JointsMeasureRate(Joints j, Solid s);

/* break.c: the joint of that number, or -1. */
int JointsFind(Joints j, int number);
/* break.c: collective: event[n] as in joints.c, the same on all ranks, ascending. */
PetscErrorCode JointsApply(Joints j, Solid s, int n, const int event[]);
#endif
