// ranks: 1 3
/* Meshes of different domains are refused with the reason. */
#include "common/transfer/transfer.h"
#include "tests/transfer/shaken.h"

static char said[1024];

static PetscErrorCode Listen(MPI_Comm comm, int line, const char *function, const char *file,
                             PetscErrorCode code, PetscErrorType type, const char *message, void *context)
{
  if (message && type == PETSC_ERROR_INITIAL) snprintf(said, sizeof said, "%s", message);
  return code;
}

static PetscErrorCode Box(double width, Mesh **mesh)
{
  const double lower[2] = {0.0, 0.0}, upper[2] = {width, 1.0};
  MeshSerial serial = {0};
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank == 0) {
    const Shaken unit = {8, 1, 1.0, {0}};
    PetscCall(ShakenSerial(&unit, &serial));
    for (int v = 0; v < serial.nv; v++) {
      for (int c = 0; c < 2; c++) serial.x[2 * v + c] *= upper[c] - lower[c];
    }
  }
  PetscCall(MeshDistribute(PETSC_COMM_WORLD, &serial, mesh));
  PetscCall(MeshSerialDestroy(&serial));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Mesh *from, *to;
  Transfer transfer = NULL;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Box(1.0, &from));
  PetscCall(Box(1.001, &to));
  PetscCall(PetscPushErrorHandler(Listen, NULL));
  const PetscErrorCode code = TransferCreate(from, to, &transfer);
  PetscCall(PetscPopErrorHandler());
  CHECK(code == PETSC_ERR_ARG_INCOMP && strstr(said, "not of the same domain"), "error %d: %s", (int)code,
        said);
  PetscCall(MeshDestroy(&from));
  PetscCall(MeshDestroy(&to));
  return PetscFinalize();
}
