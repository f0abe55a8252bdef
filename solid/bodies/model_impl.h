/* Private to the model's files. */
#ifndef SOLID_MODEL_IMPL_H
#define SOLID_MODEL_IMPL_H
#include "solid/bodies/model.h"

/* Returns PETSC_ERR_USER_INPUT, with a reason that ModelReason then has. */
PetscErrorCode ModelRefuse(const char *format, ...) __attribute__((format(printf, 1, 2)));
const char *ModelReason(void); /* a static buffer */

/* A mesh and a setup that a body can be made of; else ModelRefuse. */
PetscErrorCode ModelCheck(const MeshSerial *m, const BodySetup *setup);

static inline Point ModelVertex(const MeshSerial *m, int e, int i)
{
  return PointAt(m->x, m->vertex[3 * e + i]);
}
/* The centre of element e of a body's mesh lies in the box (lower x, y, upper x, y). */
PetscBool ModelInBox(const MeshSerial *m, int e, const double box[4]);
/* The last body of the model, of elements `first` and on, if it is rigid: its RigidBody; refuses what such a body cannot have. */
PetscErrorCode ModelMeasureRigid(Model *a, const BodySetup *setup, int first, Body *body);
/* The setup's loads, and the sides of elements `first` and on that are edges of their boundaries; renumber[m->nv]: the model's nodes. */
PetscErrorCode ModelAddLoads(Model *a, const MeshSerial *m, const BodySetup *setup, int first,
                             const int renumber[]);
#endif
