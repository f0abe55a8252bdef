/* The part of a distributed mesh that a rank has: what a Mesh is made of, migrated and made into again.
 *
 *   rank 0        rank 1
 *   7---4   |   4---1
 *   |\  |   |   |\  |
 *   | \ |   |   | \ |
 *   9---2   |   2---5
 *
 * Each triangle is on one rank.  Vertices on more than one rank are known to be the same by their global
 * number gid, which need not be contiguous.  Facets are the triangles' edges on the boundary of the whole
 * domain; those on an edge with triangles on both sides, here or elsewhere, are passed over.
 *
 * All collective, on any number of ranks, of which any may have no triangles; the same input gives the same
 * result in every run.  Errors are returned on all ranks. */
#ifndef CORACLE_PART_H
#define CORACLE_PART_H
#include "common/mesh/mesh.h"

typedef struct {
  MeshSerial serial; /* tags and regions have the same names on all ranks that have triangles */
  long long *gid;    /* [serial.nv] at least 0 */
} MeshPart;

PetscErrorCode MeshPartDestroy(MeshPart *part);

/* Not collective: the owned elements of a Mesh in their order, with the Mesh's first vertices in their order;
 * a vertex's gid is its global number. */
PetscErrorCode MeshPartOf(const Mesh *mesh, MeshPart *part);

/* Nonzero for faces[ne][3] to triangles of other ranks and for vertices[nv] that other ranks have too. */
PetscErrorCode MeshPartShared(MPI_Comm comm, const MeshPart *part, char faces[], char vertices[]);

/* A rank below nparts <= ranks for each triangle, target[ne]: METIS on the graph of the triangles, equal
 * numbers of them and few edges between parts.  weight[ne][3] of the faces, at least 1, or NULL on all ranks:
 * faces of large weight are cut only if it cannot be avoided; the larger of two sides counts.  The graph is
 * gathered on rank 0, the mesh is not; above a hundred thousand triangles on eight ranks and more
 * that of clusters that each rank has made of its own. */
PetscErrorCode MeshPartPartition(MPI_Comm comm, const MeshPart *part, int nparts, const int weight[],
                                 int target[]);

/* Triangles go to rank target[ne]; *moved has them by the rank that they came from and their order there.
 * Per vertex, data[nv][ncomp] goes along and comes out in *moved_data, PetscFree'd by the caller; both may be
 * NULL if ncomp is 0. */
PetscErrorCode MeshPartMigrate(MPI_Comm comm, const MeshPart *part, const int target[], int ncomp,
                               const double data[], MeshPart *moved, double **moved_data);

/* Makes the Mesh of all parts as they are: rank r owns the triangles of its part.  Errors:
 * PETSC_ERR_ARG_WRONG for no triangles at all, an edge of more than two triangles, neighbours that turn
 * opposite ways, a boundary edge without a name. */
PetscErrorCode MeshBuild(MPI_Comm comm, const MeshPart *part, Mesh **mesh);
#endif
