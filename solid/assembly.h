/* All bodies of the run before they are dealt out to ranks.  Every rank builds the same assembly from the
 * case file and takes its share in SolidCreate, so that setting up needs no messages.  Nothing here is
 * collective. */
#ifndef SOLID_ASSEMBLY_H
#define SOLID_ASSEMBLY_H
#include "mesh.h"

typedef struct {
  double density;        /* kg/m3 */
  double youngs_modulus; /* Pa */
  double poisson_ratio;  /* 0 <= nu < 0.5, plane strain */
  double damping; /* 0 <= beta < 1:  eta = 2 h beta sqrt(E rho), h the element's smallest height at rest */
  double penalty; /* of contact, Pa */
} Material;

typedef struct {
  Material material;
  double stretch[2];       /* current = centre + stretch (rest - centre): 1, 1 for a body at rest */
  double velocity[2];      /* m/s */
  double angular_velocity; /* rad/s about the mass centre, counter-clockwise */
  int fixed;               /* whole body */
  int nfixed;              /* or these boundaries */
  const char *const *fixed_name;
} BodySetup;

typedef struct {
  Material material;
  int first_element; /* in the assembly */
  double centre[2];  /* of mass, at the start */
} Body;

typedef struct {
  int nnodes, nelements, nfacets, nbodies;
  double *rest, *x, *u; /* [nnodes][2] rest coordinates X0, initial positions, m, and velocities, m/s */
  int *fixed;           /* [nnodes] */
  int *node_body;       /* [nnodes] */
  int *element;         /* [nelements][3] counter-clockwise */
  int *element_body;    /* [nelements] */
  int *facet;           /* [nfacets][2] surface edges, the solid on their left */
  int *facet_element;   /* [nfacets] the element behind */
  Body *body;           /* [nbodies] */
} Assembly;

/* Adds a body; mesh holds its rest coordinates and is not kept.  On failure *error (a static buffer) says
 * why: a degenerate element, an edge with more than two triangles, a boundary to fix that does not exist; the
 * assembly is then of no use any more. */
PetscErrorCode AssemblyAdd(Assembly *a, const MeshSerial *mesh, const BodySetup *setup, const char **error);
/* The first pair of bodies one of which reaches into the other; *first = -1 if there is none. */
PetscErrorCode AssemblyOverlap(const Assembly *a, int *first, int *second);
PetscErrorCode AssemblyDestroy(Assembly *a);
#endif
