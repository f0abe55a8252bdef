/* A complete fluid in one page, in place of coracle-fluid: dust, a medium without pressure and viscosity that the solid takes
 * along.  What a flow solver does more goes where u_star and u_projected are computed.
 *
 *       2---1 2       the mesh is that of fluid.mesh: rectangles cut into two triangles, dealt to the ranks by rows;
 *       |  / /|       velocity is linear on each triangle and discontinuous between them, u[element][component][vertex]
 *       | / / |
 *       |/ /  |
 *       0 0---1 */
#include <case_file.h>
#include <coracle.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef double Velocity[2][3]; /* m/s */

typedef struct {
  CoracleClient client;
  double lower[2], upper[2], density, viscosity, area, dt_max;
  int n;             /* elements of this rank */
  double (*x)[3][2]; /* [n] m */
  Velocity *u;       /* [n], what a step changes; the library restores it when a step is redone */
  int nnear, *near;  /* the elements that the coupler knows, by its numbers */
  double (*x_near)[3][2], *rho, *mu, *p; /* what it gets of them */
  Velocity *u_start, *u_star;
} Dust;

static void ReadCase(Dust *d, int argc, char **argv, int cells[2])
{
  CoracleCase c;
  CoracleCaseOpen(argc, argv, CoracleFailMessage, d->client, &c);
  CoracleCaseVector(c, "fluid.mesh.lower", 2, d->lower);
  CoracleCaseVector(c, "fluid.mesh.upper", 2, d->upper);
  d->density = CoracleCasePositive(c, "fluid.density");
  d->viscosity = CoracleCasePositive(c, "fluid.viscosity");
  d->dt_max = CoracleCasePositive(c, "time.dt_max");
  const double size = CoracleCasePositive(c, "fluid.mesh.size_max");
  for (int k = 0; k < 2; k++) cells[k] = (int)ceil((d->upper[k] - d->lower[k]) / size - 1e-9);
  CoracleCaseClose(&c);
}

static void MakeMesh(Dust *d, const int cells[2], int rank, int size)
{
  static const int CORNER[2][3][2] = {{{0, 0}, {1, 1}, {0, 1}}, {{0, 0}, {1, 0}, {1, 1}}};
  const int first = cells[1] * rank / size, last = cells[1] * (rank + 1) / size;
  const size_t n = (size_t)(d->n = 2 * cells[0] * (last - first));
  double h[2];
  for (int c = 0; c < 2; c++) h[c] = (d->upper[c] - d->lower[c]) / cells[c];
  d->area = 0.5 * h[0] * h[1];
  d->x = malloc(n * sizeof *d->x + 1);
  d->x_near = malloc(n * sizeof *d->x + 1);
  d->u = calloc(n + 1, sizeof *d->u);
  d->u_start = malloc(n * sizeof *d->u + 1);
  d->u_star = malloc(n * sizeof *d->u + 1);
  d->near = malloc(n * sizeof *d->near + 1);
  d->rho = malloc(n * sizeof *d->rho + 1);
  d->mu = malloc(n * sizeof *d->mu + 1);
  d->p = calloc(6 * n + 1, sizeof *d->p);
  for (int e = 0; e < d->n; e++)
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) {
        const int cell = c ? first + e / 2 / cells[0] : e / 2 % cells[0];
        d->x[e][i][c] = d->lower[c] + h[c] * (cell + CORNER[e % 2][i][c]);
      }
}

static bool Overlaps(const double x[3][2], const double box[4])
{
  for (int c = 0; c < 2; c++)
    if (fmin(fmin(x[0][c], x[1][c]), x[2][c]) > box[2 + c] || fmax(fmax(x[0][c], x[1][c]), x[2][c]) < box[c])
      return false;
  return true;
}

/* CoracleRegionFunction */
static int Region(void *context, int nbox, const double box[], CoracleElements *elements)
{
  Dust *d = context;
  d->nnear = 0;
  for (int e = 0; e < d->n; e++) {
    bool near = false;
    for (int b = 0; b < nbox; b++) near |= Overlaps((const double(*)[2])d->x[e], box + 4 * b);
    if (!near) continue;
    memcpy(d->x_near[d->nnear], d->x[e], sizeof d->x[e]);
    d->rho[d->nnear] = d->density;
    d->mu[d->nnear] = d->viscosity;
    d->near[d->nnear++] = e;
  }
  *elements = (CoracleElements){.n = d->nnear, .x = &d->x_near[0][0][0], .rho = d->rho, .mu = d->mu};
  return 0;
}

/* x = A^-1 x by Gauss' elimination; A, of a positive definite system, is overwritten. */
static void Solve(int n, double A[], double x[])
{
  for (int k = 0; k < n; k++)
    for (int i = 0; i < n; i++) {
      const double f = A[n * i + k] / A[n * k + k];
      for (int j = k; i != k && j < n; j++) A[n * i + j] -= f * A[n * k + j];
      if (i != k) x[i] -= f * x[k];
    }
  for (int i = 0; i < n; i++) x[i] /= A[n * i + i];
}

/* int N_i N_j over an element, m2 */
static double Mass(const Dust *d, int i, int j)
{
  return d->area / 12.0 * (i == j ? 2.0 : 1.0);
}

/* In a run's first step the dust inside the solid moves with it. */
static void Begin(Dust *d, int n, const CoracleCoupling k[])
{
  for (int m = 0; m < n; m++)
    for (int i = 0; i < 6; i++) {
      double *u = &d->u[d->near[k[m].element]][i / 3][i % 3];
      *u += k[m].alpha * (k[m].velocity[i / 3] - *u);
    }
}

/* rho M/dt (u* - u) + inertia (tensor u* - kept u) + a u* = s on the coupled elements, 0 in place of u where they are covered;
 * elsewhere nothing acts. */
static void Advance(Dust *d, double t, double dt)
{
  const CoracleCoupling *k;
  int n;
  CoracleGetCoupling(d->client, &n, &k);
  if (t == 0.0) Begin(d, n, k);
  for (int e = 0; e < d->nnear; e++) memcpy(d->u_start[e], d->u[d->near[e]], sizeof *d->u);
  if (d->nnear) memcpy(d->u_star, d->u_start, (size_t)d->nnear * sizeof *d->u);
  for (int m = 0; m < n; m++) {
    double A[36], *u = &d->u_star[k[m].element][0][0], load[6];
    for (int r = 0; r < 6; r++) {
      load[r] = k[m].s[r / 3][r % 3];
      for (int q = 0; q < 6; q++) {
        const double mass = r / 3 == q / 3 ? d->density / dt * Mass(d, r % 3, q % 3) : 0.0;
        const double inertia = k[m].implicit_inertia[r % 3][q % 3];
        A[6 * r + q] =
            mass + inertia * k[m].inertia_tensor[r / 3][q / 3] + k[m].a[r / 3][r % 3][q / 3][q % 3];
        load[r] +=
            (k[m].flags & CORACLE_IS_COVERED ? 0.0 : mass * u[q]) + inertia * k[m].kept[r / 3][q / 3] * u[q];
      }
    }
    Solve(6, A, load);
    memcpy(u, load, sizeof load);
  }
}

/* u += M^-1 r inside the solid; the elements, near[], are those that the step began with. */
static void Correct(Dust *d, const int near[])
{
  const CoracleCorrection *k;
  int n;
  CoracleGetCorrection(d->client, &n, &k);
  for (int m = 0; m < n; m++)
    for (int c = 0; c < 2; c++) {
      double M[9], du[3];
      for (int i = 0; i < 9; i++) M[i] = Mass(d, i / 3, i % 3);
      memcpy(du, k[m].r[c], sizeof du);
      Solve(3, M, du);
      for (int i = 0; i < 3; i++) d->u[near[k[m].element]][c][i] += du[i];
    }
}

static void Step(Dust *d, double t, double dt)
{
  const int n = d->nnear;
  int *near = malloc((size_t)n * sizeof *near + 1);
  memcpy(near, d->near, (size_t)n * sizeof *near);
  Advance(d, t, dt);
  /* a projection has the bulk velocity u* + M^-1 (us - ms u*) and W = rho M/dt + implicit_inertia inertia_tensor */
  Velocity *u_projected = d->u_star;
  const CoracleFlow flow = {.u_start = &d->u_start[0][0][0],
                            .u_star = &d->u_star[0][0][0],
                            .u_projected = &u_projected[0][0][0],
                            .p = CoracleNeedsPressure(d->client) ? d->p : NULL,
                            .rho = d->rho,
                            .mu = d->mu};
  CoracleSetFlow(d->client, &flow);
  CoracleProposeStep(d->client, d->dt_max);
  CoracleEnd(d->client, NULL);
  if (CoracleStepAccepted(d->client)) {
    for (int e = 0; e < n; e++) memcpy(d->u[near[e]], u_projected[e], sizeof *d->u);
    Correct(d, near);
  }
  free(near);
}

int main(int argc, char **argv)
{
  static Dust d;
  MPI_Comm comm;
  CoracleAction action;
  double t, dt;
  int rank, size, cells[2];
  CoracleOpen("fluid", argc, argv, &comm, &d.client);
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  ReadCase(&d, argc, argv, cells);
  MakeMesh(&d, cells, rank, size);
  CoracleSetRegion(d.client, CORACLE_DIM, d.lower, d.upper, Region, &d);
  CoracleBindState(d.client, d.u, ((size_t)d.n + 1) * sizeof *d.u);
  CoracleProposeStep(d.client, d.dt_max);
  CoracleReady(d.client);
  for (;;) {
    CoracleBegin(d.client, &t, &dt, &action);
    if (action == CORACLE_STOP) break;
    Step(&d, t, dt);
  }
  void *all[] = {d.x, d.x_near, d.u, d.u_start, d.u_star, d.near, d.rho, d.mu, d.p};
  for (int k = 0; k < 9; k++) free(all[k]);
  return CoracleClose(&d.client);
}
