/* Who has copies of what: found through the keys, or known. */
#include "common/exchange/copies_impl.h"
#include <stdint.h>
#include <stdlib.h>

typedef struct {
  CopiesKey key;
  int item, place;
} Arrival;

/* Told to the holder of an item: this rank has a copy too. */
typedef struct {
  long long thing;
  int item, rank;
} Holder;

static int ByKey(const void *p, const void *q)
{
  const Arrival *a = p, *b = q;
  if (a->key.a != b->key.a) return a->key.a < b->key.a ? -1 : 1;
  if (a->key.b != b->key.b) return a->key.b < b->key.b ? -1 : 1;
  return (a->place > b->place) - (a->place < b->place);
}

static int SameKey(const Arrival *a, const Arrival *b)
{
  return a->key.a == b->key.a && a->key.b == b->key.b;
}

/* The rank where the copies of a key find each other: the high bits of a product (Fibonacci hashing). */
static int MeetingRank(CopiesKey key, int size)
{
  uint64_t h = (uint64_t)key.a * UINT64_C(0x9E3779B97F4A7C15);
  h = (h ^ h >> 32 ^ (uint64_t)key.b) * UINT64_C(0xD6E8FEB86659FD93);
  return (int)((h >> 32) % (uint64_t)size);
}

/* Of the copies arrival[first .. end - 1] of one thing: each holder is told every rank with a copy, once.
 * Returns the number of records; counts them alone if holder is NULL. */
static int TellHolders(const Arrival arrival[], int first, int end, const int rank[], long long thing,
                       Holder holder[], int to[])
{
  int n = 0;
  for (int j = first; j < end && end - first > 1; j++) {
    const int r = rank[arrival[j].place];
    if (j > first && r == rank[arrival[j - 1].place]) continue;
    for (int i = first; i < end; i++) {
      if (holder) {
        holder[n] = (Holder){thing, arrival[i].item, r};
        to[n] = rank[arrival[i].place];
      }
      n++;
    }
  }
  return n;
}

/* The records for all things whose copies meet on this rank; holder NULL: their number alone. */
static int TellAll(int n, const Arrival arrival[], const int rank[], int me, Holder holder[], int to[])
{
  int told = 0, thing = 0;
  for (int first = 0, end; first < n; first = end, thing++) {
    for (end = first + 1; end < n && SameKey(&arrival[first], &arrival[end]); end++) continue;
    told += TellHolders(arrival, first, end, rank, ((long long)me << 32) + thing,
                        holder ? holder + told : NULL, holder ? to + told : NULL);
  }
  return told;
}

/* rank[k]: where arrival k comes from. */
static PetscErrorCode SourceRanks(Scatter e, int rank[])
{
  const ScatterRanks *from;
  PetscFunctionBeginUser;
  PetscCall(ScatterGetSources(e, &from));
  for (int j = 0; j < from->n; j++)
    for (int k = from->start[j]; k < from->start[j + 1]; k++) rank[k] = from->rank[j];
  PetscFunctionReturn(0);
}

/* The holders of all things that this rank has a shared copy of. */
static PetscErrorCode FindHolders(MPI_Comm comm, int n, const CopiesKey key[], int *nholders, Holder **holder)
{
  PetscMPIInt size, me;
  Scatter meet;
  Arrival *mine, *arrival;
  int *to, *rank, *back;
  Holder *told;
  void *in;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCallMPI(MPI_Comm_rank(comm, &me));
  PetscCall(PetscMalloc2(n, &mine, n, &to));
  for (int i = 0; i < n; i++) {
    mine[i] = (Arrival){key[i], i, 0};
    to[i] = MeetingRank(key[i], size);
  }
  PetscCall(ScatterCreate(comm, n, to, NULL, &meet));
  const int narrived = ScatterArriving(meet);
  PetscCall(PetscMalloc2(narrived, &arrival, narrived, &rank));
  PetscCall(ScatterForward(meet, sizeof *mine, mine, arrival));
  PetscCall(SourceRanks(meet, rank));
  for (int k = 0; k < narrived; k++) arrival[k].place = k;
  if (narrived) qsort(arrival, (size_t)narrived, sizeof *arrival, ByKey);
  const int ntold = TellAll(narrived, arrival, rank, me, NULL, NULL);
  PetscCall(PetscMalloc2(ntold, &told, ntold, &back));
  TellAll(narrived, arrival, rank, me, told, back);
  PetscCall(ScatterRecords(comm, ntold, back, sizeof *told, told, nholders, &in));
  *holder = in;
  PetscCall(PetscFree2(told, back));
  PetscCall(PetscFree2(arrival, rank));
  PetscCall(PetscFree2(mine, to));
  PetscCall(ScatterDestroy(&meet));
  PetscFunctionReturn(0);
}

static int ByItem(const void *p, const void *q)
{
  const Holder *a = p, *b = q;
  if (a->item != b->item) return a->item < b->item ? -1 : 1;
  return (a->rank > b->rank) - (a->rank < b->rank);
}

static int ByNumber(const void *p, const void *q)
{
  const long long a = *(const long long *)p, b = *(const long long *)q;
  return (a > b) - (a < b);
}

static int Find(int n, const long long sorted[], long long thing)
{
  const long long *at = bsearch(&thing, sorted, (size_t)n, sizeof thing, ByNumber);
  return (int)(at - sorted);
}

static PetscErrorCode Allocate(int n, Copies *copies)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(copies));
  (*copies)->n = n;
  PetscCall(PetscMalloc2(n, &(*copies)->owner, n, &(*copies)->is_first));
  PetscFunctionReturn(0);
}

/* Groups of the shared items and of what arrives: one for each thing, thing[n] by item. */
static PetscErrorCode MakeGroups(Copies c, const long long thing[])
{
  const int narriving = ScatterArriving(c->scatter);
  long long *sorted, *there;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(c->nshared, &sorted, narriving, &there));
  PetscCall(PetscMalloc1(c->nshared, &c->item_group));
  PetscCall(PetscMalloc1(narriving, &c->group));
  PetscCall(ScatterForward(c->scatter, sizeof *thing, thing, there));
  for (int k = 0; k < c->nshared; k++) sorted[k] = thing[c->item[k]];
  if (c->nshared) qsort(sorted, (size_t)c->nshared, sizeof *sorted, ByNumber);
  for (int k = 0; k < c->nshared; k++)
    if (k == 0 || sorted[k] != sorted[k - 1]) sorted[c->ngroups++] = sorted[k];
  for (int k = 0; k < c->nshared; k++) c->item_group[k] = Find(c->ngroups, sorted, thing[c->item[k]]);
  for (int k = 0; k < narriving; k++) c->group[k] = Find(c->ngroups, sorted, there[k]);
  PetscCall(PetscMalloc1(c->ngroups, &c->begun));
  PetscCall(PetscFree2(sorted, there));
  PetscFunctionReturn(0);
}

/* After the owners; shared items rise, and a group's first one here is the first that is met. */
static PetscErrorCode MarkFirst(Copies c, int me)
{
  char *met;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(c->ngroups, &met));
  for (int i = 0; i < c->n; i++) c->is_first[i] = c->owner[i] == me;
  for (int k = 0; k < c->nshared; k++) {
    if (met[c->item_group[k]]) c->is_first[c->item[k]] = 0;
    met[c->item_group[k]] = 1;
  }
  PetscCall(PetscFree(met));
  PetscFunctionReturn(0);
}

PetscErrorCode CopiesCreate(MPI_Comm comm, int n, const CopiesKey key[], Copies *copies)
{
  PetscMPIInt me;
  Holder *holder = NULL;
  long long *thing;
  int nholders = 0, *rank, *item;
  Copies c;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &me));
  PetscCall(FindHolders(comm, n, key, &nholders, &holder));
  if (nholders) qsort(holder, (size_t)nholders, sizeof *holder, ByItem);
  PetscCall(Allocate(n, copies));
  c = *copies;
  PetscCall(PetscMalloc3(n, &thing, nholders, &rank, nholders, &item));
  PetscCall(PetscMalloc1(nholders, &c->item));
  for (int i = 0; i < n; i++) c->owner[i] = me;
  for (int k = 0; k < nholders; k++) {
    rank[k] = holder[k].rank;
    item[k] = holder[k].item;
    thing[item[k]] = holder[k].thing;
    if (k && item[k] == item[k - 1]) continue;
    c->item[c->nshared++] = item[k];
    c->owner[item[k]] = rank[k];
  }
  PetscCall(ScatterCreate(comm, nholders, rank, item, &c->scatter));
  PetscCall(MakeGroups(c, thing));
  PetscCall(MarkFirst(c, me));
  PetscCall(PetscFree3(thing, rank, item));
  PetscCall(PetscFree(holder));
  PetscFunctionReturn(0);
}

PetscErrorCode CopiesCreateByNumber(MPI_Comm comm, int n, const long long number[], Copies *copies)
{
  CopiesKey *key;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &key));
  for (int i = 0; i < n; i++) key[i] = (CopiesKey){number[i], number[i]};
  PetscCall(CopiesCreate(comm, n, key, copies));
  PetscCall(PetscFree(key));
  PetscFunctionReturn(0);
}

/* Each shared item once, with its lowest rank; group[nitems] of the items, -1 of those with one copy. */
static void ListShared(Copies c, int me, int n, const CopiesMatch match[], int group[])
{
  for (int i = 0; i < c->n; i++) {
    group[i] = -1;
    c->owner[i] = me;
  }
  for (int k = 0; k < n; k++) {
    const int item = match[k].item;
    if (match[k].rank < c->owner[item]) c->owner[item] = match[k].rank;
    if (group[item] >= 0) continue;
    group[item] = c->item_group[c->nshared] = c->nshared;
    c->item[c->nshared++] = item;
  }
  c->ngroups = c->nshared;
}

/* The items for other ranks with those for this one at its place: to[] and row[] of n + nshared. */
static void Interleave(Copies c, int me, int n, const CopiesMatch match[], int to[], int row[])
{
  int below = 0;
  while (below < n && match[below].rank < me) below++;
  for (int k = 0; k < n; k++) {
    const int place = k < below ? k : k + c->nshared;
    to[place] = match[k].rank;
    row[place] = match[k].item;
  }
  for (int k = 0; k < c->nshared; k++) {
    to[below + k] = me;
    row[below + k] = c->item[k];
  }
}

static int CompareMatches(const void *a, const void *b)
{
  const CopiesMatch *p = a, *q = b;
  return p->rank != q->rank ? (p->rank > q->rank) - (p->rank < q->rank)
                            : (p->number > q->number) - (p->number < q->number);
}

/* Returns how many are left. */
static int SortMatches(int n, CopiesMatch match[])
{
  int kept = 0;
  if (n > 0) qsort(match, (size_t)n, sizeof *match, CompareMatches);
  for (int k = 0; k < n; k++)
    if (k == 0 || CompareMatches(&match[k], &match[kept - 1])) match[kept++] = match[k];
  return kept;
}

PetscErrorCode CopiesCreateMatched(MPI_Comm comm, int nitems, int *nmatches, CopiesMatch match[],
                                   Copies *copies)
{
  const int n = *nmatches = SortMatches(*nmatches, match);
  PetscMPIInt me;
  int *group, *to, *row;
  Copies c;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &me));
  PetscCall(Allocate(nitems, copies));
  c = *copies;
  PetscCall(PetscMalloc3(nitems, &group, 2 * n, &to, 2 * n, &row));
  PetscCall(PetscMalloc1(n, &c->item));
  PetscCall(PetscMalloc1(n, &c->item_group));
  ListShared(c, me, n, match, group);
  PetscCall(MarkFirst(c, me));
  Interleave(c, me, n, match, to, row);
  PetscCall(ScatterCreateMatched(comm, n + c->nshared, to, row, n + c->nshared, to, &c->scatter));
  PetscCall(PetscMalloc1(n + c->nshared, &c->group));
  for (int k = 0; k < n + c->nshared; k++) c->group[k] = group[row[k]];
  PetscCall(PetscMalloc1(c->ngroups, &c->begun));
  PetscCall(PetscFree3(group, to, row));
  PetscFunctionReturn(0);
}
