#include "solid/contact/cell_grid.h"

typedef struct {
  int cell[2], box;
} Entry;

typedef struct {
  double origin[2], size;
  unsigned mask; /* buckets - 1 */
  int *start;    /* [buckets + 1] */
  Entry *entry;  /* [start[buckets]] by bucket */
} Grid;

static unsigned Bucket(const Grid *g, int ix, int iy)
{
  return ((unsigned)ix * 73856093u ^ (unsigned)iy * 19349663u) & g->mask;
}

static int Cell(const Grid *g, int c, double x)
{
  return (int)floor((x - g->origin[c]) / g->size);
}

static void Cells(const Grid *g, const GeometryBox *box, int first[2], int last[2])
{
  for (int c = 0; c < 2; c++) {
    first[c] = Cell(g, c, box->lower[c]);
    last[c] = Cell(g, c, box->upper[c]);
  }
}

/* Cells as large as the mean box, but at most 2^30 of them along each axis. */
static void Measure(Grid *g, int n, const GeometryBox a[])
{
  double extent = 0.0, all = 0.0;
  GeometryBox bounds = GeometryBoxEmpty();
  for (int i = 0; i < n; i++) {
    extent += 0.5 * (a[i].upper[0] - a[i].lower[0] + a[i].upper[1] - a[i].lower[1]);
    GeometryBoxJoin(&bounds, &a[i]);
  }
  for (int c = 0; c < 2; c++) {
    g->origin[c] = bounds.lower[c];
    all = fmax(all, bounds.upper[c] - bounds.lower[c]);
  }
  g->size = fmax(extent / n, 1e-9 * all);
  if (!(g->size > 0.0)) g->size = 1.0;
}

/* Counting sort of the entries by bucket: start[] is first counted, then filled from behind. */
static PetscErrorCode Fill(Grid *g, int n, const GeometryBox a[])
{
  int first[2], last[2];
  PetscFunctionBeginUser;
  for (g->mask = 16; (int)g->mask < 2 * n; g->mask *= 2) {
  }
  PetscCall(PetscCalloc1(g->mask + 1, &g->start));
  g->mask--;
  for (int pass = 0; pass < 2; pass++) {
    for (int i = n - 1; i >= 0; i--) {
      Cells(g, &a[i], first, last);
      for (int iy = first[1]; iy <= last[1]; iy++)
        for (int ix = first[0]; ix <= last[0]; ix++) {
          const unsigned k = Bucket(g, ix, iy);
          if (pass == 0)
            g->start[k]++;
          else
            g->entry[--g->start[k]] = (Entry){{ix, iy}, i};
        }
    }
    if (pass) break;
    for (unsigned k = 0; k <= g->mask; k++) g->start[k + 1] += g->start[k];
    PetscCall(PetscMalloc1((size_t)g->start[g->mask + 1] + 1, &g->entry));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Query(const Grid *g, const GeometryBox a[], const GeometryBox *box, int b,
                            CellGridFunction found, void *context)
{
  int first[2], last[2];
  PetscFunctionBeginUser;
  Cells(g, box, first, last);
  for (int iy = first[1]; iy <= last[1]; iy++)
    for (int ix = first[0]; ix <= last[0]; ix++) {
      const unsigned k = Bucket(g, ix, iy);
      for (int e = g->start[k]; e < g->start[k + 1]; e++) {
        const Entry *entry = &g->entry[e];
        const GeometryBox *other = &a[entry->box];
        if (entry->cell[0] != ix || entry->cell[1] != iy || !GeometryBoxOverlap(other, box)) continue;
        if (Cell(g, 0, fmax(other->lower[0], box->lower[0])) != ix ||
            Cell(g, 1, fmax(other->lower[1], box->lower[1])) != iy)
          continue;
        PetscCall(found(context, entry->box, b));
      }
    }
  PetscFunctionReturn(0);
}

PetscErrorCode CellGridPairs(int na, const GeometryBox a[], int nb, const GeometryBox b[],
                             CellGridFunction found, void *context)
{
  Grid g = {0};
  GeometryBox bounds = GeometryBoxEmpty();
  PetscFunctionBeginUser;
  if (na == 0 || nb == 0) PetscFunctionReturn(0);
  Measure(&g, na, a);
  PetscCall(Fill(&g, na, a));
  for (int i = 0; i < na; i++) GeometryBoxJoin(&bounds, &a[i]);
  for (int j = 0; j < nb; j++) {
    if (!GeometryBoxOverlap(&b[j], &bounds)) continue;
    GeometryBox part = b[j];
    for (int c = 0; c < 2; c++) {
      part.lower[c] = fmax(part.lower[c], bounds.lower[c]);
      part.upper[c] = fmin(part.upper[c], bounds.upper[c]);
    }
    PetscCall(Query(&g, a, &part, j, found, context));
  }
  PetscCall(PetscFree(g.start));
  PetscCall(PetscFree(g.entry));
  PetscFunctionReturn(0);
}
