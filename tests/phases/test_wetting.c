// ranks: 1 2 3
/* Surface tension with a solid among the phases: none along its wetted surface, next to none where a straight interface meets it at the
 * contact angle; with a drop on a block that moves freely, forces whose sum is small and shrinks with the elements, as of a closed
 * interface.  Any argument: prints. */
#include "fluid/phases/region.h"
#include "fluid/phases/wetting.h"
#include "tests/phases/set.h"
#include "tests/transfer/shaken.h"

enum { SOLID = 2 }; /* the phase of regions that stands for it, behind water and air */

typedef struct {
  int n, nregions; /* cells across */
  Region region[4];
  double cosine, top; /* of contact angles at the solid, at the boundaries */
  int moves;
} Setting;

/* sum[2]: of the forces, largest: of one, N/m; with surface tension 1. */
static PetscErrorCode Forces(const Setting *s, unsigned seed, double sum[2], double *largest)
{
  const Shaken shaken = {.n = s->n, .seed = seed, .radius = 1.0};
  const PhasesPairs tension = {{{0.0, 1.0}, {1.0, 0.0}}}, solid = {{{0.0, s->cosine}, {-s->cosine, 0.0}}};
  PhasesPairs boundary[8] = {0};
  const double *volume;
  double *fluid, *alpha, (*force)[2];
  char *moves;
  Wetting wetting;
  Phases phases;
  Mesh *mesh;
  Set painted;
  PetscFunctionBeginUser;
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  PetscCall(SetMake(mesh, 3, &painted));
  PetscCall(PhasesFill(painted.phases, s->nregions, s->region));
  PetscCall(PhasesGetVolumes(painted.phases, &volume));
  PetscCall(PhasesCreate(painted.stars, 2, &phases));
  PetscCall(PetscMalloc4(2 * mesh->ne, &fluid, mesh->ne, &alpha, mesh->ne, &force, mesh->ne, &moves));
  for (int e = 0; e < mesh->ne; e++) { /* air fills the solid */
    alpha[e] = volume[3 * e + SOLID] / StarsArea(painted.stars, e);
    fluid[2 * e] = volume[3 * e];
    fluid[2 * e + 1] = volume[3 * e + 1] + volume[3 * e + SOLID];
    moves[e] = (char)s->moves;
  }
  PetscCall(PhasesSetVolumes(phases, fluid));
  PetscCall(PhasesReconstruct(phases));
  for (int b = 0; b < mesh->ntags; b++) boundary[b].value[0][1] = s->top;
  PetscCall(WettingCreate(painted.stars, 2, &wetting));
  const WettingSolid in = {alpha, moves, 1};
  const WettingSurface surface = {&tension, boundary, &solid};
  PetscCall(WettingSurfaceForce(wetting, phases, &in, &surface, (double *)force));
  sum[0] = sum[1] = *largest = 0.0;
  for (int e = 0; e < mesh->ne; e++)
    for (int c = 0; c < 2; c++) {
      const double f = force[e][c] * StarsArea(painted.stars, e);
      sum[c] += f;
      *largest = fmax(*largest, fabs(f));
    }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  PetscCall(WettingDestroy(&wetting));
  PetscCall(PetscFree4(fluid, alpha, force, moves));
  PetscCall(PhasesDestroy(&phases));
  PetscCall(SetDestroy(&painted));
  PetscFunctionReturn(0);
}

/* No element has a force, but for what has been taken for a film (WETTING_FILM) at the contact. */
static PetscErrorCode Still(const char *what, const Setting *s, int print)
{
  double sum[2], largest;
  PetscFunctionBeginUser;
  PetscCall(Forces(s, 2, sum, &largest));
  if (print) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: largest force %.1e\n", what, largest));
  CHECK(largest < 1e-3, "%s: a force of %g", what, largest);
  PetscFunctionReturn(0);
}

/* The block's top is at 0.313, the drop's angle is 60 degrees.  *worst: of three meshes. */
static PetscErrorCode Closed(int n, double *worst)
{
  const double r = 0.4, angle = M_PI / 3.0, top = 0.313;
  const Setting s = {
      .n = n,
      .nregions = 3,
      .region = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                 {.shape = REGION_DISC, .phase = 0, .a = {0.503, top - r * cos(angle)}, .radius = r},
                 {.shape = REGION_BOX, .phase = SOLID, .a = {-1, -1}, .b = {2, top}}},
      .cosine = cos(angle),
      .moves = 1};
  PetscFunctionBeginUser;
  *worst = 0.0;
  for (unsigned seed = 1; seed <= 3; seed++) {
    double sum[2], largest;
    PetscCall(Forces(&s, seed, sum, &largest));
    *worst = fmax(*worst, hypot(sum[0], sum[1]));
  }
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const int print = argc > 1;
  const Region air = {.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
               sunk = {.shape = REGION_BOX, .phase = 0, .a = {-1, -1}, .b = {2, 2}},
               disc = {.shape = REGION_DISC, .phase = SOLID, .a = {0.51, 0.49}, .radius = 0.2};
  const Setting wetted = {.n = 16, .nregions = 3, .region = {air, sunk, disc}};
  /* water left of a line that leaves the floor at 0.313 with 60 degrees through it */
  const Setting straight = {
      .n = 16,
      .nregions = 3,
      .region = {air,
                 {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.51, 0.313}, .b = {sqrt(0.75), 0.5}},
                 {.shape = REGION_BOX, .phase = SOLID, .a = {-1, -1}, .b = {2, 0.313}}},
      .cosine = 0.5,
      .top = -0.5};
  double worst[2];
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Still("a disc in water", &wetted, print));
  PetscCall(Still("a straight interface", &straight, print));
  for (int k = 0; k < 2; k++) PetscCall(Closed(16 << k, &worst[k]));
  if (print)
    PetscCall(
        PetscPrintf(PETSC_COMM_WORLD, "a drop on a block that moves: sum %.2e, %.2e\n", worst[0], worst[1]));
  CHECK(worst[1] < 0.1 && worst[0] > 1.5 * worst[1], "a drop on a block that moves: sums %g and %g", worst[0],
        worst[1]);
  return PetscFinalize();
}
