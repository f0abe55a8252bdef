/* The coupler's end towards the solid. */
#include "common/link/server_impl.h"
#include <stdlib.h>
#include <string.h>

enum { DIM = CORACLE_DIM };

/* Receives one client's SURFACE or MOTION and appends its motion to the lists; returns whether its mesh is
 * new. */
static int ReceiveMotion(Server s, ClientRank *client, int *nnodes)
{
  Message *m = &client->in;
  const MessageKind kind = s->received_solid ? KIND_MOTION : KIND_SURFACE;
  const MessageHeader *h = MessageReceive(s->p, m, kind, KIND_SURFACE, s->solid.step);
  const bool whole = h->kind == KIND_SURFACE;
  ClientListFlags(s, ROLE_SOLID, client, h);
  s->pressure_load |= (h->flag & FLAG_PRESSURE_LOAD) != 0;
  client->first = *nnodes;
  if (ClientListRejects(s, ROLE_SOLID, client)) {
    *nnodes += client->n;
    return 0;
  }
  if (!whole && (int)h->count[0] != client->n)
    ServerFail(s, "solid rank %d moves %d nodes but has %d", m->rank, (int)h->count[0], client->n);
  client->n = (int)h->count[0];
  if (whole) {
    FieldListsClear(&client->nodes);
    FieldListsClear(&client->facets);
    FieldListsClear(&client->elements);
    FieldsAppend(s->p, m, &FIELDS_NODES, (size_t)client->n, &client->nodes);
  }
  FieldsAppend(s->p, m, &FIELDS_MOTION, (size_t)client->n, &s->motion);
  if (whole) {
    FieldsAppend(s->p, m, &FIELDS_FACETS, (size_t)h->count[1], &client->facets);
    FieldsAppend(s->p, m, &FIELDS_SIMPLICES, (size_t)h->count[2], &client->elements);
  }
  *nnodes += client->n;
  return whole;
}

static void AppendShifted(Buffer *list, const Buffer *conn, int shift)
{
  const size_t n = conn->size / sizeof(int);
  const int *from = (const int *)(const void *)conn->data;
  int *to = BufferExtend(list, conn->size);
  for (size_t i = 0; i < n; i++) to[i] = from[i] + shift;
}

static void Swap(Buffer *a, Buffer *b)
{
  const Buffer c = *a;
  *a = *b;
  *b = c;
}

/* The clients' meshes, one after the other; that of the step's start is kept. */
static void AssembleMesh(Server s)
{
  if (!s->kept_start) {
    Swap(&s->gid, &s->start_gid);
    Swap(&s->facet, &s->start_facet);
    Swap(&s->element, &s->start_element);
  }
  s->kept_start = true;
  BufferResize(&s->gid, 0);
  BufferResize(&s->facet, 0);
  BufferResize(&s->element, 0);
  for (int i = 0; i < s->solid.n; i++) {
    const ClientRank *client = &s->solid.client[i];
    const Buffer *gid = &client->nodes.list[0];
    if (gid->size) memcpy(BufferExtend(&s->gid, gid->size), gid->data, gid->size);
    AppendShifted(&s->facet, &client->facets.list[0], client->first);
    AppendShifted(&s->element, &client->elements.list[0], client->first);
  }
}

static bool Same(const Buffer *a, const Buffer *b)
{
  return a->size == b->size && (a->size == 0 || !memcmp(a->data, b->data, a->size));
}

/* A step is made again, and this time the solid has kept its mesh. */
static bool IsThatOfStart(const Server s)
{
  return s->kept_start && Same(&s->gid, &s->start_gid) && Same(&s->facet, &s->start_facet) &&
         Same(&s->element, &s->start_element);
}

static int CompareIds(const void *a, const void *b)
{
  const long long x = *(const long long *)a, y = *(const long long *)b;
  return (x > y) - (x < y);
}

/* Whether the elements are those that the step began with: each corner the node that it was, or one that is
 * new. */
static bool SameElements(Server s)
{
  const long long *gid = (const long long *)(const void *)s->gid.data;
  const long long *start_gid = (const long long *)(const void *)s->start_gid.data;
  const int *element = (const int *)(const void *)s->element.data;
  const int *start = (const int *)(const void *)s->start_element.data;
  const size_t n = s->start_gid.size / sizeof *gid, ncorners = s->element.size / sizeof *element;
  long long *sorted = malloc(s->start_gid.size + 1);
  int same = s->element.size == s->start_element.size;
  if (n) memcpy(sorted, start_gid, s->start_gid.size);
  qsort(sorted, n, sizeof *sorted, CompareIds);
  for (size_t k = 0; k < ncorners && same; k++) {
    const long long *id = &gid[element[k]];
    same = *id == start_gid[start[k]] || !bsearch(id, sorted, n, sizeof *sorted, CompareIds);
  }
  free(sorted);
  return same;
}

/* What the coupler reads: the arrays of all clients' lists. */
static void View(const Server s, int nnodes, ServerSolid *solid)
{
  *solid = (ServerSolid){.pressure_load = s->pressure_load,
                         .nnodes = nnodes,
                         .nfacets = (int)(s->facet.size / (DIM * sizeof(int))),
                         .nelements = (int)(s->element.size / ((DIM + 1) * sizeof(int))),
                         .gid = (const long long *)(const void *)s->gid.data,
                         .facet = (const int *)(const void *)s->facet.data,
                         .element = (const int *)(const void *)s->element.data};
  FieldsView(&FIELDS_MOTION, &s->motion, 0, solid);
}

int ServerReceiveSolid(Server s, ServerSolid *solid)
{
  const bool first = !s->received_solid;
  int nnodes = 0, changed = 0;
  FieldListsClear(&s->motion);
  BufferResize(&s->rejection, 0);
  for (int i = 0; i < s->solid.n; i++) changed |= ReceiveMotion(s, &s->solid.client[i], &nnodes);
  if (changed || first) AssembleMesh(s);
  if (!first && IsThatOfStart(s)) changed = 0;
  ServerAgree(s, &changed);
  *solid = (ServerSolid){0};
  if (s->rejection.size) return 0;
  if (first) MPI_Allreduce(MPI_IN_PLACE, &s->pressure_load, 1, MPI_C_BOOL, MPI_LOR, s->p->app);
  s->received_solid = true;
  const bool mine = changed && !first && s->kept_start;
  int lost = mine && !SameElements(s);
  if (changed) MPI_Allreduce(MPI_IN_PLACE, &lost, 1, MPI_INT, MPI_LOR, s->p->app);
  View(s, nnodes, solid);
  solid->changed = changed;
  solid->lost = lost;
  solid->before = mine && !lost ? (const int *)(const void *)s->start_element.data : NULL;
  return 0;
}

int ServerSetFilm(Server s, const double load[], const double resistance[])
{
  s->film = (FieldsForce){.film_load = load, .film_resistance = resistance};
  return 0;
}

/* What n nodes from `first` on get, in the next force. */
static FieldsForce ForceFrom(const FieldsForce *film, const double force[], int first, size_t n)
{
  FieldsForce its = {NULL, NULL, NULL};
  if (n == 0) return its;
  its.force = force + DIM * first;
  if (!film->film_load) return its;
  its.film_load = film->film_load + DIM * first;
  its.film_resistance = film->film_resistance + DIM * DIM * first;
  return its;
}

int ServerSendForce(Server s, double t, double dt, CoracleAction action, const double force[])
{
  const int step = s->solid.step; /* which the clients are in until they get this */
  if (!s->received_solid) ServerFail(s, "ServerSendForce comes after the first ServerReceiveSolid");
  ClientListStep(s, &s->solid, action);
  if (action == CORACLE_RUN) s->kept_start = false;
  for (int i = 0; i < s->solid.n; i++) {
    ClientRank *client = &s->solid.client[i];
    if (action == CORACLE_RUN) {
      client->first_start = client->first;
      client->n_start = client->n;
    }
    const size_t n = action == CORACLE_STOP ? 0 : (size_t)client->n_start;
    const FieldsForce its = ForceFrom(&s->film, force, client->first_start, n);
    MessageHeader *h = MessageStart(&client->out, KIND_FORCE, step);
    if (s->film.film_load) h->flag = FLAG_FILM;
    h->action = action;
    h->t = t;
    h->dt = dt;
    h->count[0] = (int64_t)n;
    FieldsPack(s->p, &client->out, &FIELDS_FORCE, n, &its);
    ClientListAskSave(s, client, action);
  }
  ClientListSend(s, &s->solid);
  s->film = (FieldsForce){NULL, NULL, NULL};
  return 0;
}
