/* Gmsh files: the same mesh from text and binary of both formats; damaged ones are refused with the reason.
 */
#include "tests/mesh/strip.h"
#include <unistd.h>

static char path[64];

static void Write(const void *bytes, size_t n)
{
  FILE *stream = fopen(path, "wb");
  CHECK(stream && fwrite(bytes, 1, n, stream) == n && !fclose(stream), "%s cannot be written", path);
}

static int Place(int n, char (*name)[64], const char *wanted)
{
  for (int k = 0; k < n; k++) {
    if (!strcmp(name[k], wanted)) return k;
  }
  CHECK(0, "the name '%s' is missing", wanted);
  return -1;
}

/* The unit square with a hole of 0.2 x 0.2 in the middle, from data/square_hole.geo. */
static void CheckSquare(const char *name)
{
  MeshSerial m;
  const char *error;
  char file[512];
  double area[2] = {0.0, 0.0}, length[8] = {0.0};
  snprintf(file, sizeof file, "%s/data/%s", SOURCE_FOLDER, name);
  CHECK(!MeshReadGmsh(file, &m, &error), "%s", error);
  CHECK(m.nv == 20 && m.ne == 28 && m.nregions == 2 && m.ntags == 4,
        "%s: %d vertices, %d triangles, %d regions, %d names", name, m.nv, m.ne, m.nregions, m.ntags);
  for (int e = 0; e < m.ne; e++) {
    CHECK(TriangleArea(m.x, &m.vertex[3 * e]) > 0.0, "%s: triangle %d is clockwise", name, e);
    area[m.region[e]] += TriangleArea(m.x, &m.vertex[3 * e]);
  }
  for (int k = 0; k < m.nb; k++) {
    const double *a = &m.x[2 * m.facet[2 * k]], *b = &m.x[2 * m.facet[2 * k + 1]];
    length[m.facet_tag[k]] += hypot(a[0] - b[0], a[1] - b[1]);
  }
  for (int k = 0; k < 2; k++)
    CHECK(fabs(area[k] - 0.48) < 1e-12, "%s: region %d has area %g", name, k, area[k]);
  Place(2, m.region_name, "right part");
  Place(2, m.region_name, "left part");
  const char *const tag[4] = {"bottom", "top and left", "hole", "boundary"};
  const double wanted[4] = {1.0, 2.0, 0.8, 1.0};
  for (int k = 0; k < 4; k++) {
    const double found = length[Place(4, m.tag_name, tag[k])];
    CHECK(fabs(found - wanted[k]) < 1e-12, "%s: '%s' is %g long, not %g", name, tag[k], found, wanted[k]);
  }
  CHECK(!MeshSerialDestroy(&m) && !m.x && !m.ne, "destroyed");
}

#define HEAD "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
#define SQUARE "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n40 0 1 0\n5 0.5 0.5 0\n$EndNodes\n"
#define ELEMENTS(n, list) "$Elements\n" n "\n" list "$EndElements\n"
#define TAIL ELEMENTS("2", "11 2 2 0 1 1 2 3\n12 2 2 0 1 1 3 40\n")

/* Clockwise triangles are turned; nodes of no triangle go; numbers may have gaps; a curve between triangles is kept apart from the boundary. */
static void CheckTurned(void)
{
  static const char text[] =
      HEAD SQUARE ELEMENTS("4", "10 1 2 9 1 1 40\n11 2 2 0 1 1 3 2\n12 2 2 0 1 1 3 40\n13 1 2 7 1 1 3\n");
  MeshSerial m;
  const char *error;
  Write(text, sizeof text - 1);
  CHECK(!MeshReadGmsh(path, &m, &error), "%s", error);
  CHECK(m.ne == 2 && m.nv == 4 && m.nb == 4 && m.ntags == 2 && !m.region, "%d triangles, %d vertices", m.ne,
        m.nv);
  for (int e = 0; e < 2; e++)
    CHECK(fabs(TriangleArea(m.x, &m.vertex[3 * e]) - 0.5) < 1e-15, "triangle %d", e);
  Place(2, m.tag_name, "9"); /* a physical curve without a name goes by its number */
  CHECK(m.ncurves == 1 && m.curve && !strcmp(m.curve_name[0], "7"), "%d curves inside", m.ncurves);
  for (int k = 0; k < 6; k++) {
    const int a = m.vertex[k], b = m.vertex[k - k % 3 + (k + 1) % 3],
              diagonal = (a == 0 && b == 2) || (a == 2 && b == 0);
    CHECK(m.curve[k] == (diagonal ? 0 : -1), "side %d of triangle %d: curve %d", k % 3, k / 3, m.curve[k]);
  }
  CHECK(!MeshSerialDestroy(&m), "destroyed");
}

#define NINE                                                                                                 \
  "$Nodes\n9\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0.5 0 0\n6 1 0.5 0\n7 0.5 1 0\n8 0 0.5 0\n9 0.5 0.5 0\n" \
  "$EndNodes\n"

/* Triangles of second order, one of them clockwise, become four each; so do lines, two each. */
static void CheckSecondOrder(void)
{
  static const char text[] =
      HEAD NINE ELEMENTS("3", "10 8 2 5 1 1 2 5\n11 9 2 0 1 1 2 3 5 6 9\n12 9 2 0 1 1 4 3 8 7 9\n");
  MeshSerial m;
  const char *error;
  int named = 0;
  Write(text, sizeof text - 1);
  CHECK(!MeshReadGmsh(path, &m, &error), "%s", error);
  CHECK(m.order == 2 && m.ne == 8 && m.nv == 9 && m.nb == 8, "order %d, %d triangles, %d vertices, %d edges",
        m.order, m.ne, m.nv, m.nb);
  for (int e = 0; e < 8; e++) {
    const int *corner = m.vertex + 12 * (e / 4) + 3 * (e % 4), *middle = m.vertex + 12 * (e / 4) + 9;
    CHECK(fabs(TriangleArea(m.x, corner) - 0.125) < 1e-15, "part %d", e);
    CHECK(e % 4 == 3 || (corner[1] == middle[e % 4] && corner[2] == middle[(e % 4 + 2) % 3]), "part %d", e);
  }
  for (int k = 0; k < m.nb; k++) named += m.facet_tag[k] == Place(m.ntags, m.tag_name, "5");
  CHECK(named == 2, "%d edges are named", named);
  CHECK(!MeshSerialDestroy(&m), "destroyed");
}

static void CheckRefused(const char *text, const char *wanted)
{
  MeshSerial m;
  const char *error = NULL;
  Write(text, strlen(text));
  CHECK(MeshReadGmsh(path, &m, &error), "accepted, but it should say '%s'", wanted);
  CHECK(error && strstr(error, wanted) && strstr(error, path), "'%s' does not say '%s'", error, wanted);
  CHECK(!m.x && !m.vertex && !m.facet, "a refused mesh is not empty");
}

static void CheckDamaged(void)
{
  CheckRefused(HEAD SQUARE ELEMENTS("2", "11 2 2 0 1 1 2 3\n12 2 2 0 1 1 3 4\n"),
               "triangle 12 has vertex 4, which does not exist");
  CheckRefused(HEAD SQUARE ELEMENTS("2", "11 2 2 0 1 1 2 3\n12 2 2 0 1 1 5 3\n"),
               "triangle 12 (vertices 1 5 3) is degenerate");
  CheckRefused(HEAD SQUARE ELEMENTS("2", "11 2 2 0 1 1 2 3\n12 2 2 0 1 1 1 40\n"),
               "triangle 12 (vertices 1 1 40) is degenerate");
  CheckRefused(HEAD SQUARE ELEMENTS("2", "11 2 2 0 1 1 2 3\n12 2 2 0 1 3 2 1\n"),
               "triangle 12 repeats or overlaps triangle 11");
  CheckRefused(HEAD SQUARE ELEMENTS("2", "11 2 2 0 1 1 2 3\n12 2 2 0 1 1 2 40\n"),
               "triangle 12 repeats or overlaps triangle 11");
  CheckRefused(HEAD SQUARE ELEMENTS("1", "7 3 2 0 1 1 2 3 40\n"), "element 7 is a quadrangle");
  CheckRefused(HEAD SQUARE ELEMENTS("2", "7 2 2 0 1 1 2 5\n8 9 2 0 1 1 2 3 40 5 1\n"),
               "triangle 8 is of order 2, those before it of order 1");
  CheckRefused(HEAD NINE ELEMENTS("1", "7 9 2 0 1 1 2 3 5 4 9\n"), "triangle 7 is folded");
  CheckRefused(HEAD SQUARE ELEMENTS("1", "7 1 2 0 1 1 2\n"), "no triangles");
  CheckRefused(HEAD SQUARE ELEMENTS("2", "7 1 2 0 1 1 9\n11 2 2 0 1 1 2 3\n"),
               "line 7 has vertex 9, which does not exist");
  CheckRefused(HEAD SQUARE "$Elements\n2\n11 2 2 0 1 1 2 3\n", "the file ends too early");
  CheckRefused(HEAD SQUARE "$Elements\n2\n11 2 2 0 1 1 2 3\n$EndElements\n", "line 15: a number is expected");
  CheckRefused(HEAD SQUARE "$Elements\n99999999\n", "the file ends earlier");
  CheckRefused(HEAD "$Nodes\n1\n1 0 0 0\n", "$EndNodes is missing");
  CheckRefused(HEAD "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n" TAIL, "node 1 comes twice");
  CheckRefused(HEAD "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 1 1 0.1\n$EndNodes\n" TAIL, "node 3 has z = 0.1");
  CheckRefused(HEAD "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 1 nan 0\n$EndNodes\n" TAIL,
               "node 3: its position is no number");
  CheckRefused("$MeshFormat\n4 0 8\n$EndMeshFormat\n", "format 4: 2.2 and 4.1 are understood");
  CheckRefused("solid cube\n", "no Gmsh file");
  CheckRefused("", "no Gmsh file");
  CheckRefused(SQUARE, "$Nodes comes before $MeshFormat");
}

static void CheckMissingFile(void)
{
  MeshSerial m;
  const char *error;
  CHECK(MeshReadGmsh("/nowhere/a.msh", &m, &error), "a file that is not there");
  CHECK(!strcmp(error, "/nowhere/a.msh: cannot be opened"), "%s", error);
}

/* Cut short or with a byte changed, a file is read or refused, but never read beyond its end (seen by the
 * sanitizers). */
static void CheckTorn(const char *name)
{
  static unsigned char bytes[8192], torn[8192];
  char file[512];
  unsigned seed = 1;
  snprintf(file, sizeof file, "%s/data/%s", SOURCE_FOLDER, name);
  FILE *stream = fopen(file, "rb");
  CHECK(stream, "%s", file);
  const size_t n = fread(bytes, 1, sizeof bytes, stream);
  fclose(stream);
  for (int trial = 0; trial < 1500; trial++) {
    MeshSerial m;
    const char *error;
    memcpy(torn, bytes, n);
    seed = seed * 1664525u + 1013904223u;
    const size_t at = (seed >> 8) % n;
    if (trial % 2) torn[at] = (unsigned char)(seed >> 3);
    Write(torn, trial % 2 ? n : at);
    if (!MeshReadGmsh(path, &m, &error)) CHECK(!MeshSerialDestroy(&m), "destroyed");
  }
}

int main(int argc, char **argv)
{
  static const char *const data[] = {"square_hole_22.msh", "square_hole_22_binary.msh", "square_hole_41.msh",
                                     "square_hole_41_binary.msh"};
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  snprintf(path, sizeof path, "/tmp/coracle_gmsh_%d.msh", (int)getpid());
  for (int k = 0; k < 4; k++) CheckSquare(data[k]);
  CheckTurned();
  CheckSecondOrder();
  CheckDamaged();
  CheckMissingFile();
  for (int k = 0; k < 4; k++) CheckTorn(data[k]);
  remove(path);
  return PetscFinalize();
}
