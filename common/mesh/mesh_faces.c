#include "mesh_impl.h"
#include "mesh_table.h"
#include <string.h>

PetscErrorCode MeshFacesDestroy(MeshFaces *faces)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree4(faces->edge, faces->neighbor, faces->face, faces->tag));
  PetscFunctionReturn(0);
}

static void FaceEnds(const MeshSerial *s, int ef, int *a, int *b)
{
  const int *v = &s->vertex[ef - ef % 3];
  *a = v[(ef + 1) % 3];
  *b = v[(ef + 2) % 3];
}

/* Face ef (3 element + face) meets `other`, the face that came first on the same edge. */
static PetscErrorCode Join(const MeshSerial *s, int ef, int other, MeshFaces *f)
{
  int a, b, p, q;
  PetscFunctionBeginUser;
  FaceEnds(s, ef, &a, &b);
  FaceEnds(s, other, &p, &q);
  PetscCheck(f->neighbor[other] < 0, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
             "more than two triangles share the edge from (%g, %g) to (%g, %g)", s->x[2 * a], s->x[2 * a + 1],
             s->x[2 * b], s->x[2 * b + 1]);
  PetscCheck(a == q && b == p, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
             "triangles %d and %d overlap: both lie on the same side of an edge", other / 3, ef / 3);
  f->neighbor[ef] = other / 3;
  f->face[ef] = other % 3;
  f->neighbor[other] = ef / 3;
  f->face[other] = ef % 3;
  f->edge[ef] = f->edge[other];
  PetscFunctionReturn(0);
}

/* Names the boundary faces; named edges inside the domain or off the mesh are passed over. */
static PetscErrorCode Name(const MeshSerial *s, MeshTable *edges, MeshFaces *f)
{
  PetscFunctionBeginUser;
  for (int k = 0; k < s->nb; k++) {
    int *ef = MeshTableEdge(edges, s->facet[2 * k], s->facet[2 * k + 1]);
    if (*ef >= 0 && f->neighbor[*ef] < 0) f->tag[*ef] = s->facet_tag[k];
  }
  for (int ef = 0; ef < 3 * s->ne; ef++) {
    int a, b;
    FaceEnds(s, ef, &a, &b);
    PetscCheck(f->neighbor[ef] >= 0 || f->tag[ef] >= 0, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
               "the boundary edge from (%g, %g) to (%g, %g) has no name", s->x[2 * a], s->x[2 * a + 1],
               s->x[2 * b], s->x[2 * b + 1]);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MeshFacesCreate(const MeshSerial *serial, MeshFaces *faces)
{
  const int n = 3 * serial->ne;
  MeshTable edges; /* the face that was first on an edge */
  PetscFunctionBeginUser;
  PetscCall(MeshTableCreate(&edges, (size_t)n + 1));
  PetscCall(PetscMalloc4(n, &faces->edge, n, &faces->neighbor, n, &faces->face, n, &faces->tag));
  faces->nedge = 0;
  for (int ef = 0; ef < n; ef++) {
    int a, b;
    FaceEnds(serial, ef, &a, &b);
    int *first = MeshTableEdge(&edges, a, b);
    faces->neighbor[ef] = faces->face[ef] = faces->tag[ef] = -1;
    if (*first < 0) {
      *first = ef;
      faces->edge[ef] = faces->nedge++;
    } else {
      PetscCall(Join(serial, ef, *first, faces));
    }
  }
  PetscCall(Name(serial, &edges, faces));
  PetscCall(MeshTableDestroy(&edges));
  PetscFunctionReturn(0);
}
