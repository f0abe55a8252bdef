/* Density and viscosity of the fluid: one number an element (P0) at two time levels, t^n and t^{n+1}.
 *
 *   level            rho, mu                          who sets it
 *   MATERIAL_OLD     at t^n                           MaterialAdvance, from MATERIAL_NEW
 *   MATERIAL_NEW     at t^{n+1}                       MaterialSet, before the step's momentum equation
 *   MATERIAL_STEP    (1 - theta) new + theta old      follows: inertia and weight have one density
 *
 * That weighting of the density makes momentum (rho u) telescope from step to step when mass moves (theta the
 * scheme's); the projection, the last part of a step, has the density of its end.  The viscosity has
 * theta new + (1 - theta) old, as its term in the equation.  A fluid whose material is never set keeps three
 * views of one constant array, and the revision 0: what was made of the density (the pressure's matrix and its
 * factor) need not be made again while the revision stays. */
#ifndef FLUID_MATERIAL_H
#define FLUID_MATERIAL_H
#include "common/mesh/mesh.h"
#include <petscvec.h>

typedef enum { MATERIAL_OLD, MATERIAL_NEW, MATERIAL_STEP } MaterialLevel;

typedef struct Material_s *Material;

/* rho, kg/m3, and mu, Pa s, on all elements at all levels; mesh is borrowed.  Collective over mesh->comm. */
PetscErrorCode MaterialCreate(const Mesh *mesh, double theta, double rho, double mu, Material *m);
/* Of the coming step, in place of the one before.  Not collective. */
void MaterialSetTheta(Material m, double theta);
PetscErrorCode MaterialDestroy(Material *m);
/* rho[ne], mu[ne] of the owned elements at MATERIAL_OLD or MATERIAL_NEW; ghosts follow.  Density must be
 * positive, viscosity not negative.  Collective. */
PetscErrorCode MaterialSet(Material m, MaterialLevel level, const double rho[], const double mu[]);
/* At MATERIAL_STEP viscosity is at least least[ne], Pa s, until any level is set or advanced.  Collective. */
PetscErrorCode MaterialRaiseViscosity(Material m, const double least[]);
/* The step is complete: new becomes old.  Collective. */
PetscErrorCode MaterialAdvance(Material m);
/* Both levels are kept, or what was kept is put back: for a step that is redone.  Collective. */
PetscErrorCode MaterialSave(Material m);
PetscErrorCode MaterialRestore(Material m);
/* [ne + ng], borrowed, valid until the next call that changes the material.  Not collective. */
const double *MaterialDensity(Material m, MaterialLevel level);
const double *MaterialViscosity(Material m, MaterialLevel level);
/* Grows whenever density or viscosity may have changed; the same on all ranks. */
int MaterialRevision(Material m);
#endif
