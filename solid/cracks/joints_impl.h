/* The joints' own data, for the files of cracks/.
 *
 * Cohesive zone model: an interior edge at which two elements may part is a joint.  It is intact (an ordinary edge of a
 * conforming mesh) until the stress beside it reaches its strength (initiation), then active (a cohesive traction
 * between two edges that open, joint.h), then broken (two facets of the surface).
 *
 *         \  1 /        The star of a node that has joints: the corners of all elements there, on whatever rank, and
 *       0  \  /  2      the bonds between them, one for each edge between two corners.  A bond is cut when its joint
 *      -----\/-----     activates; corners that bonds still connect are one node.  The corners of a node that has
 *       5   /\   3      split get a node of their own for each connected part; the part with the lowest corner keeps
 *          /4 \         the old one.  All ranks that have the node have all its parts, and their stars are the same. */
#ifndef SOLID_JOINTS_IMPL_H
#define SOLID_JOINTS_IMPL_H
#include "solid/cracks/joint.h"
#include "solid/solid_impl.h"
#include <stdint.h>

enum { STAR_CORNERS = 64 }; /* of one node, at most: bits of a CornerSet */

typedef uint64_t CornerSet; /* some of a star's corners */

typedef struct {
  int element, corner; /* in the model */
  int place;           /* this rank's element k, elements.n + g for ghost g, or -1 */
  int node;            /* local, now */
  double mass;
} Corner;

typedef struct {
  int corner[2]; /* within the star */
  int joint;     /* on this rank, or -1: never cut */
} Bond;

/* Another rank's element at a node with joints of this rank; its stress and forces are computed here too. */
typedef struct {
  int node[3];
  Tensor inverse;
  ElementLaw law;
  Point force[3];
} Ghost;

typedef enum { JOINT_INTACT, JOINT_ACTIVE, JOINT_BROKEN } JointStage;

/* What a step changes. */
typedef struct {
  JointStage stage;
  int since[2]; /* revisions of the solid with which it activated, and with which it broke; 0: not yet */
  JointEnd end[2];
} JointMemory;

typedef struct {
  int number;        /* the same on all ranks */
  int first, second; /* its elements, in the model */
  int body;
  int material;       /* its own, -1: it has none */
  int place[2];       /* its elements, as in Corner */
  int side[2];        /* of its elements */
  int star[2];        /* of its ends, -1: not on this rank */
  int corner[2][2];   /* [end][element] in corner, where this rank has both elements */
  PetscBool followed; /* this rank has both elements and follows the joint; */
  PetscBool mine;     /* it has the first of them, and adds the forces */
  double length;      /* at rest, m */
  JointLaw law;
} Joint;

/* Initiation list: intact joints with both ends within the body that this rank adds the forces of.  Their load is
 * compared with their strength in every substep; arrays, so that the loop is vectorised. */
typedef struct {
  int n, *joint;
  int *place[2], *node[2];
  double *inverse_square[2]; /* of the strengths, 1/Pa2 */
  double *friction;
} InitiationList;

/* An end of an intact joint of this rank at the surface or at the tip of a crack: if its bond is cut its node
 * splits, one part with the corner set of element 0 and another with that of element 1. */
typedef struct {
  int joint, end;
  CornerSet corners[2];
  double width; /* of the joints between the corner sets there, half their lengths, m */
} CrackTip;

struct Joints_s {
  int nstars, ncorners, nbonds;
  int *star_corner, *star_bond; /* [nstars + 1] */
  Corner *corner, *saved_corner;
  Bond *bond;
  int n, nghosts; /* joints with an end on this rank, by number */
  Joint *joint;
  JointMemory *memory, *saved; /* [n] */
  Ghost *ghost;
  int nactive;
  int *active; /* [n] followed joints that are active */
  InitiationList initiation;
  int nacting; /* prescribed motions that acted when all crack tips were found */
  int ntips;
  CrackTip *tip;       /* [2 n] */
  char (*at_tip)[2];   /* [n] that end is at a crack tip or the surface, while its joint is intact */
  int *marked;         /* [nstars] scratch: the star's bonds have been cut; */
  int nmarked, *cut;   /* [nmarked] those stars */
  long long first_gid; /* corner i of element e makes node first_gid + 3 e + i */
  double rate;         /* 1/s2, over all ranks */
};

/* crack_tip.c */
/* Finds anew the crack-tip ends of the marked stars, or of all. */
void JointsFindCrackTips(Joints j, Solid s, PetscBool all);
/* The same of all where prescribed motions have let go of their nodes since, or, in a step that is redone, have not yet. */
void JointsFollowMotions(Joints j, Solid s);
/* Forces and stresses of other ranks' elements, as SolidInternalForces has left this rank's. */
void JointsGhostForces(Joints j, Solid s);
/* The traction, Pa, that element 1's corner set exerts on element 0's at an end: of the intact joint at the
 * crack tip, or of an active one whose nodes have parted. */
Point JointsCrackTipTraction(Joints j, Solid s, const CrackTip *b);
CrackTip JointsPartedCrackTip(Joints j, int joint, int end);

/* joints.c: lists of active and of intact joints, and the ends that have just parted. */
void JointsList(Joints j);
void JointsBeginEnds(Joints j, Solid s);
PetscErrorCode JointsMeasureRate(Joints j, Solid s);

/* split.c: root[c]: the lowest of a star's corners that those of bond[n] which are not cut connect with c. */
void JointsConnectCorners(const Joints j, int ncorners, int n, const Bond bond[], int root[]);
/* The corners of a star that bonds still connect are one node, the others get one of their own. */
void JointsSplitStar(Joints j, Solid s, int star);
/* The nodes of saved_corner again. */
void JointsRestoreStar(Joints j, Solid s, int star);
/* Parts of a prescribed node have its prescribed motion. */
PetscErrorCode JointsPrescribeParts(Solid s);

/* break.c: the joint of that number, or -1. */
int JointsFind(Joints j, int number);
/* break.c: collective: event[n] as in joints.c, the same on all ranks, ascending. */
PetscErrorCode JointsApply(Joints j, Solid s, int n, const int event[]);
#endif
