/* What a body cannot be made of. */
#include "solid/bodies/model_impl.h"
#include <stdarg.h>
#include <stdio.h>

#define FLAT 1e-6 /* area over squared longest edge below which an element is degenerate */

static char why[256];

PetscErrorCode ModelRefuse(const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(why, sizeof why, format, arguments);
  va_end(arguments);
  return PETSC_ERR_USER_INPUT;
}

const char *ModelReason(void)
{
  return why;
}

static PetscErrorCode CheckElements(const MeshSerial *m)
{
  if (m->ne == 0) return ModelRefuse("the mesh has no triangles");
  for (int e = 0; e < m->ne; e++) {
    double longest = 0.0;
    const double area = 0.5 * TensorDeterminant(TensorOfEdges(ModelVertex(m, e, 0), ModelVertex(m, e, 1),
                                                              ModelVertex(m, e, 2)));
    for (int i = 0; i < 3; i++) {
      const Point d = PointMinus(ModelVertex(m, e, (i + 1) % 3), ModelVertex(m, e, i));
      longest = fmax(longest, d.x * d.x + d.y * d.y);
    }
    if (!(area > FLAT * longest))
      return ModelRefuse("element %d at (%g, %g) is %s: its area is %g m2", e, ModelVertex(m, e, 0).x,
                         ModelVertex(m, e, 0).y, area < -FLAT * longest ? "inverted" : "degenerate", area);
  }
  return 0;
}

/* Where the body starts, if that is given. */
static PetscErrorCode CheckPositions(const MeshSerial *m, const double x[])
{
  for (int e = 0; x && e < m->ne; e++) {
    const int *n = m->vertex + 3 * e;
    const Point a = PointAt(x, n[0]);
    if (!(TensorDeterminant(TensorOfEdges(a, PointAt(x, n[1]), PointAt(x, n[2]))) > 0.0))
      return ModelRefuse("its stretch turns element %d at (%g, %g) inside out", e, a.x, a.y);
  }
  return 0;
}

typedef struct {
  int n;
  char (*name)[64];
} Names;

/* In one of two lists, which what describes. */
static PetscErrorCode CheckName(const char *what, const char *name, Names one, Names two)
{
  char all[160] = "none";
  size_t used = 0;
  for (int k = 0; k < one.n + two.n; k++) {
    const char *known = k < one.n ? one.name[k] : two.name[k - one.n];
    if (!strcmp(known, name)) return 0;
    (void)snprintf(all + used, sizeof all - used, "%s%s", k ? ", " : "", known);
    used = strlen(all);
  }
  return ModelRefuse("the body has no %s '%s'; it has %s", what, name, all);
}

static PetscErrorCode CheckNames(const MeshSerial *m, const BodySetup *setup)
{
  const Names boundaries = {m->ntags, m->tag_name}, regions = {m->nregions, m->region_name},
              curves = {m->ncurves, m->curve_name}, none = {0};
  PetscErrorCode code = 0;
  for (int k = 0; k < setup->nfixed && !code; k++)
    code = CheckName("boundary or region", setup->fixed_name[k], boundaries, regions);
  for (int k = 0; k < setup->nprescribed && !code; k++)
    if (setup->prescribed[k].boundary)
      code = CheckName("boundary", setup->prescribed[k].boundary, boundaries, none);
  for (int k = 0; k < setup->nloads && !code; k++)
    code = CheckName("boundary", setup->load[k].boundary, boundaries, none);
  for (int k = 0; k < setup->nregions && !code; k++)
    code = CheckName("region", setup->region[k].region, regions, none);
  for (int k = 0; k < setup->joints.nnames && !code; k++) {
    const NamedJoints *joints = &setup->joints.named[k];
    code = joints->has_material ? CheckName("curve inside", joints->name, curves, none)
                                : CheckName("region or curve inside", joints->name, regions, curves);
    for (int i = 0; i < k && joints->has_material && !code; i++)
      if (setup->joints.named[i].has_material && !strcmp(setup->joints.named[i].name, joints->name))
        code = ModelRefuse("the joints of curve '%s' have two materials", joints->name);
  }
  return code;
}

PetscBool ModelInBox(const MeshSerial *m, int e, const double box[4])
{
  const Point a = ModelVertex(m, e, 0), b = ModelVertex(m, e, 1), c = ModelVertex(m, e, 2);
  const double x = (a.x + b.x + c.x) / 3.0, y = (a.y + b.y + c.y) / 3.0;
  return (PetscBool)(x >= box[0] && y >= box[1] && x <= box[2] && y <= box[3]);
}

static PetscErrorCode CheckJoints(const MeshSerial *m, const JointSetup *j)
{
  for (int k = 0; k < j->nboxes; k++) {
    const double *box = j->box[k];
    int e = 0;
    while (e < m->ne && !ModelInBox(m, e, box)) e++;
    if (e == m->ne)
      return ModelRefuse("no element's centre is in the joints' box [%g, %g] x [%g, %g]", box[0], box[2],
                         box[1], box[3]);
  }
  return 0;
}

PetscErrorCode ModelCheck(const MeshSerial *m, const BodySetup *setup)
{
  PetscErrorCode code = CheckElements(m);
  if (!code) code = CheckPositions(m, setup->position);
  if (!code) code = CheckNames(m, setup);
  if (!code) code = CheckJoints(m, &setup->joints);
  return code;
}
