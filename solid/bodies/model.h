/* All bodies of the run before they are dealt out to ranks.  Every rank builds the same model from the
 * case file and takes its subdomain in SolidCreate, so that setting up needs no messages.  Nothing here is
 * collective. */
#ifndef SOLID_MODEL_H
#define SOLID_MODEL_H
#include "common/mesh/mesh.h"
#include "solid/bodies/six_node.h"
#include "solid/boundary_load.h"
#include "solid/element_law.h"
#include "solid/prescribed_motion.h"

enum { MATERIAL_NAME = 48 };

/* Zeros are good for everything after the penalty. */
typedef struct {
  double density;        /* kg/m3 */
  double youngs_modulus; /* Pa */
  double poisson_ratio;  /* 0 <= nu < 0.5 */
  double damping; /* 0 <= beta < 1:  eta = 2 h beta sqrt(E rho), h the element's smallest height at rest */
  double damping_ratio, damping_frequency; /* in tension, of the critical at this frequency, Hz */
  double penalty;                          /* of contact, Pa */
  double friction;                         /* Coulomb's coefficient on the same material */
  double contact_damping;                  /* of contact with the same material, fraction of the critical */
  double thickness;                        /* m; 0 stands for 1: per metre of depth */
  int plane_stress;                        /* else plane strain */
  int law;                                 /* ElementLawKind (element_law.h) */
  int rigid;                               /* bodies of it keep their shape: no law, no joints */
  int joints_alone;                        /* it is of joints: no body is of it */
  double strength[2];                      /* of joints: in tension and in shear, Pa */
  double internal_friction; /* of joints: what pressure adds to the shear strength, over the pressure */
  double weibull_modulus;   /* of joints: how little their strengths scatter; 0: not at all */
  int weibull_seed;
  double fracture_energy[2]; /* per unit of new surface, mode I and mode II, J/m2 */
  char name[MATERIAL_NAME];  /* bodies with equal names share the material; "" is always one of its own */
} Material;

/* Without viscosity, per metre of thickness. */
ElementLaw MaterialLaw(const Material *m);

/* Joints in a physical surface of the mesh, or on a physical curve between its triangles. */
typedef struct {
  const char *name;
  int has_material; /* of a curve: strengths, energies and frictions are those of */
  Material material;
} NamedJoints;

/* Where a body may crack: the edges between two elements that lie in one of the boxes or regions, and those on a curve. */
typedef struct {
  int all;
  int nboxes, nnames;
  const double (*box)[4]; /* lower x, y, upper x, y: holds the element's centre at rest */
  const NamedJoints *named;
} JointSetup;

typedef struct {
  const char *boundary; /* NULL: the whole body */
  PrescribedMotion motion;
} BoundaryMotion;

typedef struct {
  const char *boundary;
  BoundaryLoad load;
} NamedLoad;

typedef struct {
  const char *region; /* physical surface of the mesh */
  Material material;
} RegionMaterial;

typedef struct {
  int entry;               /* in the case file, for messages */
  Material material;       /* of all elements in none of the regions; one of theirs if there are none */
  double stretch[2];       /* current = centre + stretch (rest - centre): 1, 1 for a body at rest */
  const double *position;  /* [mesh nv][2] instead of that; or NULL */
  double velocity[2];      /* m/s */
  double angular_velocity; /* rad/s about the mass centre, counter-clockwise */
  int fixed;               /* whole body */
  double circle;           /* its radius if it is a disc about its mass centre, m; else 0 */
  int six_node;            /* its mesh has been split into six-node triangles (SixNodeSplit) */
  int nfixed;              /* or these boundaries and regions of the mesh */
  const char *const *fixed_name;
  JointSetup joints;
  int nregions;
  const RegionMaterial *region;
  int nprescribed;
  const BoundaryMotion *prescribed; /* rows are copied */
  int nloads;
  const NamedLoad *load; /* likewise */
} BodySetup;

/* A body that keeps its shape. */
typedef struct {
  double mass, inertia; /* kg/m; about the mass centre, kg m */
  double mass_factor
      [4]; /* masses at nodes have the body's moment of inertia: a third of their elements' times 1 + f_0 + f_1 y_1 + f_2 y_2 + f_3 y.y,
                            y from the mass centre */
  double
      surface_compliance; /* m2/kg: bound of the squared frequency on a bed of unit stiffness per area (rigid.h) */
} RigidBody;

typedef struct {
  Material material;
  int first_element; /* in the model */
  int entry;         /* of its setup */
  double centre[2];  /* of mass, at the start */
  RigidBody rigid;   /* mass 0: it deforms, or is held as a whole */
  double circle;     /* of a rigid disc: its radius, with which it touches others, m; else 0 */
} Body;

/* At a place of rest: 1 but in rigid bodies. */
static inline double BodyMassFactor(const Body *b, Point rest)
{
  const double *f = b->rigid.mass_factor;
  const Point y = PointMinus(rest, PointAt(b->centre, 0));
  return 1.0 + f[0] + f[1] * y.x + f[2] * y.y + f[3] * (y.x * y.x + y.y * y.y);
}

typedef struct {
  int nnodes, nelements, nfacets, nbodies;
  double *rest, *x, *u;  /* [nnodes][2] rest coordinates X0, initial positions, m, and velocities, m/s */
  int *fixed;            /* [nnodes] */
  int *node_body;        /* [nnodes] */
  int *element;          /* [nelements][3] counter-clockwise */
  int *element_body;     /* [nelements] */
  int *element_material; /* [nelements] */
  int *jointed;          /* [nelements] bit i: may part across side i, if the neighbour may */
  int *
      joint_material; /* [nelements][3] that of the joint across side i; -1: the weaker one of the elements' */
  int *six_node;      /* [nelements] SixNodePart */
  int *facet;         /* [nfacets][2] surface edges, the solid on their left */
  int *facet_element; /* [nfacets] the element behind */
  Body *body;         /* [nbodies] */
  int nmaterials, nmotions, nprescribed;
  Material *material;       /* [nmaterials] */
  PrescribedMotion *motion; /* [nmotions] */
  PrescribedNode
      *prescribed; /* [nprescribed] in order of the motions: the last one of a node and component counts */
  int nloads, nloaded;
  BoundaryLoad *load; /* [nloads] */
  LoadedSide *loaded; /* [nloaded] they add up where several are on a side */
} Model;

typedef struct {
  int element[2]; /* the lower one first */
  Point centre[2];
} ModelPair;

/* Adds a body; mesh holds its rest coordinates and is not kept.  On failure *error (a static buffer) says
 * why: a degenerate element, one that starts inside out, an edge with more than two triangles, a boundary or
 * region that does not exist; the model is then of no use any more. */
PetscErrorCode ModelAdd(Model *a, const MeshSerial *mesh, const BodySetup *setup, const char **error);
/* A pair of elements that overlap, of two bodies or of one in which they share no node; element[0] = -1 if there is none.  One of them
 * is at the surface. */
PetscErrorCode ModelOverlap(const Model *a, ModelPair *pair);
/* Edges of an element at rest, m; its law, times its thickness. */
Tensor ModelRestEdges(const Model *a, int element);
ElementLaw ModelElementLaw(const Model *a, int element);
double ModelElementMass(const Model *a, int element); /* kg/m */
/* What a corner, 3 e + i, has of its element's mass, kg/m: a third, but in rigid bodies (RigidBody.mass_factor). */
double ModelCornerMass(const Model *a, int corner);
/* With rows of its own. */
PetscErrorCode BoundaryLoadCopy(const BoundaryLoad *from, BoundaryLoad *to);
PetscErrorCode BoundaryLoadFree(BoundaryLoad *load);
/* *row, [n] numbers that are borrowed, becomes a copy of its own. */
PetscErrorCode ModelCopyRows(int n, const double **row);
PetscErrorCode ModelCopy(const Model *from, Model *to);
PetscErrorCode ModelDestroy(Model *a);
#endif
