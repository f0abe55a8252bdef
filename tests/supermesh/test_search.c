/* The search finds exactly what comparing all with all finds, for boxes whose sizes differ by a factor of
 * 1000. */
#include "common/supermesh/search.h"
#include "tests/supermesh/random_mesh.h"

enum { N = 3000 };

static GeometryBox RandomBox(void)
{
  GeometryBox box;
  const double size = pow(10.0, Random(-4.0, -1.0));
  for (int c = 0; c < 2; c++) {
    box.lower[c] = Random(-1.0, 1.0);
    box.upper[c] = box.lower[c] + size;
  }
  return box;
}

static void CheckQuery(Search search, int n, const GeometryBox set[], GeometryBox query)
{
  static int seen[N];
  const int *hit, nhit = SearchQuery(search, &query, &hit);
  memset(seen, 0, sizeof seen);
  for (int i = 0; i < nhit; i++) seen[hit[i]]++;
  for (int i = 0; i < n; i++) {
    CHECK(seen[i] == GeometryBoxOverlap(&set[i], &query), "box %d found %d times", i, seen[i]);
  }
}

/* Every box is in one of the cover's, and there are several unless the set is tiny. */
static void CheckCover(Search search, int n, const GeometryBox set[])
{
  GeometryBox cover[16];
  const int ncover = SearchCover(search, 16, cover);
  CHECK(ncover <= 16 && (n > 0) == (ncover > 0) && (n < N || ncover > 8), "%d boxes cover %d", ncover, n);
  for (int i = 0; i < n; i++) {
    int inside = 0;
    for (int k = 0; k < ncover; k++) {
      inside += cover[k].lower[0] <= set[i].lower[0] && set[i].upper[0] <= cover[k].upper[0] &&
                cover[k].lower[1] <= set[i].lower[1] && set[i].upper[1] <= cover[k].upper[1];
    }
    CHECK(inside > 0, "box %d is not covered", i);
  }
}

int main(void)
{
  static GeometryBox set[N];
  const int counts[] = {0, 1, 4, 5, 17, N};
  srand(2);
  for (int i = 0; i < N; i++) set[i] = RandomBox();
  for (int k = 0; k < 6; k++) {
    Search search;
    CHECK(SearchCreate(counts[k], set, &search) == 0, "no memory");
    for (int q = 0; q < 500; q++) CheckQuery(search, counts[k], set, q < counts[k] ? set[q] : RandomBox());
    CheckCover(search, counts[k], set);
    SearchDestroy(&search);
    CHECK(search == NULL, "the handle is nulled");
  }
  return 0;
}
