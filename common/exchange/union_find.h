/* Connected parts: of each item a way to the least one that it is known to be connected with.  Kernel: no MPI, no PETSc.
 * To begin with root[i] = i. */
#ifndef CORACLE_UNION_FIND_H
#define CORACLE_UNION_FIND_H

/* The least item of the part of i; the way there is shortened. */
static inline int UnionFindRoot(int root[], int i)
{
  while (root[i] != i) i = root[i] = root[root[i]];
  return i;
}

/* i and j are connected; whether that was not known before. */
static inline int UnionFindJoin(int root[], int i, int j)
{
  const int a = UnionFindRoot(root, i), b = UnionFindRoot(root, j);
  root[a > b ? a : b] = a > b ? b : a;
  return a != b;
}
#endif
