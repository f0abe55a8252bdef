// ranks: 1 2 3
/* The head between solids: a pile of blocks a gap apart, given at the lower side of the lowest and the upper side of the highest, is linear
 * along it, for sides of blocks and gaps resist alike; a block apart has none.  The profile, with 1 m of each side that is close and two
 * links of conductance 1 between one level and the next, is k (m - k)/4 on level k of m.  Blocks are dealt out to ranks in turn, every
 * third one cut in two, and facets of every second one have copies of their nodes; once more with nothing on the last rank. */
#include "coupler/force/gap_head.h"
#include "tests/check.h"

enum { BLOCKS = 60, NODES = 8 * (BLOCKS + 1), N = SURFACE_HEAD_FIELDS };
#define GAP 0.02
static const double LOWEST[N] = {3.0, -1.0, -1.0, 0.1, 1.0}, HIGHEST[N] = {7.0, -1.0, -2.0, 0.5, 1.0};

/* This rank's nodes and facets; corner[i] of node i: 4 block + corner. */
typedef struct {
  SolidState view;
  int corner[NODES], facet[2 * NODES];
  long long gid[NODES];
  double x[2 * NODES], zero[2 * NODES];
} Blocks;

static int NodeOf(Blocks *s, int block, int corner)
{
  const int k = 4 * block + corner;
  for (int i = 0; i < s->view.nnodes && block % 2; i++)
    if (s->corner[i] == k) return i;
  const int i = s->view.nnodes++;
  s->corner[i] = k;
  s->gid[i] = 10 + 3 * k;
  s->x[2 * i] = (corner == 1 || corner == 2 ? 1.0 : 0.0) + (block == BLOCKS ? 5.0 : 0.0);
  s->x[2 * i + 1] = (block == BLOCKS ? 0.0 : (1.0 + GAP) * block) + (corner >= 2 ? 1.0 : 0.0);
  return i;
}

static void Build(Blocks *s, int rank, int size)
{
  memset(s, 0, sizeof *s);
  for (int k = 0; k < 4 * (BLOCKS + 1); k++) {
    const int block = k / 4, side = k % 4;
    if ((block + (block % 3 == 2 && side >= 2)) % size != rank) continue;
    for (int i = 0; i < 2; i++) s->facet[2 * s->view.nfacets + i] = NodeOf(s, block, (side + i) % 4);
    s->view.nfacets++;
  }
  s->view.changed = 1;
  s->view.gid = s->gid;
  s->view.x = s->x;
  s->view.u = s->view.mobility = s->view.acceleration = s->zero;
  s->view.facet = s->facet;
}

/* All on the first `parts` ranks. */
static PetscErrorCode Run(int parts)
{
  static Blocks solid;
  static char is_free[NODES];
  static double value[NODES][N], profile[NODES];
  const double lower[2] = {-HUGE_VAL, -HUGE_VAL}, upper[2] = {HUGE_VAL, HUGE_VAL};
  ClosePoints points = {0};
  Copies nodes;
  Shell shell;
  PetscMPIInt rank;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  Build(&solid, rank, parts);
  PetscCall(ShellCreate(PETSC_COMM_WORLD, 0.001, &shell));
  PetscCall(ShellExtrude(shell, &solid.view, PETSC_TRUE));
  PetscCall(ClosePointsFind(&solid.view, shell, lower, upper, 2.0 * GAP, &points));
  PetscCall(CopiesCreateByNumber(PETSC_COMM_WORLD, solid.view.nnodes, solid.gid, &nodes));
  for (int i = 0; i < solid.view.nnodes; i++) {
    const int block = solid.corner[i] / 4, up = solid.corner[i] % 4 >= 2;
    const double *given = block == 0 && !up ? LOWEST : block == BLOCKS - 1 && up ? HIGHEST : NULL;
    is_free[i] = !given;
    for (int c = 0; c < N; c++) value[i][c] = given ? given[c] : 99.0;
  }
  PetscCall(GapHeadSolve(&points, &solid.view, shell, nodes, is_free, value, profile));
  for (int i = 0; i < solid.view.nnodes; i++) {
    const int block = solid.corner[i] / 4, up = solid.corner[i] % 4 >= 2;
    const double s = (2.0 * block + up) / (2.0 * BLOCKS - 1.0);
    for (int c = 0; c < N; c++) {
      const double expected = block == BLOCKS ? 0.0 : LOWEST[c] + s * (HIGHEST[c] - LOWEST[c]);
      CHECK(fabs(value[i][c] - expected) < 1e-8, "block %d, field %d: %.12g instead of %.12g", block, c,
            value[i][c], expected);
    }
    const double level = 2.0 * block + up,
                 expected = block == BLOCKS ? 0.0 : 0.25 * level * (2.0 * BLOCKS - 1.0 - level);
    CHECK(fabs(profile[i] - expected) < 1e-7 * BLOCKS * BLOCKS,
          "block %d: a profile of %.12g instead of %.12g", block, profile[i], expected);
  }
  memset(is_free, 0, sizeof is_free); /* all given: nothing to solve */
  PetscCall(GapHeadSolve(&points, &solid.view, shell, nodes, is_free, value, profile));
  PetscCall(CopiesDestroy(&nodes));
  PetscCall(ClosePointsDestroy(&points));
  return ShellDestroy(&shell);
}

int main(int argc, char **argv)
{
  PetscMPIInt size;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  PetscCall(Run(size));
  PetscCall(Run(PetscMax(1, size - 1)));
  return PetscFinalize();
}
