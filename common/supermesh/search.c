#include "common/supermesh/search.h"
#include <stdint.h>
#include <stdlib.h>

enum { WIDTH = 4, STACK = 64, LEVELS = 20 };

/* WIDTH boxes side by side, so that they are compared in one go; a box that is not there is empty.  Behind
 * box k of an inner node stands node child + k, of a leaf the item order[-1 - child + k]. */
typedef struct {
  double lower[2][WIDTH], upper[2][WIDTH];
  int child;
} Node;

/* Leaves first, in the order of the curve, then level by level; the root is last. */
struct Search_s {
  int nlevels, first[LEVELS + 1]; /* nodes of level l: first[l] .. first[l + 1] - 1 */
  int capacity;
  int *order, *hit;
  Node *node;
};

/* 16 bits spread to every other position. */
static uint32_t Spread(uint32_t v)
{
  v = (v | v << 8) & 0x00ff00ffu;
  v = (v | v << 4) & 0x0f0f0f0fu;
  v = (v | v << 2) & 0x33333333u;
  return (v | v << 1) & 0x55555555u;
}

static void MortonKeys(int n, const GeometryBox box[], uint32_t key[])
{
  GeometryBox all = GeometryBoxEmpty();
  double scale[2];
  for (int i = 0; i < n; i++) GeometryBoxJoin(&all, &box[i]);
  for (int c = 0; c < 2; c++) {
    const double extent = all.upper[c] - all.lower[c];
    scale[c] = extent > 0.0 ? 65535.0 / extent : 0.0;
  }
  for (int i = 0; i < n; i++) {
    uint32_t cell[2];
    for (int c = 0; c < 2; c++) {
      cell[c] = (uint32_t)((0.5 * (box[i].lower[c] + box[i].upper[c]) - all.lower[c]) * scale[c]);
    }
    key[i] = Spread(cell[0]) | Spread(cell[1]) << 1;
  }
}

/* Sorts order[] by key[order[]], one byte at a time. */
static void RadixSort(int n, const uint32_t key[], int order[], int other[])
{
  for (int i = 0; i < n; i++) order[i] = i;
  for (int shift = 0; shift < 32; shift += 8) {
    int start[257] = {0};
    for (int i = 0; i < n; i++) start[(key[order[i]] >> shift & 255u) + 1]++;
    for (int b = 0; b < 256; b++) start[b + 1] += start[b];
    for (int i = 0; i < n; i++) other[start[key[order[i]] >> shift & 255u]++] = order[i];
    memcpy(order, other, (size_t)n * sizeof *order);
  }
}

static void SetLane(Node *node, int k, GeometryBox box)
{
  for (int c = 0; c < 2; c++) {
    node->lower[c][k] = box.lower[c];
    node->upper[c][k] = box.upper[c];
  }
}

static GeometryBox Lane(const Node *node, int k)
{
  return (GeometryBox){{node->lower[0][k], node->lower[1][k]}, {node->upper[0][k], node->upper[1][k]}};
}

static int LevelsOf(int n, int first[LEVELS + 1])
{
  int nlevels = 0, nodes = n;
  first[0] = 0;
  do {
    nodes = nodes > WIDTH ? (nodes - 1) / WIDTH + 1 : 1;
    first[nlevels + 1] = first[nlevels] + nodes;
    nlevels++;
  } while (nodes > 1);
  return nlevels;
}

/* What box a lane of level l has: of item i of the sorted set, or around node i of the level below. */
static GeometryBox LaneBox(const Search s, int l, int i, const GeometryBox box[])
{
  if (l == 0) return box[s->order[i]];
  GeometryBox all = GeometryBoxEmpty();
  for (int k = 0; k < WIDTH; k++) {
    const GeometryBox part = Lane(&s->node[s->first[l - 1] + i], k);
    GeometryBoxJoin(&all, &part);
  }
  return all;
}

static void BuildTree(Search s, int n, const GeometryBox box[])
{
  for (int l = 0; l < s->nlevels; l++) {
    const int below = l > 0 ? s->first[l] - s->first[l - 1] : n;
    for (int i = 0; i < s->first[l + 1] - s->first[l]; i++) {
      Node *node = &s->node[s->first[l] + i];
      node->child = l > 0 ? s->first[l - 1] + WIDTH * i : -1 - WIDTH * i;
      for (int k = 0; k < WIDTH; k++) {
        const int item = WIDTH * i + k;
        SetLane(node, k, item < below ? LaneBox(s, l, item, box) : GeometryBoxEmpty());
      }
    }
  }
}

int SearchCreate(int n, const GeometryBox box[], Search *search)
{
  Search s = calloc(1, sizeof *s);
  const size_t count = (size_t)(n > 0 ? n : 0) + WIDTH; /* a leaf that is not full looks beyond */
  if (!s) return 1;
  uint32_t *key = calloc(count, sizeof *key);
  int *other = malloc(count * sizeof *other);
  s->nlevels = LevelsOf(n, s->first);
  s->order = malloc(count * sizeof *s->order);
  s->node = malloc((size_t)s->first[s->nlevels] * sizeof *s->node);
  *search = s;
  const int failed = !key || !other || !s->order || !s->node;
  if (!failed) {
    MortonKeys(n, box, key);
    RadixSort(n, key, s->order, other);
    BuildTree(s, n, box);
  } else {
    SearchDestroy(search);
  }
  free(key);
  free(other);
  return failed;
}

int SearchCreateTriangles(int n, const double x[][3][2], Search *search)
{
  GeometryBox *box = malloc((n > 0 ? (size_t)n : 1) * sizeof *box);
  if (!box) return 1;
  for (int i = 0; i < n; i++) box[i] = GeometryBoxOf(x[i]);
  const int failed = SearchCreate(n, box, search);
  free(box);
  return failed;
}

static int Reserve(Search s, int n)
{
  if (n <= s->capacity) return 0;
  const int capacity = 2 * n + 64;
  int *hit = realloc(s->hit, (size_t)capacity * sizeof *hit);
  if (!hit) return 1;
  s->hit = hit;
  s->capacity = capacity;
  return 0;
}

/* hit[k]: does box k of the node overlap?  Without branches: which do is random to the processor. */
static void OverlapNode(const Node *node, const GeometryBox *box, int hit[WIDTH])
{
  for (int k = 0; k < WIDTH; k++) {
    hit[k] = (node->lower[0][k] <= box->upper[0]) & (box->lower[0] <= node->upper[0][k]) &
             (node->lower[1][k] <= box->upper[1]) & (box->lower[1] <= node->upper[1][k]);
  }
}

int SearchQuery(Search s, const GeometryBox *box, const int **hit)
{
  int stack[STACK], top = 1, n = 0, overlap[WIDTH];
  stack[0] = s->first[s->nlevels] - 1;
  while (top) {
    const Node *node = &s->node[stack[--top]];
    OverlapNode(node, box, overlap);
    if (node->child >= 0) {
      for (int k = WIDTH - 1; k >= 0; k--) {
        stack[top] = node->child + k;
        top += overlap[k];
      }
      continue;
    }
    if (Reserve(s, n + WIDTH)) return -1;
    for (int k = 0; k < WIDTH; k++) {
      s->hit[n] = s->order[-1 - node->child + k];
      n += overlap[k];
    }
  }
  *hit = s->hit;
  return n;
}

int SearchCover(Search s, int max, GeometryBox cover[])
{
  int level = s->nlevels - 1, n = 0;
  while (level > 0 && WIDTH * (s->first[level] - s->first[level - 1]) <= max) level--;
  for (int i = s->first[level]; i < s->first[level + 1]; i++) {
    for (int k = 0; k < WIDTH; k++) {
      const GeometryBox box = Lane(&s->node[i], k);
      if (box.lower[0] <= box.upper[0]) cover[n++] = box;
    }
  }
  return n;
}

void SearchDestroy(Search *search)
{
  Search s = *search;
  if (!s) return;
  free(s->order);
  free(s->hit);
  free(s->node);
  free(s);
  *search = NULL;
}
