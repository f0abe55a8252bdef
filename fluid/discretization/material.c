#include "fluid/discretization/material.h"
#include "fluid/discretization/ghosted.h"

enum { RHO, MU, NFIELDS };
enum { NLEVELS = 3 };

struct Material_s {
  const Mesh *mesh; /* borrowed */
  double theta;
  PetscBool varies;             /* MaterialSet has been called: each level has arrays of its own */
  double *value[NLEVELS];       /* [ne + ng][NFIELDS apart]: rho of all elements, then mu */
  double *saved[MATERIAL_STEP]; /* of MATERIAL_OLD and MATERIAL_NEW */
  Vec ghosted;                  /* blocks of NFIELDS: scratch with which ghosts are filled */
  int revision;
};

static size_t Count(Material m)
{
  return (size_t)(m->mesh->ne + m->mesh->ng);
}

PetscErrorCode MaterialCreate(const Mesh *mesh, double theta, double rho, double mu, Material *material)
{
  Material m;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&m));
  m->mesh = mesh;
  m->theta = theta;
  PetscCall(PetscMalloc1(NFIELDS * Count(m), &m->value[MATERIAL_OLD]));
  for (size_t e = 0; e < Count(m); e++) {
    m->value[MATERIAL_OLD][e] = rho;
    m->value[MATERIAL_OLD][Count(m) + e] = mu;
  }
  m->value[MATERIAL_NEW] = m->value[MATERIAL_STEP] = m->value[MATERIAL_OLD];
  *material = m;
  PetscFunctionReturn(0);
}

PetscErrorCode MaterialDestroy(Material *material)
{
  Material m = *material;
  PetscFunctionBeginUser;
  if (!m) PetscFunctionReturn(0);
  for (int l = m->varies ? NLEVELS - 1 : 0; l >= 0; l--) PetscCall(PetscFree(m->value[l]));
  for (int l = 0; l < MATERIAL_STEP; l++) PetscCall(PetscFree(m->saved[l]));
  PetscCall(VecDestroy(&m->ghosted));
  PetscCall(PetscFree(*material));
  PetscFunctionReturn(0);
}

/* From one constant array to an array for each level. */
static PetscErrorCode SeparateLevels(Material m)
{
  const Mesh *mesh = m->mesh;
  PetscInt *ghosts;
  PetscFunctionBeginUser;
  if (m->varies) PetscFunctionReturn(0);
  m->varies = PETSC_TRUE;
  for (int l = MATERIAL_NEW; l < NLEVELS; l++) {
    PetscCall(PetscMalloc1(NFIELDS * Count(m), &m->value[l]));
    PetscCall(PetscArraycpy(m->value[l], m->value[MATERIAL_OLD], NFIELDS * Count(m)));
  }
  PetscCall(PetscMalloc1(mesh->ng, &ghosts));
  for (int e = 0; e < mesh->ng; e++) ghosts[e] = mesh->egid[mesh->ne + e];
  PetscCall(VecCreateGhostBlock(mesh->comm, NFIELDS, NFIELDS * mesh->ne, PETSC_DETERMINE, mesh->ng, ghosts,
                                &m->ghosted));
  PetscCall(PetscFree(ghosts));
  PetscFunctionReturn(0);
}

/* What the step sees of its two ends. */
static void WeighLevels(Material m)
{
  const double weight[NFIELDS] = {1.0 - m->theta, m->theta}; /* of the new level */
  for (int k = 0; k < NFIELDS; k++)
    for (size_t e = k * Count(m); e < (k + 1) * Count(m); e++)
      m->value[MATERIAL_STEP][e] =
          weight[k] * m->value[MATERIAL_NEW][e] + (1.0 - weight[k]) * m->value[MATERIAL_OLD][e];
  m->revision++;
}

void MaterialSetTheta(Material m, double theta)
{
  if (theta == m->theta) return;
  m->theta = theta;
  if (m->varies) WeighLevels(m);
}

/* m->ghosted = rho[ne] and mu[ne], and the ghosts'. */
static PetscErrorCode FillGhosts(Material m, const double rho[], const double mu[])
{
  PetscScalar *v;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayWrite(m->ghosted, &v));
  for (int e = 0; e < m->mesh->ne; e++) {
    v[NFIELDS * e + RHO] = rho[e];
    v[NFIELDS * e + MU] = mu[e];
  }
  PetscCall(VecRestoreArrayWrite(m->ghosted, &v));
  PetscCall(GhostedUpdate(m->ghosted));
  PetscFunctionReturn(0);
}

PetscErrorCode MaterialSet(Material m, MaterialLevel level, const double rho[], const double mu[])
{
  const PetscScalar *v;
  PetscFunctionBeginUser;
  PetscCheck(level == MATERIAL_OLD || level == MATERIAL_NEW, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
             "material is set at the beginning or the end of a step (MATERIAL_OLD, MATERIAL_NEW)");
  for (int e = 0; e < m->mesh->ne; e++)
    PetscCheck(rho[e] > 0.0 && mu[e] >= 0.0, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
               "element %d: expected a positive density and a viscosity, found %g kg/m3 and %g Pa s", e,
               rho[e], mu[e]);
  PetscCall(SeparateLevels(m));
  PetscCall(FillGhosts(m, rho, mu));
  PetscCall(GhostedGetArrayRead(m->ghosted, &v));
  for (size_t e = 0; e < Count(m); e++)
    for (int k = 0; k < NFIELDS; k++) m->value[level][k * Count(m) + e] = v[NFIELDS * e + k];
  PetscCall(GhostedRestoreArrayRead(m->ghosted, &v));
  WeighLevels(m);
  PetscFunctionReturn(0);
}

PetscErrorCode MaterialRaiseViscosity(Material m, const double least[])
{
  const PetscScalar *v;
  PetscFunctionBeginUser;
  PetscCall(SeparateLevels(m));
  double *rho = m->value[MATERIAL_STEP], *mu = rho + Count(m);
  PetscCall(FillGhosts(m, rho, least));
  PetscCall(GhostedGetArrayRead(m->ghosted, &v));
  for (size_t e = 0; e < Count(m); e++) mu[e] = fmax(mu[e], v[NFIELDS * e + MU]);
  PetscCall(GhostedRestoreArrayRead(m->ghosted, &v));
  m->revision++;
  PetscFunctionReturn(0);
}

PetscErrorCode MaterialAdvance(Material m)
{
  PetscFunctionBeginUser;
  if (!m->varies) PetscFunctionReturn(0);
  PetscCall(PetscArraycpy(m->value[MATERIAL_OLD], m->value[MATERIAL_NEW], NFIELDS * Count(m)));
  WeighLevels(m);
  PetscFunctionReturn(0);
}

PetscErrorCode MaterialSave(Material m)
{
  PetscFunctionBeginUser;
  for (int l = 0; l < MATERIAL_STEP && m->varies; l++) {
    if (!m->saved[l]) PetscCall(PetscMalloc1(NFIELDS * Count(m), &m->saved[l]));
    PetscCall(PetscArraycpy(m->saved[l], m->value[l], NFIELDS * Count(m)));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MaterialRestore(Material m)
{
  PetscFunctionBeginUser;
  if (!m->saved[MATERIAL_OLD]) PetscFunctionReturn(0);
  for (int l = 0; l < MATERIAL_STEP; l++)
    PetscCall(PetscArraycpy(m->value[l], m->saved[l], NFIELDS * Count(m)));
  WeighLevels(m);
  PetscFunctionReturn(0);
}

const double *MaterialDensity(Material m, MaterialLevel level)
{
  return m->value[level];
}

const double *MaterialViscosity(Material m, MaterialLevel level)
{
  return m->value[level] + Count(m);
}

int MaterialRevision(Material m)
{
  return m->revision;
}
