/* The solid's own data, for the files of this room. */
#ifndef SOLID_IMPL_H
#define SOLID_IMPL_H
#include "common/exchange/copies.h"
#include "solid/cracks/interior_edges.h"
#include "solid/element.h"
#include "solid/solid.h"

typedef struct Contact_s *Contact;
typedef struct Joints_s *Joints;
typedef struct StepResponse_s *StepResponse;

/* What all subdomains are of, the same on all ranks. */
typedef struct {
  int elements, nodes, joints; /* nodes of the start */
} GlobalSizes;

enum { CONTACT_SUMS = 7 }; /* of a contact: normal and friction force, places, weight (contact_between.c) */

enum { STRIP = 64 }; /* elements that are gathered at a time: they stay in the first cache */

/* Structure of arrays, so that the element loop is vectorised. */
typedef struct {
  int n;
  int *node[3];         /* local nodes, counter-clockwise */
  double *inverse[4];   /* D0^-1: xx, xy, yx, yy of the rest edges' inverse, 1/m */
  int nsix, *six_first; /* [nsix] of the four elements of a six-node triangle, the first */
  int *six_node;        /* [n] SixNodePart */
  int *far[3];          /* of its corners: the next vertex, the last, the node between; else its own nodes */
  double *mu, *lambda, *eta, *density; /* times the thickness */
  double *thickness, *plane_stress;    /* m; 1 in plane stress, 0 in plane strain */
  double *kind;                        /* of law */
  int *body, *material;
  int *number;          /* in the model */
  double *force[2];     /* [3][n]: corner i of element e at i n + e; [nsix][6]: vertices, nodes after them */
  double *stress[3];    /* NULL without joints: elastic xx, yy, xy of the last forces, Pa times thickness */
  PetscBool damped;     /* any eta > 0 */
  char *held;           /* [n / STRIP + 1] all nodes of the strip's elements are fixed, or of rigid bodies: */
  PetscBool held_known; /* their forces are where they stay */
  char *bends;          /* [n / STRIP + 1] the strip has corners of six-node triangles */
  ElementLaws laws;     /* that any element has */
} Elements;

/* Which nodes of the start are also on which ranks. */
typedef struct {
  int n;
  CopiesMatch *node; /* [n] */
} SharedNodes;

/* How much the present subdomain loses against the best that it has been (balance.c). */
typedef struct {
  double best, loss; /* best: 0 until the first check */
} Balance;

/* What a step changes. */
typedef struct {
  double *x, *v, h, t, moved_for, planned;
  int nnodes, nfacets, revision;
  Balance balance;
} SavedState;

struct Solid_s {
  MPI_Comm comm;
  PetscMPIInt rank, size;
  SolidSetup setup;
  GlobalSizes global;
  int nnodes, nfacets, nbodies;
  int node_capacity,
      facet_capacity; /* of all arrays [nnodes] and [nfacets]: for the case that all joints break */
  int revision;       /* changes when nodes, elements or facets do */
  Body *body;         /* [nbodies] */
  int nmaterials;
  Material *material; /* [nmaterials] */
  /* nodes */
  long long *gid;
  int *node_body, *surface; /* [nnodes]; surface: some rank has a facet there */
  int *is_prescribed;       /* [nnodes] a prescribed motion moves it until its release */
  int *base;                /* [nnodes] the node of the start that it was then, on this rank */
  double *rest, *x, *v;     /* [nnodes][2] */
  double *force, *load;     /* [nnodes][2] internal and contact; the fluid's, summed over ranks */
  const double *film_load, *film_resistance; /* borrowed, of SolidSetFilm until the step begins; NULL: none */
  double *mass, *inverse_mass;               /* [nnodes] all ranks' elements; inverse 0 where fixed */
  int nfixed, *fixed;                        /* [nfixed] nodes with inverse mass 0 */
  int *corner_start, *corner; /* [nnodes + 1], [3 ne]: where a node's forces lie in elements.force */
  Elements elements;
  int *element; /* [ne][3] */
  int nfaces;   /* the surface's nfacets, and after them the faces of active joints: what contact sees */
  int *facet, *facet_element; /* [nfaces][2], [nfaces] */
  int *facet_side;            /* [nfaces] from that corner of the element to the next */
  int *facet_across;   /* [nfaces] the element, in the model, that an active joint holds there; -1: none */
  int *facet_material; /* [nfaces] of a joint with a material of its own, that; else -1 */
  SharedNodes shared;
  Copies copies; /* of the nodes: what acts on one is the sum of what its ranks' elements do */
  Contact contact;
  Joints joints;                      /* NULL: none */
  int nprescribed, nprescribed_first; /* now, and at the start: parts of split nodes come last */
  PrescribedNode *prescribed;         /* [nprescribed] */
  PrescribedMotion *motion;
  double *position_before, *velocity_before; /* [nprescribed][2] before a substep */
  char *is_taken;                            /* [nnodes][2] within a substep: a motion has moved it */
  int nmotions;
  /* rigid bodies (rigid.h): their number; of each body which it is, or -1; this rank's nodes in them; the largest angular velocity, 1/s */
  int nrigid, *rigid_index, nrigid_nodes, *rigid_node;
  double rigid_spin,
      *rigid_turn; /* [nrigid] angular acceleration by the last forces, were they not held, 1/s2 */
  int nboundary_loads, nloaded; /* of the model; this rank's sides that have one */
  BoundaryLoad *boundary_load;
  LoadedSide *loaded;           /* [nloaded] local elements */
  double (*loaded_force)[3][2]; /* [nloaded] in the last forces, N */
  /* of the setup's springs: this rank's elements at their ends, or -1, what they do in the last forces, and whether some are between two bodies */
  int spring_element[MAX_SPRINGS][2];
  double spring_force[MAX_SPRINGS][2]; /* N, on the first end */
  PetscBool linked;
  /* the current step */
  double dt, done, h, moved_for; /* moved_for: length of the last substep made, s */
  double kick;                   /* s: what internal forces act for in a substep */
  double planned;                /* s, of a substep; the step is divided into whole ones */
  double *start;                 /* [nnodes][2] positions when it began */
  double *interface_velocity, *mobility,
      *acceleration; /* [nnodes][2], [nnodes], [nnodes][2] of SolidUpdateInterfaceMotion; within a step the first is
                               * what the forces at its start make of the velocity */
  StepResponse response;      /* NULL before the first SolidUpdateInterfaceMotion */
  int npieces, *piece;        /* [nnodes] SolidPieces has found; npieces 0: since the last crack not yet */
  int remaining, until_check; /* substeps */
  char failure[320];          /* why this rank cannot make the step, or "" */
  SolidBudget budget;         /* this rank's part, but for the reaction */
  double (*reaction)[2];      /* [nbodies] this rank's part of what budget.reaction is of all, N s/m */
  double (*momentum)[2];      /* [nbodies] the same of budget.start */
  /* [nmotions] the part of the reaction that each motion has, of this rank, N s/m, its moment, N s, and work, J/m */
  double (*motion_impulse)[4];
  /* of the setup's contact probes over the step, this rank's part (ContactAddImpulses) */
  double contact_impulse[MAX_CONTACT_PROBES][CONTACT_SUMS];
  PetscBool force_valid;    /* force belongs to x and v */
  PetscBool unsynchronised; /* after SolidState(0): JointsSynchronise is due */
  SolidStats stats;
  SavedState saved;
  /* other ranks' subdomains: NULL unless elements may change ranks */
  Model *model;
  int partition_number; /* which of the partitions since the start this is */
  int *part;            /* [model->nelements] the rank that has it */
  Solid before;         /* the subdomain of the saved state, if it was another; NULL */
  PetscBool kept;       /* there is a saved state */
  Balance balance;
};

/* Not collective: no lower rank has the node. */
static inline PetscBool SolidOwns(const Solid s, int node)
{
  return (PetscBool)(s->size == 1 || CopiesIsFirst(s->copies, node));
}

/* forces.c: internal forces of this rank's elements into force.  An element with J <= 0 is the rank's failure; from then on it stands, without
 * forces, where the step began, until all have heard of it. */
PetscErrorCode SolidInternalForces(Solid s);
/* The smallest stable step over this rank's elements that can move, each with contact's rates added. */
double SolidElementLimit(Solid s, ElementRates contact);
ElementLaw ElementsLaw(const Elements *e, int k);
/* Of the corners of its constant-strain triangle, which a six-node triangle carries along; value: positions or velocities */
Tensor SolidElementEdges(const Elements *e, int k, const double value[]);
/* F where its law is evaluated (six_node_kernel.h), and the edges that make it of D0^-1. */
void SolidElementShape(const Elements *e, int k, const double x[], Tensor *edges, Tensor *f);

/* element_lists.c: corner_start, corner, elements.held and fixed, from element and inverse_mass */
void SolidListCorners(Solid s);
/* No node that its forces act on can move. */
PetscBool SolidElementHeld(const Elements *e, int k, const double inverse_mass[]);

/* fragments.c, collective: piece[nnodes], borrowed: 0 .. *n - 1 as in SolidFragments; kept until nodes split.
 */
PetscErrorCode SolidPieces(Solid s, int *n, const int **piece);

/* film.c, collective, at the start of a step: films yield. */
PetscErrorCode SolidMoveFilms(Solid s);

/* budget.c: a step begins (not collective); then, as soon as its first forces are known (collective). */
void BudgetStart(Solid s);
PetscErrorCode BudgetStartForces(Solid s);
/* moved[nnodes][2]: a prescribed motion has moved the component in the last substep. */
void SolidFindMoved(Solid s, char moved[]);
/* What the walls and what holds fixed nodes do in the substep to come. */
void BudgetAddSubstep(Solid s);
/* An impulse on component c of node n that is neither the fluid's nor a wall's, N s/m; v: where its work is done, m/s. */
void BudgetAddImpulse(Solid s, int n, int c, double impulse, double v);
/* Component c of node n, free so far, is going to move with the prescribed v; before: with that of the last substep. */
void BudgetAddPrescribed(Solid s, int motion, int n, int c, double before, double v, double arm);
/* What the decay rate has done in the substep, after its nodes have moved. */
void BudgetAddDecay(Solid s);

/* distribute.c: everything that comes from the model. */
PetscErrorCode SolidTakeSubdomain(Solid s, const Model *a, const int part[]);

/* balance.c, collective: elements to ranks as suits the solid as it is now.  Needs rebalance > 0. */
PetscErrorCode SolidDealOut(Solid s);

/* solid.c: all but the model. */
PetscErrorCode SolidFreeSubdomain(Solid s);

/* migrate.c, not collective: the subdomain that the saved state belongs to is the present one again. */
PetscErrorCode SolidRestoreSubdomain(Solid s);
/* Not collective: the present subdomain is that of the state which is about to be saved. */
PetscErrorCode SolidKeepSubdomain(Solid s);

/* joints_create.c */
PetscErrorCode JointsCreate(Solid s, const Model *a, const InteriorEdges *edges, int nghosts,
                            const GhostElement ghost[], const int part[], const int local[], Joints *joints);
PetscErrorCode JointsDestroy(Joints *j);
/* How this rank's joints suit the mesh: the least E G_I/F_t^2 over the length of its edge.  Not collective; returns their number. */
int JointsResolution(Joints j, Solid s, double *zone);
/* How few directions this rank's joints have, by their length: 0 for all alike, 1 for triangles in rows or halves of squares; 0 for joints in a
 * line.  At rest, not collective. */
double JointsDirections(Joints j, Solid s);
/* joints.c: adds to force and remembers damage. */
void JointsAddForces(Joints j, Solid s);
/* Collective: edges loaded to their strength activate, broken ones become surface; *changed: nodes,
 * elements and facets are new, forces and limit too. */
PetscErrorCode JointsAdvance(Joints j, Solid s, PetscBool *changed);
/* Not collective: how many joints are active here; 0 without joints. */
int JointsActive(Joints j);
/* Not collective: K of the k-th of them as it is, N/m, [2 i + c] of node[i] along axis c: end 0 on both elements,
 * then end 1; false where another rank has it too, whose is to be added. */
PetscBool JointsStiffness(Joints j, Solid s, int k, int node[4], double stiffness[8][8]);
/* Bound of omega^2, 1/s2. */
double JointsRate(Joints j);
/* break.c: saves or puts back damage and topology; not collective. */
PetscErrorCode JointsState(Joints j, Solid s, int save);
/* Not collective: what the joints' memory says has happened happens again, revision by revision, in a subdomain
 * that is intact.  So nodes and facets get the numbers that they have on a rank which had its elements all the
 * time, and sums their bits. */
PetscErrorCode JointsReplay(Joints j, Solid s);
/* Collective: after JointsState(0) and JointsReplay, what needs messages. */
PetscErrorCode JointsSynchronise(Joints j, Solid s);

/* contact.c, contact_search.c, contact_forces.c, contact_pair.c, contact_between.c */
PetscErrorCode ContactCreate(Solid s, Contact *contact);
/* Collective: nodes, elements or facets have changed; a search must follow.  Slips stay with element and
 * side. */
PetscErrorCode ContactRenew(Contact c, Solid s);
/* Collective: new candidates, for motions of each body's surface nodes up to its ContactSkins: of least[nbodies], NULL: none,
 * where its own pairs allow that. */
PetscErrorCode ContactSearch(Contact c, Solid s, const double least[]);
/* Not collective: until the next call or search no surface node is going to be farther than `travel` from where it was
 * at the search: what was farther apart than twice that is not looked at. */
void ContactSetTravel(Contact c, double travel);
/* Adds to force; every rank's edges against its own targets and those of other ranks. */
PetscErrorCode ContactAddForces(Contact c, Solid s);
/* Not collective: how far the nodes of each body may move before a new search, [nbodies], and how far this one has, squared;
 * bounds of omega^2 and 2 xi omega. */
const double *ContactSkins(Contact c);
double ContactMovedSquared(Contact c, Solid s, int node);
/* Not collective: the force of the walls on this rank's edges in the last ContactAddForces, N. */
Point ContactWalls(Contact c);
ElementRates ContactRate(Contact c);
/* Not collective: the power that friction and damping took at the last substep's velocities, of this rank's edges, W/m. */
double ContactLoss(const Contact c);
/* Not collective: sum[contact probes of the setup] += the last forces times s->kick. */
void ContactAddImpulses(Contact c, const Solid s, double sum[][CONTACT_SUMS]);
/* Not collective: the springs of friction keep what the forces just used; saved and put back with the state.
 * After that there is no contact force until the next search, which SolidStart makes. */
void ContactCommit(Contact c);
PetscErrorCode ContactState(Contact c, int save);
PetscErrorCode ContactDestroy(Contact *c);
#endif
