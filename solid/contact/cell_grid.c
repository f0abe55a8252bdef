#include "solid/contact/cell_grid.h"

enum { MOST_CELLS = 64 }; /* that a box is entered in; at least 9: boxes up to the mean touch no more */

typedef struct {
  int cell[2], box;
} Entry;

typedef struct {
  int n, *box; /* [n] of the set, which are in this grid */
  GeometryBox bounds;
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

static double CellCount(const Grid *g, const GeometryBox *box)
{
  int first[2], last[2];
  Cells(g, box, first, last);
  return (last[0] - first[0] + 1.0) * (last[1] - first[1] + 1.0);
}

/* Cells as large as the mean box, but at most 2^30 of them along each axis. */
static void Measure(Grid *g, const GeometryBox a[])
{
  double extent = 0.0, all = 0.0;
  g->bounds = GeometryBoxEmpty();
  for (int k = 0; k < g->n; k++) {
    const GeometryBox *box = &a[g->box[k]];
    extent += 0.5 * (box->upper[0] - box->lower[0] + box->upper[1] - box->lower[1]);
    GeometryBoxJoin(&g->bounds, box);
  }
  for (int c = 0; c < 2; c++) {
    g->origin[c] = g->bounds.lower[c];
    all = fmax(all, g->bounds.upper[c] - g->bounds.lower[c]);
  }
  g->size = fmax(extent / g->n, 1e-9 * all);
  if (!(g->size > 0.0)) g->size = 1.0;
}

/* Those that touch too many cells go to large[], for the next grid; returns their number. */
static int PutAside(Grid *g, const GeometryBox a[], int large[])
{
  int kept = 0, nlarge = 0;
  g->bounds = GeometryBoxEmpty();
  for (int k = 0; k < g->n; k++) {
    const int i = g->box[k];
    if (CellCount(g, &a[i]) > MOST_CELLS) {
      large[nlarge++] = i;
      continue;
    }
    GeometryBoxJoin(&g->bounds, &a[i]);
    g->box[kept++] = i;
  }
  g->n = kept;
  return nlarge;
}

/* Counting sort of the entries by bucket: start[] is first counted, then filled from behind. */
static PetscErrorCode Fill(Grid *g, const GeometryBox a[])
{
  int first[2], last[2];
  PetscFunctionBeginUser;
  for (g->mask = 16; (int)g->mask < 2 * g->n; g->mask *= 2) {
  }
  PetscCall(PetscCalloc1(g->mask + 1, &g->start));
  g->mask--;
  for (int pass = 0; pass < 2; pass++) {
    for (int i = g->n - 1; i >= 0; i--) {
      Cells(g, &a[g->box[i]], first, last);
      for (int iy = first[1]; iy <= last[1]; iy++)
        for (int ix = first[0]; ix <= last[0]; ix++) {
          const unsigned k = Bucket(g, ix, iy);
          if (pass == 0)
            g->start[k]++;
          else
            g->entry[--g->start[k]] = (Entry){{ix, iy}, g->box[i]};
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
  if (CellCount(g, box) > g->n) { /* then it is shorter to look at all boxes */
    for (int k = 0; k < g->n; k++)
      if (GeometryBoxOverlap(&a[g->box[k]], box)) PetscCall(found(context, g->box[k], b));
    PetscFunctionReturn(0);
  }
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

static PetscErrorCode QueryAll(const Grid *g, const GeometryBox a[], int nb, const GeometryBox b[],
                               CellGridFunction found, void *context)
{
  PetscFunctionBeginUser;
  for (int j = 0; j < nb; j++) {
    if (!GeometryBoxOverlap(&b[j], &g->bounds)) continue;
    GeometryBox part = b[j];
    for (int c = 0; c < 2; c++) {
      part.lower[c] = fmax(part.lower[c], g->bounds.lower[c]);
      part.upper[c] = fmin(part.upper[c], g->bounds.upper[c]);
    }
    PetscCall(Query(g, a, &part, j, found, context));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode CellGridPairs(int na, const GeometryBox a[], int nb, const GeometryBox b[],
                             CellGridFunction found, void *context)
{
  int *box, *large;
  PetscFunctionBeginUser;
  if (na == 0 || nb == 0) PetscFunctionReturn(0);
  PetscCall(PetscMalloc2((size_t)na, &box, (size_t)na, &large));
  for (int i = 0; i < na; i++) box[i] = i;
  for (int n = na; n > 0;) {
    Grid g = {.n = n, .box = box};
    Measure(&g, a);
    n = PutAside(&g, a, large);
    PetscCall(Fill(&g, a));
    PetscCall(QueryAll(&g, a, nb, b, found, context));
    PetscCall(PetscFree(g.start));
    PetscCall(PetscFree(g.entry));
    PetscCall(PetscArraycpy(box, large, (size_t)n));
  }
  PetscCall(PetscFree2(box, large));
  PetscFunctionReturn(0);
}
