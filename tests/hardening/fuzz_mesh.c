/* Mutants of Gmsh files: each is refused with a message, or is a mesh of triangles of positive area whose indices are within
 * bounds.  Usage: fuzz_mesh COUNT SEED FILE... */
#include "common/mesh/mesh.h"
#include "tests/check.h"
#include "tests/hardening/fuzz.h"
#include <math.h>
#include <unistd.h>

static void CheckMesh(const MeshSerial *m, int mutant)
{
  CHECK(m->ne > 0 && m->nv > 0, "mutant %d: %d triangles, %d vertices", mutant, m->ne, m->nv);
  for (int i = 0; i < 2 * m->nv; i++)
    CHECK(isfinite(m->x[i]), "mutant %d: vertex %d is not finite", mutant, i / 2);
  for (int i = 0; i < 3 * m->ne; i++)
    CHECK(m->vertex[i] >= 0 && m->vertex[i] < m->nv, "mutant %d: triangle %d has vertex %d", mutant, i / 3,
          m->vertex[i]);
  for (int i = 0; i < 2 * m->nb; i++)
    CHECK(m->facet[i] >= 0 && m->facet[i] < m->nv, "mutant %d: facet %d has vertex %d", mutant, i / 2,
          m->facet[i]);
  for (int i = 0; i < m->nb; i++)
    CHECK(m->facet_tag[i] >= 0 && m->facet_tag[i] < m->ntags, "mutant %d: facet %d has tag %d", mutant, i,
          m->facet_tag[i]);
  for (int e = 0; e < m->ne; e++) {
    const double *a = m->x + 2 * m->vertex[3 * e], *b = m->x + 2 * m->vertex[3 * e + 1],
                 *c = m->x + 2 * m->vertex[3 * e + 2];
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    CHECK(area > 0.0, "mutant %d: triangle %d has the area %g", mutant, e, 0.5 * area);
  }
}

int main(int argc, char **argv)
{
  char path[64];
  int accepted = 0;
  CHECK(argc > 3, "fuzz_mesh COUNT SEED FILE...");
  const int count = atoi(argv[1]);
  unsigned long long state = strtoull(argv[2], NULL, 10);
  PetscCall(PetscInitializeNoArguments());
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  snprintf(path, sizeof path, "/tmp/coracle-fuzz-%d.msh", (int)getpid());
  for (int k = 0; k < count; k++) {
    MeshSerial mesh = {0};
    const char *error = NULL;
    Text whole = FuzzRead(argv[3 + k % (argc - 3)]), mutant = FuzzMutate(&whole, &state);
    FuzzWrite(path, &mutant);
    alarm(10); /* a hang ends the test */
    const PetscErrorCode refused = MeshReadGmsh(path, &mesh, &error);
    if (refused)
      CHECK(error && strlen(error) > 10, "mutant %d is refused by '%s'", k, error ? error : "");
    else
      CheckMesh(&mesh, k);
    accepted += !refused;
    if (!refused) PetscCall(MeshSerialDestroy(&mesh));
    free(whole.byte);
    free(mutant.byte);
  }
  unlink(path);
  printf("fuzz_mesh: %d mutants, %d of them meshes\n", count, accepted);
  CHECK(accepted > 0 && accepted < count, "the mutations do not reach far enough");
  return PetscFinalize();
}
