// ranks: 1 2
/* Fragments smaller than an element, in a uniform flow: a drop, a bubble and the second of three phases go with it whatever the step, on any number
 * of ranks; all volumes are kept and bounded, through an adaptation of the mesh, too.  With a line from the elements around, which say nothing, a
 * fragment hangs where it is.  A film on a wall, thinner still, has its
 * lines and stays as it is; dust has no surface, and on the interface of two other
 * phases no line.
 *
 * fragments print: also says how well. */
#include "tests/phases/flows.h"
#include "tests/phases/set.h"

#define N 16
#define H (1.0 / N)
#define SHIFT 0.25 /* m */
static const double START[2] = {0.41, 0.43};
static int print;

static double Oblique(const double x[2])
{
  return 0.8 * x[1] - 0.6 * x[0];
}

static void ObliqueVelocity(const double x[2], double u[2])
{
  u[0] = 0.8;
  u[1] = 0.6;
}

static double Along(const double x[2])
{
  return x[1];
}

static void AlongVelocity(const double x[2], double u[2])
{
  u[0] = 1.0;
  u[1] = 0.0;
}

/* Of a phase: the mean place, each element's volume at its centre, m. */
static void Centre(const Mesh *m, int np, int phase, const double volume[], double centre[2])
{
  double sum[3] = {0.0};
  for (int e = 0; e < m->ne; e++) {
    const double v = volume[np * e + phase];
    sum[2] += v;
    for (int k = 0; k < 6; k++) sum[k % 2] += v * Corner(m, e, k / 2)[k % 2] / 3.0;
  }
  MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPI_DOUBLE, MPI_SUM, m->comm);
  for (int c = 0; c < 2; c++) centre[c] = sum[c] / sum[2];
}

/* out[np] += what leaves the mesh, m2. */
static void AddOut(const Mesh *m, int np, const double swept[], double out[])
{
  double sum[PHASES_MAX] = {0.0};
  for (int k = 0; k < 3 * np * m->ne; k++)
    if (m->neighbor[k / np] < 0) sum[k % np] += swept[k];
  MPI_Allreduce(MPI_IN_PLACE, sum, np, MPI_DOUBLE, MPI_SUM, m->comm);
  for (int p = 0; p < np; p++) out[p] += sum[p];
}

static void Kept(const char *name, int np, const PhasesStats *first, const double out[],
                 const PhasesStats *now)
{
  for (int p = 0; p < np; p++)
    CHECK(fabs(now->volume[p] + out[p] - first->volume[p]) < 1e-13,
          "%s: of phase %d there are %.17g of %.17g m2, %g m2 have left", name, p, now->volume[p],
          first->volume[p], out[p]);
  CHECK(now->lowest > -1e-12 && now->highest < 1.0 + 1e-12 && now->gap < 1e-11,
        "%s: fractions %g .. 1 + %g, gap %g", name, now->lowest, now->highest - 1.0, now->gap);
}

/* As the mesh after an adaptation has them. */
static PetscErrorCode Adapt(int np, Set *s)
{
  Transfer transfer;
  Mesh *mesh;
  Set next;
  double *metric, *size;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(s->mesh->nv, &size, 3 * s->mesh->nv, &metric));
  for (int v = 0; v < s->mesh->nv; v++) size[v] = 0.8 * H;
  PetscCall(MetricFromSizes(s->mesh->nv, size, metric));
  PetscCall(MeshAdaptParallel(s->mesh, metric, &mesh, NULL));
  PetscCall(SetMake(mesh, np, &next));
  PetscCall(PhasesReconstruct(s->phases));
  PetscCall(TransferCreate(s->mesh, mesh, &transfer));
  PetscCall(PhasesRemap(s->phases, transfer, next.phases));
  PetscCall(TransferDestroy(&transfer));
  PetscCall(PetscFree2(size, metric));
  PetscCall(SetDestroy(s));
  *s = next;
  PetscFunctionReturn(0);
}

/* A disc of 0.3 of an element, of `phase` in the phase `around`, goes SHIFT in so many steps. */
static PetscErrorCode Moves(MPI_Comm comm, const char *name, int np, int phase, int around, int steps,
                            double centre[2])
{
  const Shaken shaken = {.n = N, .seed = 21u, .radius = 1.0};
  const Flow flow = {Oblique, ObliqueVelocity, 0.0, 0, 1.0, 1.0};
  Region region[2] = {{.shape = REGION_BOX, .phase = around, .a = {-1.0, -1.0}, .b = {2.0, 2.0}},
                      {.shape = REGION_DISC, .phase = phase, .a = {START[0], START[1]}}};
  double out[PHASES_MAX] = {0.0}, fraction[4][PHASES_MAX] = {{0.0}}, *flux, *velocity, *swept;
  const PhasesInflow inflow = {.fraction = (const double(*)[PHASES_MAX])fraction};
  PhasesStats first, now;
  const double *volume;
  Mesh *mesh;
  Set s;
  PetscFunctionBeginUser;
  region[1].radius = sqrt(0.3 * 0.5 / M_PI) * H;
  for (int k = 0; k < 4; k++) fraction[k][around] = 1.0;
  PetscCall(ShakenMesh(comm, &shaken, &mesh));
  PetscCall(SetMake(mesh, np, &s));
  PetscCall(PhasesFill(s.phases, 2, region));
  PetscCall(PhasesGetStats(s.phases, &first));
  PetscCall(PhasesGetVolumes(s.phases, &volume));
  double start[2];
  Centre(mesh, np, phase, volume, start);
  PetscCall(PetscMalloc3(3 * mesh->ne, &flux, 6 * mesh->ne, &velocity, 3 * np * mesh->ne, &swept));
  FlowAt(&flow, mesh, 0.0, flux, velocity);
  for (int k = 0; k < steps; k++) {
    PetscCall(PhasesReconstruct(s.phases));
    PetscCall(PhasesAdvect(s.phases, SHIFT / steps, flux, velocity, &inflow, swept, NULL));
    AddOut(mesh, np, swept, out);
  }
  PetscCall(PhasesGetStats(s.phases, &now));
  PetscCall(PhasesGetVolumes(s.phases, &volume));
  Centre(mesh, np, phase, volume, centre);
  const double off = hypot(centre[0] - start[0] - 0.8 * SHIFT, centre[1] - start[1] - 0.6 * SHIFT);
  double length;
  PetscCall(PhasesReconstruct(s.phases));
  PetscCall(PhasesInterfaceLength(s.phases, phase, &length));
  length /= 2.0 * M_PI * region[1].radius;
  if (print)
    PetscCall(PetscPrintf(comm,
                          "%-16s %4d steps: off by %.3f of an edge, interface %.2f of its circumference\n",
                          name, steps, off / H, length));
  CHECK(length < 2.0, "%s, %d steps: its interface is %g times its circumference", name, steps, length);
  CHECK(off < 0.5 * H, "%s, %d steps: it is %g of an edge from where the flow takes it", name, steps,
        off / H);
  Kept(name, np, &first, out, &now);
  PetscCall(PetscFree3(flux, velocity, swept));
  PetscCall(Adapt(np, &s));
  PetscCall(PhasesGetStats(s.phases, &now));
  Kept("adapted", np, &first, out, &now);
  PetscCall(PhasesGetVolumes(s.phases, &volume));
  double after[2];
  Centre(s.mesh, np, phase, volume, after);
  CHECK(hypot(after[0] - centre[0], after[1] - centre[1]) < 0.25 * H,
        "%s: an adaptation moves it by %g of an edge", name,
        hypot(after[0] - centre[0], after[1] - centre[1]) / H);
  PetscCall(SetDestroy(&s));
  PetscFunctionReturn(0);
}

/* On all ranks together and on each alone. */
static PetscErrorCode MovesAlike(const char *name, int np, int phase, int around, int steps)
{
  double all[2], alone[2];
  PetscFunctionBeginUser;
  PetscCall(Moves(PETSC_COMM_WORLD, name, np, phase, around, steps, all));
  PetscCall(Moves(PETSC_COMM_SELF, name, np, phase, around, steps, alone));
  CHECK(hypot(all[0] - alone[0], all[1] - alone[1]) < 1e-9 * H,
        "%s, %d steps: it is %g m from where one rank has it", name, steps,
        hypot(all[0] - alone[0], all[1] - alone[1]));
  PetscFunctionReturn(0);
}

/* What round-off has left of a phase over many elements, uneven, has no surface: no tension and no length. */
static PetscErrorCode Dust(void)
{
  const PhasesPairs tension = {{{0.0, 1.0}, {1.0, 0.0}}};
  double *volume, *force, length, most = 0.0;
  Mesh *mesh;
  Set s;
  PetscFunctionBeginUser;
  PetscCall(UnstructuredMesh(PETSC_COMM_WORLD, H, &mesh));
  PetscCall(SetMake(mesh, 2, &s));
  PetscCall(PetscMalloc2(2 * mesh->ne, &volume, 2 * mesh->ne, &force));
  for (int e = 0; e < mesh->ne; e++) {
    const double *x = Corner(mesh, e, 0), area = ElementArea(mesh, e);
    volume[2 * e] = fabs(x[0] - 0.5) < 0.3 ? (2.0 + sin(40.0 * x[0]) * sin(70.0 * x[1])) * 1e-12 * area : 0.0;
    volume[2 * e + 1] = area - volume[2 * e];
  }
  PetscCall(PhasesSetVolumes(s.phases, volume));
  PetscCall(PhasesReconstruct(s.phases));
  PetscCall(PhasesGetSurfaceForce(s.phases, &tension, NULL, force));
  PetscCall(PhasesInterfaceLength(s.phases, 0, &length));
  for (int k = 0; k < 2 * mesh->ne; k++) most = fmax(most, fabs(force[k]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, mesh->comm));
  CHECK(most == 0.0 && length == 0.0, "dust has a tension of %g of 1/h^2, %g m of interface", most * H * H,
        length);
  PetscCall(PetscFree2(volume, force));
  PetscCall(SetDestroy(&s));
  PetscFunctionReturn(0);
}

/* A film of a twentieth of an edge on the wall below flows along it and does not get thicker. */
static PetscErrorCode Film(void)
{
  const double depth = 0.05 * H;
  const Flow flow = {Along, AlongVelocity, 0.0, 0, 1.0, 1.0};
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1.0, -1.0}, .b = {2.0, 2.0}},
                            {.shape = REGION_BOX, .phase = 0, .a = {-1.0, -1.0}, .b = {2.0, depth}}};
  double fraction[4][PHASES_MAX] = {{0.0}}, *flux, *velocity, worst = 0.0;
  PhasesLevels levels[4] = {{0}};
  const PhasesInflow inflow = {.fraction = (const double(*)[PHASES_MAX])fraction, .levels = levels};
  const double *volume, *exact;
  Mesh *mesh;
  Set s, still;
  PetscFunctionBeginUser;
  for (int k = 0; k < 4; k++) fraction[k][1] = 1.0;
  PetscCall(UnstructuredMesh(PETSC_COMM_WORLD, H, &mesh));
  for (int k = 0; k < 4; k++)
    levels[k] = (PhasesLevels){.n = 1, .phase = {0}, .normal = {0.0, 1.0}, .d = {depth}};
  PetscCall(SetMake(mesh, 2, &s));
  still = s;
  PetscCall(PhasesCreate(s.stars, 2, &still.phases));
  PetscCall(PhasesFill(s.phases, 2, region));
  PetscCall(PhasesFill(still.phases, 2, region));
  PetscCall(PetscMalloc2(3 * mesh->ne, &flux, 6 * mesh->ne, &velocity));
  FlowAt(&flow, mesh, 0.0, flux, velocity);
  for (int k = 0; k < 20; k++) {
    PetscCall(PhasesReconstruct(s.phases));
    PetscCall(PhasesAdvect(s.phases, 0.02, flux, velocity, &inflow, NULL, NULL));
  }
  PetscCall(PhasesGetVolumes(s.phases, &volume));
  PetscCall(PhasesGetVolumes(still.phases, &exact));
  for (int e = 0; e < mesh->ne; e++)
    worst = fmax(worst, fabs(volume[2 * e] - exact[2 * e]) / ElementArea(mesh, e));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, mesh->comm));
  CHECK(worst < 1e-9, "a film along a wall changes by %g of an element", worst);
  PetscCall(PetscFree2(flux, velocity));
  PetscCall(PhasesDestroy(&still.phases));
  PetscCall(SetDestroy(&s));
  PetscFunctionReturn(0);
}

/* What round-off has left of one phase on the interface of two others does not change how elements respond. */
static PetscErrorCode DustOnInterface(MPI_Comm comm, int phase)
{
  enum { NP = 3 };
  static const double RHO[NP] = {1000.0, 1.3, 1.2}, GRAVITY[2] = {0.0, -9.81};
  const Shaken shaken = {.n = N, .seed = 21u, .radius = 1.0};
  const Region region[2] = {{.shape = REGION_BOX, .phase = 3 - phase, .a = {-1.0, -1.0}, .b = {2.0, 2.0}},
                            {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, 0.5}, .b = {0.1, 1.0}}};
  InverseDensity *clean, *dusty;
  const double *found;
  double *volume;
  Mesh *mesh;
  Set s;
  PetscFunctionBeginUser;
  PetscCall(ShakenMesh(comm, &shaken, &mesh));
  PetscCall(SetMake(mesh, NP, &s));
  PetscCall(PetscMalloc3(mesh->ne + 1, &clean, mesh->ne + 1, &dusty, NP * mesh->ne, &volume));
  PetscCall(PhasesFill(s.phases, 2, region));
  PetscCall(PhasesReconstruct(s.phases));
  PetscCall(PhasesGetInverseDensity(s.phases, RHO, GRAVITY, clean));
  PetscCall(PhasesGetVolumes(s.phases, &found));
  PetscCall(PetscArraycpy(volume, found, NP * mesh->ne));
  for (int e = 0; e < mesh->ne; e++) {
    if (PhasesSingle(s.phases, e) < 0 && e % 3 == 0) volume[NP * e + phase] = 2e-12 * StarsArea(s.stars, e);
  }
  PetscCall(PhasesSetVolumes(s.phases, volume));
  PetscCall(PhasesReconstruct(s.phases));
  PetscCall(PhasesGetInverseDensity(s.phases, RHO, GRAVITY, dusty));
  for (int e = 0; e < mesh->ne; e++)
    for (int k = 0; k < 3; k++)
      CHECK(fabs(dusty[e].inverse[k] - clean[e].inverse[k]) <
                1e-6 * (clean[e].inverse[0] + clean[e].inverse[2]),
            "dust of phase %d: element %d has %g m3/kg in place of %g", phase, e, dusty[e].inverse[k],
            clean[e].inverse[k]);
  PetscCall(PetscFree3(clean, dusty, volume));
  PetscCall(SetDestroy(&s));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  print = argc > 1;
  for (int steps = 16; steps <= 64; steps *= 4) {
    PetscCall(MovesAlike("drop", 2, 0, 1, steps));
    PetscCall(MovesAlike("bubble", 2, 1, 0, steps));
    PetscCall(MovesAlike("second of three", 3, 1, 2, steps));
  }
  PetscCall(Film());
  PetscCall(Dust());
  for (int phase = 1; phase < 3; phase++) PetscCall(DustOnInterface(PETSC_COMM_WORLD, phase));
  return PetscFinalize();
}
