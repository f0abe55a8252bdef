#include "common/mesh/mesh_impl.h"
#include "common/mesh/mesh_table.h"

PetscErrorCode MeshFacesDestroy(MeshFaces *faces)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree4(faces->edge, faces->neighbor, faces->face, faces->tag));
  PetscFunctionReturn(0);
}

/* Face ef meets `other`, the face that came first on the same edge. */
static PetscErrorCode Join(const MeshSerial *s, int ef, int other, MeshFaces *f)
{
  int a, b, p, q;
  PetscFunctionBeginUser;
  MeshFaceEnds(s, ef, &a, &b);
  MeshFaceEnds(s, other, &p, &q);
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

/* Each edge's first face goes into the table, the second one is joined to it. */
static PetscErrorCode JoinAll(const MeshSerial *s, MeshTable *edges, MeshFaces *f)
{
  PetscFunctionBeginUser;
  f->nedge = 0;
  for (int ef = 0; ef < 3 * s->ne; ef++) {
    int a, b;
    MeshFaceEnds(s, ef, &a, &b);
    int *first = MeshTableEdge(edges, a, b);
    f->neighbor[ef] = f->face[ef] = f->tag[ef] = -1;
    if (*first < 0) {
      *first = ef;
      f->edge[ef] = f->nedge++;
    } else {
      PetscCall(Join(s, ef, *first, f));
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MeshFacesCreate(const MeshSerial *s, MeshFaces *f)
{
  const int n = 3 * s->ne;
  MeshTable edges;
  PetscFunctionBeginUser;
  PetscCall(MeshTableCreate(&edges, (size_t)n + 1));
  PetscCall(PetscMalloc4(n, &f->edge, n, &f->neighbor, n, &f->face, n, &f->tag));
  const PetscErrorCode failed = JoinAll(s, &edges, f);
  for (int k = 0; k < s->nb && !failed; k++) { /* named edges inside or off the mesh are passed over */
    int *ef = MeshTableEdge(&edges, s->facet[2 * k], s->facet[2 * k + 1]);
    if (*ef >= 0 && f->neighbor[*ef] < 0) f->tag[*ef] = s->facet_tag[k];
  }
  PetscCall(MeshTableDestroy(&edges));
  PetscFunctionReturn(failed);
}
