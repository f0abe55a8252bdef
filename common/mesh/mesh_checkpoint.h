/* A mesh in a checkpoint, with what belongs to its elements.  Tables have a row an element, in the order of
 * the global numbers:
 *
 *   mesh corners    [nglobal][6]  m, x and y of the three vertices
 *   mesh vertices   [nglobal][3]  numbers of these, the same in all elements around one
 *   mesh tags       [nglobal][3]  index of the boundary's name for boundary faces, else -1
 *   mesh names      [ntags][64]   characters of these names
 *   mesh parts      [ranks]       elements of each rank
 *
 * All collective, on any number of ranks. */
#ifndef CORACLE_MESH_CHECKPOINT_H
#define CORACLE_MESH_CHECKPOINT_H
#include "common/mesh/mesh.h"
#include "common/output/checkpoint.h"

PetscErrorCode MeshSave(const Mesh *mesh, Checkpoint to);
/* row[mesh->ne], to be PetscFree'd: the rows of this rank's elements.  As many ranks as have saved it get the
 * same Mesh, to the last bit and with the same numbers; else it is partitioned and ordered anew.  An element
 * begins with the same vertex in any case. */
PetscErrorCode MeshLoad(MPI_Comm comm, Checkpoint from, Mesh **mesh, PetscInt **row);
/* value[mesh->ne][ncol] of another table with a row an element. */
PetscErrorCode MeshLoadDoubles(const Mesh *mesh, const PetscInt row[], Checkpoint from, const char *name,
                               int ncol, double value[]);
#endif
