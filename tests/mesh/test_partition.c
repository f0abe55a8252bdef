// ranks: 1 2 3 5
/* Distribution: the same triangles on any number of ranks, neighbours that agree, vertices numbered without gaps,
 * ranks without elements. */
#include "tests/handlers.h"
#include "tests/mesh/distributed.h"

static PetscErrorCode Distributed(BoxCase *box, Mesh **mesh)
{
  MeshSerial serial = {0};
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank == 0) PetscCall(MeshBox(LOWER, box->upper, box->size_max, StripSize, &box->strip, &serial));
  PetscCall(MeshDistribute(PETSC_COMM_WORLD, &serial, mesh));
  PetscCall(MeshSerialDestroy(&serial));
  PetscFunctionReturn(0);
}

/* Parts are of nearly equal size and neighbouring elements close in number: what METIS and the ordering are
 * for. */
static void CheckQuality(const Mesh *m)
{
  PetscMPIInt size;
  double far = 0.0;
  MPI_Comm_size(m->comm, &size);
  CHECK(m->ne < 1.06 * (double)m->nglobal / size, "%d of %d elements on one of %d ranks", m->ne,
        (int)m->nglobal, size);
  for (int k = 0; k < 3 * m->ne; k++) {
    if (m->neighbor[k] >= 0 && m->neighbor[k] < m->ne) far = fmax(far, abs(m->neighbor[k] - k / 3));
  }
  CHECK(far < 6.0 * sqrt((double)m->nglobal), "bandwidth %g of %d elements", far, m->ne);
}

int main(int argc, char **argv)
{
  /* a graded mesh, and two triangles: from three ranks on some have none */
  BoxCase box[] = {{{2.5, 5.5}, 0.1, {0.02, {1.08, 1.0}, {1.42, 4.95}, 0.25}},
                   {{1.0, 1.0}, 10.0, {10.0, {0, 0}, {1, 1}, 0.0}}};
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  HandlersSet();
  for (int k = 0; k < 2; k++) {
    MeshSerial serial;
    Mesh *mesh;
    PetscCall(MeshBox(LOWER, box[k].upper, box[k].size_max, StripSize, &box[k].strip, &serial));
    PetscCall(Distributed(&box[k], &mesh));
    CHECK(mesh->nglobal == serial.ne, "%d triangles, not %d", (int)mesh->nglobal, serial.ne);
    CheckDistributed(mesh, &box[k], serial.nv);
    if (k == 0)
      CheckQuality(mesh);
    else
      CHECK(mesh->nglobal == 2 && mesh->ne <= 2, "%d triangles", (int)mesh->nglobal);
    PetscCall(MeshSerialDestroy(&serial));
    PetscCall(MeshDestroy(&mesh));
  }
  HandlersCheck();
  return PetscFinalize();
}
