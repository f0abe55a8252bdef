#include "fluid/discretization/solid_coupling.h"

struct SolidCoupling_s {
  int n, capacity;
  CoracleCoupling *entry; /* [n] */
  int *index;             /* [ne] of the element's entry, or -1 */
  double *alpha;          /* [ne] */
  PetscBool starting;
};

PetscErrorCode SolidCouplingCreate(int ne, SolidCoupling *coupling)
{
  SolidCoupling s;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  PetscCall(PetscMalloc1(ne, &s->index));
  PetscCall(PetscCalloc1((size_t)ne + 1, &s->alpha)); /* one more: not NULL on ranks without elements */
  for (int e = 0; e < ne; e++) s->index[e] = -1;
  *coupling = s;
  PetscFunctionReturn(0);
}

PetscErrorCode SolidCouplingDestroy(SolidCoupling *s)
{
  PetscFunctionBeginUser;
  if (!*s) PetscFunctionReturn(0);
  PetscCall(PetscFree((*s)->entry));
  PetscCall(PetscFree((*s)->index));
  PetscCall(PetscFree((*s)->alpha));
  PetscCall(PetscFree(*s));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidCouplingSet(SolidCoupling s, int n, const CoracleCoupling entry[])
{
  PetscFunctionBeginUser;
  for (int k = 0; k < s->n; k++) {
    s->index[s->entry[k].element] = -1;
    s->alpha[s->entry[k].element] = 0.0;
  }
  if (n > s->capacity) {
    s->capacity = n + n / 4;
    PetscCall(PetscFree(s->entry));
    PetscCall(PetscMalloc1(s->capacity, &s->entry));
  }
  if (n > 0) PetscCall(PetscArraycpy(s->entry, entry, n));
  s->n = n;
  for (int k = 0; k < n; k++) {
    s->index[entry[k].element] = k;
    s->alpha[entry[k].element] = entry[k].alpha;
  }
  PetscFunctionReturn(0);
}

const CoracleCoupling *SolidCouplingEntries(SolidCoupling s, int *n)
{
  *n = s->n;
  return s->entry;
}

int SolidCouplingIndex(SolidCoupling s, int e)
{
  return s->index[e];
}

const CoracleCoupling *SolidCouplingAt(SolidCoupling s, int e)
{
  return s->index[e] < 0 ? NULL : s->entry + s->index[e];
}

void SolidCouplingSetStarting(SolidCoupling s, PetscBool starting)
{
  s->starting = starting;
}

void SolidCouplingStart(SolidCoupling s, int e, const double u[], double start[])
{
  const PetscBool solid = (PetscBool)(s->starting && s->alpha[e] > 0.0);
  for (int i = 0; i < 6; i++) start[i] = solid ? s->entry[s->index[e]].velocity[i / 3] : u[i];
}

void SolidCouplingLoad(SolidCoupling s, int e, const double u[6], double area, double rho_dt, double load[6])
{
  const CoracleCoupling *k = SolidCouplingAt(s, e);
  double start[6], m[3];
  SolidCouplingStart(s, e, u, start);
  for (int c = 0; c < 2; c++) {
    P1MassApply(area, start + 3 * c, m);
    for (int i = 0; i < 3; i++) {
      load[3 * c + i] += k->s[c][i];
      if (k->flags & CORACLE_IS_COVERED) load[3 * c + i] -= rho_dt * m[i];
      for (int j = 0; j < 3; j++)
        load[3 * c + i] +=
            k->implicit_inertia[i][j] * (k->kept[c][0] * start[j] + k->kept[c][1] * start[3 + j]);
    }
  }
}

void SolidCouplingMatrix(const CoracleCoupling *entry, double matrix[6][6])
{
  for (int c = 0; c < 2; c++)
    for (int i = 0; i < 3; i++) {
      double *row = matrix[3 * c + i];
      for (int k = 0; k < 6; k++) row[k] = entry->a[c][i][k / 3][k % 3];
      for (int k = 0; k < 6; k++)
        row[k] += entry->inertia_tensor[c][k / 3] * entry->implicit_inertia[i][k % 3];
    }
}

const double *SolidCouplingFraction(SolidCoupling s)
{
  return s->alpha;
}

void SolidCouplingCorrect(SolidCoupling s, const ElementGeometry geometry[],
                          const CoracleCorrection correction[], double u[])
{
  for (int k = 0; k < s->n; k++) {
    const int e = s->entry[k].element;
    for (int c = 0; c < 2; c++) {
      double du[3];
      P1MassSolve(geometry[e].area, correction[k].r[c], du);
      for (int i = 0; i < 3; i++) u[6 * e + 3 * c + i] += du[i];
    }
  }
}
