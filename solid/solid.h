/* The solid: deformable bodies by the combined finite-discrete element method (FEMDEM), explicit in time.
 * Elements are dealt out to ranks with METIS; a node at a border is on every rank that has one of its
 * elements, with the same bits.  A step is
 *
 *     SolidStart(s, dt, load)                 what the fluid does is constant over the step
 *     while (SolidRemaining(s))
 *       SolidSubstep(s, &h)                   v += h (f/m + g);  x += h v
 *     SolidStepFailure(s, &why)               not if an element has turned inside out
 *
 *     f = internal (element.h) + contact (contact_kernel.h) + load        [1] of the paper
 *
 * h = courant x the stability limit (SolidLimit), less so that the substeps fill dt.  Units are SI, per metre
 * of depth. All functions are collective over the communicator unless said otherwise; ranks without elements
 * are normal. */
#ifndef SOLID_H
#define SOLID_H
#include "common/output/checkpoint.h"
#include "common/program/gravity.h"
#include "solid/bodies/model.h"
#include "solid/spring.h"

typedef struct Solid_s *Solid;

#define CONTACT_WALLS "walls" /* their name in a rule */

/* Overrides, for two materials or a material and the walls, what follows from the materials: the geometric
 * means of their friction and of their contact damping. */
typedef struct {
  char between[2][MATERIAL_NAME];
  double friction, damping; /* < 0: not overridden */
} ContactRule;

enum { MAX_RULES = 32, MAX_CONTACT_PROBES = 64 };

/* In place of the number of another body: the walls, or all that a body touches. */
enum { CONTACT_ANY = -6, WALL_LEFT = -4, WALL_RIGHT, WALL_BOTTOM, WALL_TOP };

/* Two of which SolidContactProbes tells what they do to each other; body: the number of one. */
typedef struct {
  int body, other;
} ContactProbe;

typedef struct {
  double gravity[2];         /* m/s2, of the current step */
  TimeTable gravity_table;   /* of t, s, and gravity in its place, borrowed (gravity.h); nrows 0: none */
  double courant;            /* fraction of the stability limit, 0 .. 1 */
  double decay_rate;         /* 1/s, of the velocity of a body on which no force acts; 0: it keeps it */
  double rebalance;          /* SolidRebalance acts once so many substeps are lost; 0: never */
  PetscBool walls;           /* rigid walls around the tank */
  double lower[2], upper[2]; /* its corners, m */
  PetscBool rough_walls;     /* the next two hold where >= 0; else walls are like what touches them */
  double wall_friction, wall_damping;
  int nrules;
  ContactRule rule[MAX_RULES]; /* [nrules] the last that fits holds */
  int nsprings;
  Spring spring[MAX_SPRINGS]; /* [nsprings] */
  int ncontact_probes;
  ContactProbe contact_probe[MAX_CONTACT_PROBES]; /* [ncontact_probes] */
} SolidSetup;

/* model is borrowed during the call; the same on all ranks. */
PetscErrorCode SolidCreate(MPI_Comm comm, const Model *model, const SolidSetup *setup, Solid *solid);
PetscErrorCode SolidDestroy(Solid *solid);

/* load[nnodes][2]: this rank's part of the force on its nodes, N; summed over the ranks that share a node,
 * kept during the step; NULL: none. */
PetscErrorCode SolidStart(Solid s, double dt, const double load[]);
/* Not collective, before SolidStart: the films of fluid that yield in the step (CoracleGetFilm), this rank's part of load[nnodes][2], N, and
 * resistance[nnodes][2][2], N s/m, borrowed until the step has begun; NULL on all ranks or on none. */
void SolidSetFilm(Solid s, const double load[], const double resistance[]);
PetscBool SolidRemaining(Solid s); /* not collective, the same on all ranks */
/* *h: the substep just made. */
PetscErrorCode SolidSubstep(Solid s, double *h);
/* After the last substep: *why is NULL, or says which element, of any rank, has turned inside out; then the step is not made, and the solid good
 * for SolidState(s, 0) and SolidDestroy alone.  Borrowed until SolidStart, the same on all ranks. */
PetscErrorCode SolidStepFailure(Solid s, const char **why);
/* After the last substep: deals the elements out anew if the work has got out of balance, or bodies have come
 * to touch across ranks, so far that `rebalance` substeps of a perfectly shared solid have been lost since
 * the last check that was better.  Counts decide, never clocks: the same run does the same.  All local
 * numbers then are others, and the view's partition; nodes keep their gid, and everything its value.  Putting
 * a state back puts back the subdomain of that time too. */
PetscErrorCode SolidRebalance(Solid s);
/* The same to part[elements of the model], the same on all ranks: the rank that is to have each element.
 * Needs rebalance > 0. */
PetscErrorCode SolidRedistribute(Solid s, const int part[]);
/* What the solid sends the coupler of its motion (interface_motion.c). */
typedef struct {
  const double *u;            /* [nnodes][2] velocity, without the vibrations that steps of dt do not
                                 resolve, m/s */
  const double *mobility;     /* [nnodes] 1/kg, one over a third of its elements' mass; 0 where it is fixed */
  const double *acceleration; /* [nnodes][2] by all forces but the fluid's, m/s2 */
} InterfaceMotion;
/* Collective, after the last substep, when all is as at the step's end; borrowed until the next SolidStart.
 */
PetscErrorCode SolidUpdateInterfaceMotion(Solid s, InterfaceMotion *interface);
/* Not collective: the last result of SolidUpdateInterfaceMotion; before the first step the velocities, with
 * mobility 0. */
void SolidGetInterfaceMotion(Solid s, InterfaceMotion *interface);
/* Largest stable substep now, s: 4/(d + sqrt(d^2 + 4 w^2)), w^2 and d bounds of the elements' and contact's
 * frequencies and viscous rates. */
PetscErrorCode SolidLimit(Solid s, double *limit);
/* Saves (1) or puts back (0) what a step changes.  Not collective. */
PetscErrorCode SolidState(Solid s, int save);

/* Between two steps: all that the steps so far have made of the solid, into a checkpoint. */
PetscErrorCode SolidSave(Solid s, Checkpoint to);
/* Right after SolidCreate, from the same model on any number of ranks: the solid as it was at SolidSave,
 * with its time and its counters.  On as many ranks as then it continues with the same bits; on others the
 * elements are dealt out as suits the present state if there is `rebalance`, else as at the start.  A
 * checkpoint of other bodies is an error that says what has been expected and found.  There is no budget
 * before the next step. */
PetscErrorCode SolidLoad(Solid s, Checkpoint from);

/* Views: borrowed, not collective. */
typedef struct {
  int nnodes, nelements, nfacets, nbodies;
  int revision; /* changes when cracks have made new nodes, elements or facets; new nodes and facets come last
                 */
  int partition;        /* changes when elements have changed ranks: all local numbers are others */
  const long long *gid; /* [nnodes] */
  const double *rest, *x, *v, *load, *start; /* [nnodes][2]; start: x when the step began */
  const int *element,
      *facet;        /* [nelements][3], [nfacets][2] local nodes; facets have the solid on their left */
  const int *body;   /* [nelements] */
  const int *number; /* [nelements] in the model */
} SolidView;
void SolidGetView(Solid s, SolidView *view);

typedef struct {
  double t, dt;      /* s; dt: of the last step */
  int substeps;      /* of the last step */
  double h;          /* last substep, s */
  long long total;   /* substeps so far */
  int searches;      /* contact searches so far */
  int rebalanced;    /* times that elements have changed ranks */
  double seconds[6]; /* elements, contact, exchange between ranks, limit and search, joints, step response */
  long long response_iterations; /* conjugate gradients of interface_motion.c so far */
} SolidStats;
const SolidStats *SolidGetStats(Solid s);

/* Cauchy stress (xx, yy, xy), Pa, stress[nelements][3].  Not collective. */
void SolidStress(Solid s, double stress[]);
/* Strain energy per unit of rest volume, J/m3, density[nelements].  Not collective. */
void SolidEnergyDensity(Solid s, double density[]);

typedef struct {
  double mass;             /* kg/m */
  double inertia;          /* kg m about the mass centre */
  double x[2], v[2];       /* mass centre, m, and its velocity, m/s */
  double angular_velocity; /* rad/s: angular momentum over moment of inertia, about the mass centre */
  double angle;            /* rad, from -pi to pi: of the rotation that is nearest to its motion since rest */
  double load[2];          /* what the fluid does, N/m */
  double moment;           /* of it about the mass centre, counter-clockwise, N m/m */
  double kinetic,
      strain; /* J/m; kinetic at the time of x: sum m v.(v + h a)/2, a 0 where motions are prescribed */
  double reaction[2]; /* SolidBudget's of this body, mean over the last step, N/m */
  double contact
      [2]; /* the force of walls and other bodies, mean over the last step: what is left of its momentum's change, N/m */
} BodyState;
/* state[n]: of the first n bodies. */
PetscErrorCode SolidBodies(Solid s, int n, BodyState state[]);

/* The contact of two bodies, or of a body and a wall. */
typedef struct {
  int body, other;               /* other: a body, or WALL_LEFT to WALL_TOP; of a probe also CONTACT_ANY */
  double normal[2], friction[2]; /* force on the first, N/m; contact damping is in the normal one */
  double place[2]; /* mean of where the normal force acts, weighted with it, m; NaN where nothing touches */
} BodyContact;
/* Collective: of all that touch now, on the first rank; no contact within a body.  The lesser number is `body`.  The caller frees it. */
PetscErrorCode SolidContacts(Solid s, int *n, BodyContact **contact);
/* Collective: contact[contact probes of the setup], means over the last step. */
PetscErrorCode SolidContactProbes(Solid s, BodyContact contact[]);

/* What acted on all bodies over the last step.  Momentum: the change of sum m v is load dt + walls + reaction + m
 * g dt, to round-off. */
typedef struct {
  double walls[2],
      reaction
          [2]; /* impulse of the tank's walls; of what holds fixed and prescribed nodes, of springs, loads, of the
                      * decay rate and of damping (interface_motion.c), N s/m */
  double work, reaction_work; /* of the fluid; of what drives nodes, J/m */
  double
      contact_loss; /* what friction and damping of contact took, with what springs of friction hold, J/m */
  double start[2], momentum[2]; /* of all bodies, what it begins and ends with, N s/m */
  double load[2], weight[2];    /* the fluid's and gravity's force, N/m */
} SolidBudget;
PetscErrorCode SolidGetBudget(Solid s, SolidBudget *budget);
/* Collective.  With what the prescribed motions of this name hold and move their nodes, mean over the last step: force, N/m, its moment about the pivot, of
 * motions that do not turn about the origin, counter-clockwise, N, and its power, W/m. */
PetscErrorCode SolidMotionReaction(Solid s, const char *name, double reaction[4]);
/* state[springs of the setup] now. */
PetscErrorCode SolidSprings(Solid s, SpringState state[]);

typedef struct {
  int active, broken; /* joints that have activate and are not broken yet; that are broken */
  int pieces;         /* that intact and active joints hold together */
  double length;      /* of the cracks, m: edges and half edges that hold no more; half of the new surface */
  double energy;      /* what all joints have taken up and not given back, J/m; a broken one keeps it */
  double debonded;    /* the part of it of the edges and half edges that hold no more, J/m */
} FractureState;
PetscErrorCode SolidFracture(Solid s, FractureState *state);
/* damage[nelements]: largest D of the element's joints, 0 .. 1.  Not collective. */
void SolidDamage(Solid s, double damage[]);
/* fragment[nelements]: 0 .. *n - 1, in order of the lowest node: pieces that intact and active joints hold
 * together. */
PetscErrorCode SolidFragments(Solid s, int fragment[], int *n);
/* Internal, joint and contact forces at the present state, force[nnodes][2], N, summed over ranks; borrowed
 * until the next call of anything. */
PetscErrorCode SolidForces(Solid s, const double **force);
#endif
