#include "search.h"
#include <stdint.h>
#include <stdlib.h>

enum { LEAF = 4, STACK = 64 };

/* node[1] is the root, 2i and 2i + 1 are the children of i, node[nleaf + l] is leaf l: boxes LEAF l .. LEAF l
 * + LEAF - 1 of the sorted list. */
struct Search_s {
  int n, nleaf, capacity;
  int *order, *hit;
  GeometryBox *box, *node;
};

static GeometryBox Join(const GeometryBox *a, const GeometryBox *b)
{
  GeometryBox r;
  for (int c = 0; c < 2; c++) {
    r.lower[c] = a->lower[c] < b->lower[c] ? a->lower[c] : b->lower[c];
    r.upper[c] = a->upper[c] > b->upper[c] ? a->upper[c] : b->upper[c];
  }
  return r;
}

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
  for (int i = 0; i < n; i++) all = Join(&all, &box[i]);
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

static void BuildTree(Search s)
{
  for (int l = 0; l < s->nleaf; l++) {
    GeometryBox all = GeometryBoxEmpty();
    for (int i = LEAF * l; i < LEAF * (l + 1) && i < s->n; i++) all = Join(&all, &s->box[i]);
    s->node[s->nleaf + l] = all;
  }
  for (int i = s->nleaf - 1; i > 0; i--) s->node[i] = Join(&s->node[2 * i], &s->node[2 * i + 1]);
}

int SearchCreate(int n, const GeometryBox box[], Search *search)
{
  Search s = calloc(1, sizeof *s);
  const size_t count = n > 0 ? (size_t)n : 1;
  if (!s) return 1;
  uint32_t *key = calloc(count, sizeof *key);
  int *other = malloc(count * sizeof *other);
  s->n = n;
  s->nleaf = 1;
  while (s->nleaf * LEAF < n) s->nleaf *= 2;
  s->order = malloc(count * sizeof *s->order);
  s->box = malloc(count * sizeof *s->box);
  s->node = malloc(2 * (size_t)s->nleaf * sizeof *s->node);
  *search = s;
  const int failed = !key || !other || !s->order || !s->box || !s->node;
  if (!failed) {
    MortonKeys(n, box, key);
    RadixSort(n, key, s->order, other);
    for (int i = 0; i < n; i++) s->box[i] = box[s->order[i]];
    BuildTree(s);
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

/* Whether a box counts is random to the processor: it is added, and the count then moves on or does not,
 * which spares it the guess. */
int SearchQuery(Search s, const GeometryBox *box, const int **hit)
{
  int stack[STACK] = {1}, top = GeometryBoxOverlap(&s->node[1], box), n = 0;
  while (top) {
    const int i = stack[--top];
    if (i < s->nleaf) {
      for (int child = 2 * i + 1; child >= 2 * i; child--) {
        stack[top] = child;
        top += GeometryBoxOverlap(&s->node[child], box);
      }
      continue;
    }
    if (Reserve(s, n + LEAF)) return -1;
    const int first = LEAF * (i - s->nleaf), last = first + LEAF < s->n ? first + LEAF : s->n;
    for (int j = first; j < last; j++) {
      s->hit[n] = s->order[j];
      n += GeometryBoxOverlap(&s->box[j], box);
    }
  }
  *hit = s->hit;
  return n;
}

int SearchCover(Search s, int max, GeometryBox cover[])
{
  int first = 1, n = 0;
  while (2 * first <= max && first < s->nleaf) first *= 2;
  for (int i = first; i < 2 * first; i++) {
    if (s->node[i].lower[0] <= s->node[i].upper[0]) cover[n++] = s->node[i];
  }
  return n;
}

void SearchDestroy(Search *search)
{
  Search s = *search;
  if (!s) return;
  free(s->order);
  free(s->hit);
  free(s->box);
  free(s->node);
  free(s);
  *search = NULL;
}
