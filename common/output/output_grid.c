/* The grids of a snapshot, and the fields on them. */
#include "common/output/output_impl.h"
#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/* Names become parts of paths and XML. */
PetscBool OutputCanName(const char *name)
{
  for (const char *c = name; *c; c++)
    if (!isalnum((unsigned char)*c) && !strchr("_- ", *c)) return PETSC_FALSE;
  return (PetscBool)(*name && strlen(name) < 64);
}

static PetscErrorCode CheckName(const Output o, const char *name)
{
  PetscFunctionBeginUser;
  PetscCheck(OutputCanName(name), o->comm, PETSC_ERR_ARG_WRONG,
             "name '%s': 1 to 63 letters, digits, '_', '-' and blanks are allowed", name);
  PetscFunctionReturn(0);
}

static PetscErrorCode FindGrid(Output o, const char *name, Grid **grid)
{
  PetscFunctionBeginUser;
  for (o->current = 0; o->current < o->ngrid; o->current++) {
    if (!strcmp(o->grid[o->current].name, name)) break;
  }
  *grid = &o->grid[o->current];
  if (o->current < o->ngrid) PetscFunctionReturn(0);
  PetscCheck(o->ngrid < GRIDS_MAX, o->comm, PETSC_ERR_ARG_OUTOFRANGE, "more than %d grids in a file",
             GRIDS_MAX);
  o->ngrid++;
  **grid = (Grid){.snapshot = -1};
  strcpy((*grid)->name, name);
  PetscFunctionReturn(0);
}

static PetscErrorCode WriteCells(Output o, const char *path, const Grid *g, const int connectivity[])
{
  const size_t count = (size_t)g->cell.n * (size_t)g->nodes_per_cell;
  Hdf5Rows rows = g->cell;
  long long *global;
  PetscFunctionBeginUser;
  rows.ncol = g->nodes_per_cell;
  PetscCall(PetscMalloc1(count, &global));
  for (size_t k = 0; k < count; k++) global[k] = g->node.start + connectivity[k];
  PetscCall(Hdf5WriteIndices(o->file, path, &rows, g->node.total, global));
  PetscCall(PetscFree(global));
  PetscFunctionReturn(0);
}

/* What a snapshot has of a grid: "" itself, "/points", "/cells", "/node", "/cell". */
static void PathOf(long long snapshot, const Grid *g, const char *what, char path[PATH])
{
  snprintf(path, PATH, "/snapshot/%06lld/%s%s", snapshot, g->name, what);
}

/* Points and cells are those of an earlier snapshot. */
static PetscErrorCode LinkShape(Output o, const Grid *g, const char *points, const char *cells)
{
  char earlier[PATH];
  PetscFunctionBeginUser;
  PathOf(g->snapshot, g, "/points", earlier);
  PetscCall(Hdf5Link(o->file, earlier, points));
  PathOf(g->snapshot, g, "/cells", earlier);
  PetscCall(Hdf5Link(o->file, earlier, cells));
  PetscFunctionReturn(0);
}

/* The groups of a grid, its points and its cells. */
static PetscErrorCode WriteShape(Output o, Grid *g, PetscBool known, const double x[],
                                 const int connectivity[])
{
  static const char *const GROUP[3] = {"", "/node", "/cell"};
  char path[PATH], points[PATH], cells[PATH];
  Hdf5Rows rows = g->node;
  PetscFunctionBeginUser;
  for (int k = 0; k < 3; k++) {
    PathOf(o->nsnapshot, g, GROUP[k], path);
    PetscCall(Hdf5Group(o->file, path));
  }
  PathOf(o->nsnapshot, g, "/points", points);
  PathOf(o->nsnapshot, g, "/cells", cells);
  if (known) {
    PetscCall(LinkShape(o, g, points, cells));
  } else {
    rows.ncol = 2;
    g->snapshot = o->nsnapshot;
    PetscCall(Hdf5WriteDoubles(o->file, points, &rows, x));
    PetscCall(WriteCells(o, cells, g, connectivity));
  }
  if (o->rank == 0 && g->cell.total) { /* readers of XDMF stumble over grids without cells */
    PetscCall(XdmfGrid(o->xdmf, g->name, points, g->node.total, cells, g->cell.total, g->nodes_per_cell,
                       Hdf5IndexBytes(g->node.total)));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode OutputGrid(Output o, const char *name, int revision, int n, const double x[], int ne,
                          int nodes_per_cell, const int connectivity[])
{
  Grid *g;
  Hdf5Rows node, cell;
  PetscFunctionBeginUser;
  PetscCheck(o->open, o->comm, PETSC_ERR_ORDER, "OutputGrid '%s' comes before OutputBegin", name);
  PetscCheck(nodes_per_cell == 1 || nodes_per_cell == 2 || nodes_per_cell == 3 || nodes_per_cell == 6,
             o->comm, PETSC_ERR_ARG_OUTOFRANGE, "grid '%s' has %d nodes a cell: 1, 2, 3 and 6 are known",
             name, nodes_per_cell);
  PetscCall(CheckName(o, name));
  PetscCall(FindGrid(o, name, &g));
  PetscCall(Hdf5Place(o->comm, n, 1, &node));
  PetscCall(Hdf5Place(o->comm, ne, 1, &cell));
  node.store = cell.store = HDF5_COMPRESSED;
  const PetscBool known = g->snapshot >= 0 && g->revision == revision ? PETSC_TRUE : PETSC_FALSE;
  PetscCheck(!known || (node.total == g->node.total && cell.total == g->cell.total &&
                        nodes_per_cell == g->nodes_per_cell),
             o->comm, PETSC_ERR_ARG_WRONG,
             "grid '%s' has %lld nodes and %lld cells, in its revision %d it had %lld and %lld: give it a "
             "new revision",
             name, node.total, cell.total, revision, g->node.total, g->cell.total);
  g->revision = revision;
  g->nodes_per_cell = nodes_per_cell;
  g->node = node;
  g->cell = cell;
  PetscCall(WriteShape(o, g, known, x, connectivity));
  PetscFunctionReturn(0);
}

/* Columns in the file: a vector gets a third component 0, a tensor (xx, yy, xy) becomes (xx, xy, xz, yy, yz,
 * zz). */
static void Widen(long long n, int ncomp, const double value[], double wide[])
{
  for (long long k = 0; k < n; k++) {
    const double *v = &value[k * ncomp];
    if (ncomp == 1) {
      wide[k] = v[0];
    } else if (ncomp == 2) {
      memcpy(&wide[3 * k], (double[3]){v[0], v[1], 0.0}, 3 * sizeof(double));
    } else {
      memcpy(&wide[6 * k], (double[6]){v[0], v[2], 0.0, v[1], 0.0, 0.0}, 6 * sizeof(double));
    }
  }
}

/* To 31 significant bits, 2.3e-10: the rest is round-off of the solvers, and does not compress. */
static double Rounded(double value)
{
  const uint64_t half = 1ULL << 21, mask = ~(2 * half - 1);
  uint64_t bits;
  if (!isfinite(value)) return value;
  memcpy(&bits, &value, sizeof bits);
  bits = (bits + half) & mask;
  memcpy(&value, &bits, sizeof bits);
  return value;
}

/* A field of one name has one unit in all files. */
static PetscErrorCode WriteUnit(Output o, const char *path, const char *field)
{
  static const char *const UNITS[][2] = {{"velocity", "m/s"},
                                         {"pressure", "Pa"},
                                         {"displacement", "m"},
                                         {"stress", "Pa"},
                                         {"principal_stress_1", "Pa"},
                                         {"principal_stress_2", "Pa"},
                                         {"strain_energy", "J/m3"},
                                         {"angular_velocity", "rad/s"},
                                         {"angle", "rad"},
                                         {"force", "N/m"},
                                         {"moment", "N"},
                                         {"contact", "N/m"},
                                         {"normal_force", "N/m"},
                                         {"friction_force", "N/m"},
                                         {"reaction", "N/m"},
                                         {"mass", "kg/m"},
                                         {"kinetic", "J/m"},
                                         {"strain", "J/m"}};
  PetscFunctionBeginUser;
  for (size_t k = 0; k < sizeof UNITS / sizeof *UNITS; k++)
    if (!strcmp(field, UNITS[k][0])) PetscCall(Hdf5Text(o->file, path, "unit", UNITS[k][1]));
  PetscFunctionReturn(0);
}

PetscErrorCode OutputField(Output o, const char *field, OutputCentre centre, int ncomp, const double value[])
{
  static const int COLUMNS[4] = {0, 1, 3, 6};
  char path[PATH];
  double *wide = NULL;
  PetscFunctionBeginUser;
  PetscCheck(o->open && o->current >= 0, o->comm, PETSC_ERR_ORDER, "OutputField '%s' comes before OutputGrid",
             field);
  PetscCheck(ncomp >= 1 && ncomp <= 3, o->comm, PETSC_ERR_ARG_OUTOFRANGE,
             "field '%s' has %d components: 1, 2 and 3 are known", field, ncomp);
  PetscCall(CheckName(o, field));
  const Grid *g = &o->grid[o->current];
  Hdf5Rows rows = centre == OUTPUT_NODE ? g->node : g->cell;
  rows.ncol = COLUMNS[ncomp];
  snprintf(path, sizeof path, "/snapshot/%06lld/%s/%s/%s", o->nsnapshot, g->name,
           centre == OUTPUT_NODE ? "node" : "cell", field);
  PetscCall(PetscMalloc1((size_t)rows.n * (size_t)rows.ncol, &wide));
  Widen(rows.n, ncomp, value, wide);
  for (long long k = 0; k < rows.n * rows.ncol; k++) wide[k] = Rounded(wide[k]);
  PetscCall(Hdf5WriteDoubles(o->file, path, &rows, wide));
  PetscCall(WriteUnit(o, path, field));
  PetscCall(PetscFree(wide));
  if (o->rank == 0 && g->cell.total) {
    PetscCall(
        XdmfAttribute(o->xdmf, field, centre == OUTPUT_NODE ? "Node" : "Cell", path, rows.total, rows.ncol));
  }
  PetscFunctionReturn(0);
}
