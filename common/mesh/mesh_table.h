/* Private to the mesh room: a hash table from a pair of ints to an int, open addressing, of a capacity known
 * beforehand. */
#ifndef CORACLE_MESH_TABLE_H
#define CORACLE_MESH_TABLE_H
#include <petscsys.h>
#include <stdint.h>

typedef struct {
  uint64_t mask;
  uint64_t *key;
  int *value; /* -1: free */
} MeshTable;

static inline PetscErrorCode MeshTableCreate(MeshTable *t, size_t entries)
{
  size_t n = 16;
  PetscFunctionBeginUser;
  while (n < 2 * entries) n *= 2;
  t->mask = n - 1;
  PetscCall(PetscMalloc2(n, &t->key, n, &t->value));
  for (size_t i = 0; i < n; i++) t->value[i] = -1;
  PetscFunctionReturn(0);
}

static inline PetscErrorCode MeshTableDestroy(MeshTable *t)
{
  return PetscFree2(t->key, t->value);
}

/* The value of (a, b); if it was not there it is made, with value -1, which the caller must replace. */
static inline int *MeshTableAt(MeshTable *t, int a, int b)
{
  const uint64_t key = (uint64_t)(uint32_t)a << 32 | (uint32_t)b;
  uint64_t i = key * UINT64_C(0x9E3779B97F4A7C15); /* Fibonacci hashing */
  i = (i ^ i >> 32) & t->mask;
  while (t->value[i] >= 0 && t->key[i] != key) i = (i + 1) & t->mask;
  t->key[i] = key;
  return &t->value[i];
}

/* The same for an edge, whichever way round. */
static inline int *MeshTableEdge(MeshTable *t, int a, int b)
{
  return MeshTableAt(t, a < b ? a : b, a < b ? b : a);
}
#endif
