/* Private to copies.c and copies_create.c. */
#ifndef CORACLE_COPIES_IMPL_H
#define CORACLE_COPIES_IMPL_H
#include "common/exchange/copies.h"

/* Items with several copies are shared; a group has all copies of one thing. */
struct Copies_s {
  int n, nshared, ngroups;
  Scatter scatter; /* shared items -> all ranks that have the thing, this one too */
  int *item;       /* [nshared] */
  int *item_group; /* [nshared] */
  int *group;      /* [arriving] of what arrives */
  int *owner;      /* [n] lowest rank with a copy */
  char *is_first;  /* [n] of the copies there */
  char *arrived, *result;
  size_t arrived_capacity, result_capacity;
  char *begun; /* [ngroups] */
};
#endif
