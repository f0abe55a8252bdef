/* Private to the mesh room: what makes a part; its faces, here and to other ranks; the order of its
 * elements. */
#ifndef CORACLE_MESH_IMPL_H
#define CORACLE_MESH_IMPL_H
#include "common/exchange/copies.h"
#include "common/mesh/part.h"

/* Fields of a part that a list of triangles makes.  Not collective. */

/* Joins vertices that were listed more than once: local[n] is what those of gid[n] became, as they are met.
 * Sets gid and serial.nv. */
PetscErrorCode PartMerge(int n, const long long gid[], int local[], MeshPart *part);
/* The facets: faces with a name, tag[ne][3], else -1. */
PetscErrorCode PartFacets(const int tag[], MeshSerial *serial);

/* Collective.  MeshBuild; order[ne], or NULL, says which triangle of the part each element was.  keep: the
 * one of the same number, so that the part of a Mesh gives the same Mesh again, to the last bit. */
PetscErrorCode MeshBuildOrdered(MPI_Comm comm, const MeshPart *part, PetscBool keep, int order[],
                                Mesh **mesh);

/* Faces of a MeshSerial; arrays are [ne][3], face i opposite to vertex i. */
typedef struct {
  int nedge;
  int *edge;     /* number of the edge that is face i */
  int *neighbor; /* element across, -1 where there is none here */
  int *face;     /* which face of the neighbour it is, -1 where there is none */
  int *tag;      /* boundary name, -1 inside or without one */
} MeshFaces;

/* Errors: an edge of more than two triangles, two neighbours that turn opposite ways.  To be destroyed all
 * the same. */
PetscErrorCode MeshFacesCreate(const MeshSerial *serial, MeshFaces *faces);
PetscErrorCode MeshFacesDestroy(MeshFaces *faces);

/* The vertices that face ef = 3 element + face runs from and to. */
static inline void MeshFaceEnds(const MeshSerial *s, int ef, int *a, int *b)
{
  const int *v = &s->vertex[ef - ef % 3];
  *a = v[(ef + 1) % 3];
  *b = v[(ef + 2) % 3];
}

/* What those that hold a thing have said of it. */
typedef struct {
  long long lowest, highest, count;
} RendezvousReply;

/* Collective: all copies of a thing say a value. */
PetscErrorCode MeshRendezvous(Copies copies, int n, const long long value[], RendezvousReply reply[]);

/* Faces of all parts.  An open face has no neighbour on this rank; an open vertex is one of an open face.  A
 * closed face between two open vertices must not be another rank's open one. */
typedef struct {
  MeshFaces local;
  int size, rank;
  long long *start; /* [size + 1] element e of rank r has the number start[r] + e */
  int nopen, nopen_vertices, nclosed;
  int *open;               /* [nopen] ascending, 3 element + face */
  long long *across;       /* [nopen] 3 element + face of the one that another rank has, -1 on the boundary */
  int *across_rank;        /* [nopen] and that rank, -1 */
  int *closed;             /* [nclosed] */
  int *open_vertex;        /* [nopen_vertices] ascending */
  RendezvousReply *owners; /* [nopen_vertices] the ranks that have the vertex */
  Copies copies;           /* of the open faces, then open vertices, then the closed faces */
} PartFaces;

/* Collective.  Errors: those of MeshBuild. */
PetscErrorCode PartFacesCreate(MPI_Comm comm, const MeshPart *part, PartFaces *faces);
PetscErrorCode PartFacesDestroy(PartFaces *faces);

/* Reverse Cuthill-McKee order of elements (George and Liu, 1981): order[ne] lists them, neighbours close to
 * each other, which keeps ILU factors accurate and caches warm. */
PetscErrorCode MeshOrder(int ne, const int neighbor[], int order[]);
#endif
