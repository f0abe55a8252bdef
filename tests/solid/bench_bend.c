/* The work of fracture: a notched beam on two rollers, pressed down in the middle, cracks from the notch
 * upwards.  What the load has put in, less the strain and motion that are left, is G_f per unit of new
 * surface.
 *
 *                 | load          joints in the middle third of the span; the rollers are without friction
 *     +-----------v-----------+
 *     |       :   |   :       |   notch of two fifths of the height
 *     +-----------|-----------+
 *       o                   o
 *
 *     bench_bend [cells ...]      prints a table and fails if at the finest mesh the energy of the cracks is
 * off by more than 5 % of G_f times their length, or the work that is missing by more than 5 % of the energy
 * that all joints took */
#include "tests/solid/crack.h"

#define SPAN 0.24    /* m */
#define HEIGHT 0.06  /* m */
#define NOTCH 0.024  /* m */
#define RADIUS 0.006 /* of the rollers, m */
#define TENSILE 5e6  /* Pa */
#define ENERGY 10.0  /* G_f, J/m2 */
#define SPEED 0.02   /* m/s */
#define START 2e-3   /* until it has that speed, s */
#define STEP 1e-5    /* s */
enum { STEPS = 900, PUNCH = 3 };

typedef struct {
  double peak, work, missing; /* N/m; put in, and not there any more, J/m */
  FractureState f;
} Bend;

/* Vertices of the notch twice, for the elements on its left and on its right. */
static PetscErrorCode Cut(MeshSerial *m)
{
  const int nv = m->nv;
  int *right;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)nv, &right));
  PetscCall(PetscRealloc(4 * (size_t)nv * sizeof *m->x, &m->x));
  for (int v = 0; v < nv; v++) {
    right[v] = v;
    if (fabs(m->x[2 * v]) > 1e-9 || m->x[2 * v + 1] > NOTCH - 0.5 * HEIGHT - 1e-9) continue;
    right[v] = m->nv++;
    for (int c = 0; c < 2; c++) m->x[2 * right[v] + c] = m->x[2 * v + c];
  }
  for (int e = 0; e < m->ne; e++) {
    int *vertex = m->vertex + 3 * e;
    if (m->x[2 * vertex[0]] + m->x[2 * vertex[1]] + m->x[2 * vertex[2]] < 0.0) continue;
    for (int i = 0; i < 3; i++) vertex[i] = right[vertex[i]];
  }
  PetscCall(PetscFree(right));
  PetscFunctionReturn(0);
}

static PetscErrorCode Bodies(Model *a, int cells)
{
  const double box[1][4] = {{-SPAN / 6.0, -1.0, SPAN / 6.0, 1.0}}, y = 0.5 * HEIGHT + RADIUS * (1.0 + 1e-5);
  const double centre[2] = {0.0, 0.0};
  const Material rock = RockOf(TENSILE, 3.0 * TENSILE, ENERGY, 0.1);
  BodySetup beam = BodyAtRest(rock), roller = BodyAtRest(rock);
  MeshSerial mesh;
  PetscFunctionBeginUser;
  beam.joints = (JointSetup){.nboxes = 1, .box = box};
  roller.fixed = 1;
  PetscCall(ShapeRectangle(centre, SPAN + HEIGHT, HEIGHT, 0.0, HEIGHT / cells, &mesh));
  PetscCall(Cut(&mesh));
  AddMesh(a, &mesh, &beam);
  AddDisc(a, -0.5 * SPAN, -y, RADIUS, 0.25 * RADIUS, &roller);
  AddDisc(a, 0.5 * SPAN, -y, RADIUS, 0.25 * RADIUS, &roller);
  AddDisc(a, 0.0, y, RADIUS, 0.25 * RADIUS, &roller);
  PetscFunctionReturn(0);
}

/* The load comes down with this speed; its nodes are fixed and keep their velocity. */
static void Lower(Solid s, const Model *a, double speed)
{
  double *v;
  const SolidView view = ViewOf(s, NULL, &v);
  for (int n = 0; n < view.nnodes; n++)
    if (view.gid[n] < a->nnodes && a->node_body[view.gid[n]] == PUNCH) v[2 * n + 1] = -speed;
}

static PetscErrorCode BendIt(int cells, Bend *b)
{
  const SolidSetup options = {.courant = 0.8};
  Model a = {0};
  BodyState state;
  Solid s;
  double before = 0.0, force = 0.0, speed, last = 0.0;
  PetscFunctionBeginUser;
  PetscCall(Bodies(&a, cells));
  *b = (Bend){.peak = 0.0};
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, &s));
  for (int k = 0; k < STEPS && b->f.length < 0.99 * (HEIGHT - NOTCH); k++) {
    speed = SPEED * fmin(1.0, (k + 0.5) * STEP / START);
    Lower(s, &a, speed);
    PetscCall(Run(s, STEP, STEP));
    PetscCall(SupportReaction(s, 1, -speed, &force));
    PetscCall(SolidFracture(s, &b->f));
    PetscCall(SolidBodies(s, 1, &state));
    b->peak = fmax(b->peak, -force);
    b->work -= 0.5 * STEP * (last * before + speed * force);
    b->missing = b->work - state.strain - state.kinetic;
    before = force;
    last = speed;
    if (getenv("VERBOSE") && k % 25 == 0)
      printf("%g mm, %g N/m, work %g strain %g kinetic %g missing %g fracture %g, %d live, %d broken\n",
             1e3 * SPEED * (SolidGetStats(s)->t - 0.5 * START), -force, b->work, state.strain, state.kinetic,
             b->missing, b->f.energy, b->f.active, b->f.broken);
  }
  PetscCall(ModelDestroy(&a));
  PetscCall(SolidDestroy(&s));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const int standard[] = {10, 20};
  const int n = argc > 1 ? argc - 1 : 2;
  double cracks = 0.0, missing = 0.0;
  PetscCall(PetscInitialize(NULL, NULL, NULL, NULL));
  printf("cells  P_max [N/m]  6 M/(l^2 f_t)  crack [l]  energy of cracks/(G_f cracks)  missing work/that of "
         "joints  live\n");
  for (int k = 0; k < n; k++) {
    const int cells = argc > 1 ? atoi(argv[k + 1]) : standard[k];
    Bend b;
    PetscCall(BendIt(cells, &b));
    cracks = b.f.debonded / (ENERGY * b.f.length);
    missing = b.missing / b.f.energy; /* with that of the joints that are being debonded */
    printf("%5d  %11.4g  %13.4f  %9.3f  %29.4f  %27.4f  %4d\n", cells, b.peak,
           1.5 * b.peak * SPAN / ((HEIGHT - NOTCH) * (HEIGHT - NOTCH) * TENSILE),
           b.f.length / (HEIGHT - NOTCH), cracks, missing, b.f.active);
    CHECK(b.f.length > 0.9 * (HEIGHT - NOTCH), "only %g m have cracked", b.f.length);
  }
  CHECK(fabs(cracks - 1.0) < 0.05, "the cracks have taken %g of G_f l", cracks);
  CHECK(fabs(missing - 1.0) < 0.05, "%g of what the joints took is missing", missing);
  return PetscFinalize();
}
