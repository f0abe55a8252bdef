/* A solid disc or square and a fluid mesh for the coupler's tests, dealt out to ranks in any way.
 *
 * The fluid is a random triangulation of the unit square; the disc has rings and sectors, the square two
 * triangles a cell.  Global numbers (gid of nodes, index of fluid elements) are kept so that results can be
 * compared whatever the split. */
#ifndef TESTS_SYNTHETIC_H
#define TESTS_SYNTHETIC_H
#include "coupler/step/coupler.h"
#include "tests/supermesh/random_mesh.h"

enum { SYNTHETIC_MAX = 4000 };

typedef struct {
  SolidState view;
  int nnodes, nfacets, nelements;
  long long gid[SYNTHETIC_MAX];
  double x[SYNTHETIC_MAX][2], u[SYNTHETIC_MAX][2], mobility[SYNTHETIC_MAX], acceleration[SYNTHETIC_MAX][2];
  int facet[SYNTHETIC_MAX][2], element[SYNTHETIC_MAX][3];
} SyntheticSolid;

typedef struct {
  FluidElements view;
  CoracleFlow flow;
  int n, global[SYNTHETIC_MAX];
  double x[SYNTHETIC_MAX][3][2], rho[SYNTHETIC_MAX];
  double u_start[SYNTHETIC_MAX][2][3], u_star[SYNTHETIC_MAX][2][3], u_projected[SYNTHETIC_MAX][2][3],
      p[SYNTHETIC_MAX][6], mu[SYNTHETIC_MAX];
} SyntheticFluid;

static inline void SyntheticSolidView(SyntheticSolid *s)
{
  s->view = (SolidState){.changed = 1,
                         .nnodes = s->nnodes,
                         .nfacets = s->nfacets,
                         .nelements = s->nelements,
                         .gid = s->gid,
                         .x = &s->x[0][0],
                         .u = &s->u[0][0],
                         .mobility = s->mobility,
                         .acceleration = &s->acceleration[0][0],
                         .facet = &s->facet[0][0],
                         .element = &s->element[0][0]};
}

static inline void SyntheticElement(SyntheticSolid *s, int a, int b, int c)
{
  s->element[s->nelements][0] = a;
  s->element[s->nelements][1] = b;
  s->element[s->nelements++][2] = c;
}

static inline void SyntheticFacet(SyntheticSolid *s, int a, int b)
{
  s->facet[s->nfacets][0] = a;
  s->facet[s->nfacets++][1] = b;
}

/* A regular polygon of n sectors with m rings. */
static inline void SyntheticDisc(SyntheticSolid *s, const double centre[2], double radius, int m, int n)
{
  memset(s, 0, sizeof *s);
  for (int k = 0; k <= m * n; k++) {
    const int ring = (k + n - 1) / n;
    const double r = radius * ring / m, angle = 2.0 * M_PI * ((k + n - 1) % n) / n;
    s->x[k][0] = centre[0] + r * cos(angle);
    s->x[k][1] = centre[1] + r * sin(angle);
    s->gid[k] = 100 + 3 * k;
  }
  s->nnodes = m * n + 1;
  for (int i = 0; i < n; i++) {
    const int j = (i + 1) % n;
    SyntheticElement(s, 0, 1 + i, 1 + j);
    for (int ring = 1; ring < m; ring++) {
      const int inner = 1 + (ring - 1) * n, outer = inner + n;
      SyntheticElement(s, inner + i, outer + i, outer + j);
      SyntheticElement(s, inner + i, outer + j, inner + j);
    }
    SyntheticFacet(s, 1 + (m - 1) * n + i, 1 + (m - 1) * n + j);
  }
  SyntheticSolidView(s);
}

/* [lower, lower + side]^2 in n x n cells. */
static inline void SyntheticSquare(SyntheticSolid *s, const double lower[2], double side, int n)
{
  memset(s, 0, sizeof *s);
  for (int k = 0; k < (n + 1) * (n + 1); k++) {
    s->x[k][0] = lower[0] + side * (k % (n + 1)) / n;
    s->x[k][1] = lower[1] + side * (k / (n + 1)) / n;
    s->gid[k] = k;
  }
  s->nnodes = (n + 1) * (n + 1);
  for (int k = 0; k < n * n; k++) {
    const int a = k % n + (n + 1) * (k / n), b = a + 1, c = b + n + 1, d = a + n + 1;
    SyntheticElement(s, a, b, c);
    SyntheticElement(s, a, c, d);
  }
  for (int i = 0; i < n; i++) {
    SyntheticFacet(s, i, i + 1);
    SyntheticFacet(s, n + (n + 1) * i, n + (n + 1) * (i + 1));
    SyntheticFacet(s, n * (n + 1) + i + 1, n * (n + 1) + i);
    SyntheticFacet(s, (n + 1) * (i + 1), (n + 1) * i);
  }
  SyntheticSolidView(s);
}

/* x += t u */
static inline void SyntheticMove(SyntheticSolid *s, double t)
{
  for (int i = 0; i < s->nnodes; i++)
    for (int c = 0; c < 2; c++) s->x[i][c] += t * s->u[i][c];
}

/* Rank `rank` of `size`'s part: simplices dealt like cards, nodes that they use; the last of three or more
 * ranks gets nothing. */
static inline void SyntheticSolidPart(const SyntheticSolid *all, int rank, int size, SyntheticSolid *part)
{
  static int local[SYNTHETIC_MAX];
  const int deal = size > 2 ? size - 1 : size;
  memset(part, 0, sizeof *part);
  for (int i = 0; i < all->nnodes; i++) local[i] = -1;
#define SYNTHETIC_LOCAL(node)                                                                                \
  (local[node] >= 0 ? local[node]                                                                            \
                    : (part->gid[part->nnodes] = all->gid[node],                                             \
                       memcpy(part->x[part->nnodes], all->x[node], sizeof part->x[0]),                       \
                       memcpy(part->u[part->nnodes], all->u[node], sizeof part->u[0]),                       \
                       memcpy(part->acceleration[part->nnodes], all->acceleration[node], sizeof part->u[0]), \
                       part->mobility[part->nnodes] = all->mobility[node], local[node] = part->nnodes++))
  for (int t = 0; t < all->nelements; t++) {
    if (t % deal != rank) continue;
    for (int i = 0; i < 3; i++) part->element[part->nelements][i] = SYNTHETIC_LOCAL(all->element[t][i]);
    part->nelements++;
  }
  for (int e = 0; e < all->nfacets; e++) {
    if ((e / 2 + 1) % deal != rank) continue;
    for (int i = 0; i < 2; i++) part->facet[part->nfacets][i] = SYNTHETIC_LOCAL(all->facet[e][i]);
    part->nfacets++;
  }
#undef SYNTHETIC_LOCAL
  SyntheticSolidView(part);
}

static inline void SyntheticFluidView(SyntheticFluid *f)
{
  f->view = (FluidElements){f->n, &f->x[0][0][0], f->rho, f->mu, NULL, NULL, {0.0, 0.0}, {1.0, 1.0}};
  f->flow = (CoracleFlow){&f->u_start[0][0][0],
                          &f->u_star[0][0][0],
                          &f->u_projected[0][0][0],
                          &f->p[0][0],
                          f->rho,
                          f->mu,
                          NULL,
                          NULL,
                          NULL};
}

/* n x n cells, density and viscosity 1, everything else 0. */
static inline void SyntheticFluidMake(SyntheticFluid *f, int n, unsigned seed)
{
  double(*x)[3][2] = RandomMesh(n, seed);
  memset(f, 0, sizeof *f);
  f->n = 2 * n * n;
  for (int k = 0; k < f->n; k++) {
    memcpy(f->x[k], x[k], sizeof f->x[k]);
    f->rho[k] = f->mu[k] = 1.0;
    f->global[k] = k;
  }
  free(x);
  SyntheticFluidView(f);
}

/* Strips in x; the last of three or more ranks gets nothing. */
static inline void SyntheticFluidPart(const SyntheticFluid *all, int rank, int size, SyntheticFluid *part)
{
  const int deal = size > 2 ? size - 1 : size;
  memset(part, 0, sizeof *part);
  for (int k = 0; k < all->n; k++) {
    const double centre = (all->x[k][0][0] + all->x[k][1][0] + all->x[k][2][0]) / 3.0;
    if ((int)(deal * centre) != rank) continue;
    const int j = part->n++;
    part->global[j] = k;
    part->rho[j] = all->rho[k];
    part->mu[j] = all->mu[k];
    memcpy(part->x[j], all->x[k], sizeof part->x[j]);
    memcpy(part->u_start[j], all->u_start[k], sizeof part->u_start[j]);
    memcpy(part->u_star[j], all->u_star[k], sizeof part->u_star[j]);
    memcpy(part->u_projected[j], all->u_projected[k], sizeof part->u_projected[j]);
    memcpy(part->p[j], all->p[k], sizeof part->p[j]);
  }
  SyntheticFluidView(part);
}

/* P2 nodes: vertices, then the midpoints opposite to them. */
static inline void SyntheticP2Node(const double x[3][2], int i, double at[2])
{
  for (int c = 0; c < 2; c++) at[c] = i < 3 ? x[i][c] : 0.5 * (x[(i + 1) % 3][c] + x[(i + 2) % 3][c]);
}

static inline double SyntheticArea(const SyntheticSolid *s)
{
  double area = 0.0;
  for (int t = 0; t < s->nelements; t++) {
    const int *e = s->element[t];
    area += 0.5 * GeometryTurn(s->x[e[0]], s->x[e[1]], s->x[e[2]]);
  }
  return area;
}
#endif
