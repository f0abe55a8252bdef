/* The case's materials and bodies, for solid_case.c.  Not collective; all refuse what cannot be. */
#ifndef SOLID_CASE_BODY_H
#define SOLID_CASE_BODY_H
#include "common/link/case_file.h"
#include "common/link/case_key.h"
#include "solid/solid.h"

/* "solid.bodies[i].name" */
const char *BodyKey(char key[CASE_KEY], int body, const char *name);
/* Reads all keys of a material (c: the Case; for CoracleCaseKeys). */
void CaseCheckMaterial(void *c, const char *name);
/* Refuses key when there is no material of that name; walls: `walls` may be there, too. */
void CaseMaterialExists(CoracleCase c, const char *key, const char *name, PetscBool walls);
/* The loads of solid.bodies[body] into its setup, which borrows them until CaseFreeLoads. */
typedef struct {
  NamedLoad *load;
  double (*constant)[3]; /* the only row of what is constant */
} CaseLoads;
PetscErrorCode CaseReadLoads(CoracleCase c, int body, BodySetup *setup, CaseLoads *loads);
PetscErrorCode CaseFreeLoads(CaseLoads *loads);
/* Adds solid.bodies[body]. */
PetscErrorCode CaseReadBody(CoracleCase c, int body, Model *a);
#endif
