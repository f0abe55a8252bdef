#include "common/transfer/match.h"
#include <string.h>

/* The finaliser of splitmix64 (Steele, Lea and Flood 2014): every bit of v reaches every bit of the result.
 */
static uint64_t Mix(uint64_t v)
{
  v = (v ^ v >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
  v = (v ^ v >> 27) * UINT64_C(0x94d049bb133111eb);
  return v ^ v >> 31;
}

uint64_t MatchHash(const double x[3][2])
{
  uint64_t hash = 0;
  for (int i = 0; i < 3; i++) {
    uint64_t bits[2];
    memcpy(bits, x[i], sizeof bits);
    hash += Mix(Mix(bits[0]) + bits[1]);
  }
  return hash;
}

/* The turn that makes b of a, -1 if none does. */
static int Turn(const double a[3][2], const double b[3][2])
{
  for (int turn = 0; turn < 3; turn++) {
    int same = 0;
    for (int i = 0; i < 3; i++) same += !memcmp(b[i], a[(i + turn) % 3], sizeof b[i]);
    if (same == 3) return turn;
  }
  return -1;
}

PetscErrorCode MatchTriangles(int na, const double a[][3][2], int nb, const double b[][3][2], int match[])
{
  struct {
    uint64_t hash;
    int triangle; /* -1: free */
  } * slot;
  uint64_t n = 16;
  PetscFunctionBeginUser;
  while (n < 2 * (uint64_t)na) n *= 2;
  PetscCall(PetscMalloc1(n, &slot));
  for (uint64_t k = 0; k < n; k++) slot[k].triangle = -1;
  for (int s = 0; s < na; s++) {
    const uint64_t hash = MatchHash(a[s]);
    uint64_t k = hash & (n - 1);
    while (slot[k].triangle >= 0) k = (k + 1) & (n - 1);
    slot[k].hash = hash;
    slot[k].triangle = s;
  }
  for (int t = 0; t < nb; t++) {
    const uint64_t hash = MatchHash(b[t]);
    match[t] = -1;
    for (uint64_t k = hash & (n - 1); slot[k].triangle >= 0 && match[t] < 0; k = (k + 1) & (n - 1)) {
      const int turn = slot[k].hash == hash ? Turn(a[slot[k].triangle], b[t]) : -1;
      if (turn >= 0) match[t] = 3 * slot[k].triangle + turn;
    }
  }
  PetscCall(PetscFree(slot));
  PetscFunctionReturn(0);
}
