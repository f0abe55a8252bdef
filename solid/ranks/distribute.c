/* This rank's subdomain of the model, which every rank has: nothing is sent. */
#include "solid/loads.h"
#include "solid/rigid.h"
#include "solid/six_node_kernel.h"
#include "solid/solid_impl.h"
#include "solid/springs.h"
#include <stdlib.h>

/* --- counting and numbering --------------------------------------------------------------------------- */

/* local[a->nnodes]: this rank's number of a node, in order of appearance, or -1.  It also has the nodes of
 * its ghost elements. */
static void NumberLocally(Solid s, const Model *a, int nghosts, const GhostElement ghost[], const int part[],
                          int local[])
{
  for (int n = 0; n < a->nnodes; n++) local[n] = -1;
  for (int e = 0; e < a->nelements; e++) {
    if (part[e] != s->rank) continue;
    s->elements.n++;
    for (int i = 0; i < 3; i++)
      if (local[a->element[3 * e + i]] < 0) local[a->element[3 * e + i]] = s->nnodes++;
  }
  for (int k = 0; k < nghosts; k++)
    for (int i = 0; ghost[k].rank == s->rank && i < 3; i++)
      if (local[a->element[3 * ghost[k].element + i]] < 0)
        local[a->element[3 * ghost[k].element + i]] = s->nnodes++;
  for (int k = 0; k < a->nfacets; k++) s->nfacets += part[a->facet_element[k]] == s->rank;
  s->nfaces = s->nfacets;
}

/* Room for a node of its own for each corner at a joint, and for both sides of every joint. */
static PetscErrorCode FindCapacities(Solid s, const Model *a, const InteriorEdges *edges, const int part[],
                                     const int local[])
{
  char *parts;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)a->nnodes, &parts));
  s->node_capacity = s->nnodes;
  s->facet_capacity = s->nfacets;
  for (int k = 0; k < edges->n; k++) {
    const InteriorEdge *edge = &edges->edge[k];
    if (edge->joint < 0) continue;
    for (int i = 0; i < 2; i++) {
      parts[edge->node[i]] = 1;
      s->facet_capacity += part[edge->element[i]] == s->rank;
    }
  }
  for (int k = 0; k < 3 * a->nelements; k++)
    s->node_capacity += parts[a->element[k]] && local[a->element[k]] >= 0;
  PetscCall(PetscFree(parts));
  PetscFunctionReturn(0);
}

static PetscErrorCode Allocate(Solid s)
{
  Elements *e = &s->elements;
  const size_t nn = (size_t)s->node_capacity, ne = (size_t)e->n, nf = (size_t)s->facet_capacity;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc7(nn, &s->gid, nn, &s->node_body, nn, &s->surface, nn, &s->mass, nn, &s->inverse_mass,
                         nn + 1, &s->corner_start, 3 * ne, &s->corner));
  PetscCall(PetscCalloc7(2 * nn, &s->rest, 2 * nn, &s->x, 2 * nn, &s->v, 2 * nn, &s->force, 2 * nn, &s->load,
                         2 * nn, &s->saved.x, 2 * nn, &s->saved.v));
  PetscCall(PetscMalloc7(3 * ne, &s->element, 2 * nf, &s->facet, nf, &s->facet_element, nf, &s->facet_side,
                         nf, &s->facet_across, nn, &s->base, (size_t)s->nbodies, &s->body));
  PetscCall(PetscMalloc1(nf, &s->facet_material));
  PetscCall(PetscCalloc1((size_t)s->nbodies, &s->reaction));
  PetscCall(PetscCalloc1((size_t)s->nbodies, &s->momentum));
  PetscCall(PetscCalloc1(nn, &s->is_prescribed));
  PetscCall(PetscCalloc1(2 * nn, &s->is_taken));
  PetscCall(PetscMalloc1(nn, &s->fixed));
  PetscCall(PetscMalloc3(ne, &e->node[0], ne, &e->node[1], ne, &e->node[2]));
  PetscCall(PetscMalloc4(ne, &e->inverse[0], ne, &e->inverse[1], ne, &e->inverse[2], ne, &e->inverse[3]));
  PetscCall(PetscMalloc5(ne, &e->mu, ne, &e->lambda, ne, &e->eta, ne, &e->density, ne, &e->kind));
  PetscCall(PetscMalloc7(ne, &e->body, ne, &e->number, 5 * ne, &e->force[0], 5 * ne, &e->force[1], ne,
                         &e->thickness, ne, &e->plane_stress, ne, &e->material));
  PetscCall(PetscMalloc1(ne / STRIP + 1, &e->held));
  PetscCall(PetscCalloc1(ne / STRIP + 1, &e->bends));
  PetscCall(
      PetscMalloc5(ne, &e->six_node, ne / 4, &e->six_first, ne, &e->far[0], ne, &e->far[1], ne, &e->far[2]));
  PetscCall(PetscMalloc1((size_t)s->nmaterials, &s->material));
  PetscFunctionReturn(0);
}

/* --- nodes -------------------------------------------------------------------------------------------- */

static void TakeNodes(Solid s, const Model *a, const int local[])
{
  for (int n = 0; n < a->nnodes; n++) {
    const int i = local[n];
    if (i < 0) continue;
    s->gid[i] = n;
    s->base[i] = i;
    s->node_body[i] = a->node_body[n];
    for (int c = 0; c < 2; c++) {
      s->rest[2 * i + c] = a->rest[2 * n + c];
      s->x[2 * i + c] = a->x[2 * n + c];
      s->v[2 * i + c] = a->u[2 * n + c];
    }
  }
  for (int k = 0; k < 2 * a->nfacets; k++)
    if (local[a->facet[k]] >= 0) s->surface[local[a->facet[k]]] = 1;
}

/* Over all elements in the model's order, so that every copy of a node has the same bits. */
static void LumpMass(Solid s, const Model *a, const int local[])
{
  for (int e = 0; e < a->nelements; e++) {
    for (int i = 0; i < 3; i++) {
      const int n = local[a->element[3 * e + i]];
      if (n >= 0) s->mass[n] += ModelCornerMass(a, 3 * e + i);
    }
  }
  for (int n = 0; n < a->nnodes; n++)
    if (local[n] >= 0) s->inverse_mass[local[n]] = a->fixed[n] ? 0.0 : 1.0 / s->mass[local[n]];
}

/* Adds the other ranks that have a corner of element e, which rank has, also as a ghost. */
static int AddCopies(const Solid s, const Model *a, int e, int rank, const int local[], CopiesMatch copy[],
                     int n)
{
  for (int i = 0; i < 3 && rank != s->rank; i++) {
    const int node = a->element[3 * e + i];
    if (local[node] >= 0) copy[n++] = (CopiesMatch){rank, local[node], node};
  }
  return n;
}

/* The other ranks' copies of this rank's nodes. */
static PetscErrorCode FindCopies(Solid s, const Model *a, int nghosts, const GhostElement ghost[],
                                 const int part[], const int local[])
{
  SharedNodes *c = &s->shared;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(3 * (size_t)a->nelements + 3 * (size_t)nghosts, &c->node));
  for (int e = 0; e < a->nelements; e++) c->n = AddCopies(s, a, e, part[e], local, c->node, c->n);
  for (int k = 0; k < nghosts; k++)
    c->n = AddCopies(s, a, ghost[k].element, ghost[k].rank, local, c->node, c->n);
  PetscCall(CopiesCreateMatched(s->comm, s->nnodes, &c->n, c->node, &s->copies));
  PetscCall(PetscRealloc((size_t)c->n * sizeof *c->node, &c->node));
  PetscFunctionReturn(0);
}

/* --- elements ----------------------------------------------------------------------------------------- */

/* Which part of a six-node triangle it is, and the nodes of that which are not its own. */
static void TakeSixNode(Solid s, const Model *a, int from, int k, const int local[])
{
  Elements *e = &s->elements;
  const SixNodePart part = a->six_node[from];
  const int q = part - SIX_NODE_A, *triangle = a->element + 3 * (from - q);
  e->six_node[k] = part;
  for (int i = 0; i < 3; i++) e->far[i][k] = e->node[i][k];
  if (part == SIX_NODE_A) e->six_first[e->nsix++] = k;
  if (!SixNodeIsCorner(part)) return;
  for (int i = 0; i < 3; i++) {
    const int node = SixNodeOf(q, 3 + i);
    e->far[i][k] = local[triangle[3 * (node % 3) + node / 3]];
  }
  e->bends[k / STRIP] = 1;
}

/* A corner has a third of the triangle; the middle has mass, but nothing that resists. */
static void DivideSixNode(SixNodePart part, ElementLaw *law, double *thickness)
{
  if (part == SIX_NODE_MIDDLE) {
    *law = (ElementLaw){0.0, 0.0, 0.0, 0, LAW_NEO_HOOKEAN};
    return;
  }
  law->mu /= 3.0;
  law->lambda /= 3.0;
  law->eta /= 3.0;
  *thickness /= 3.0;
}

static void TakeElement(Solid s, const Model *a, int from, int k, const int local[])
{
  Elements *e = &s->elements;
  const Material *m = &a->material[a->element_material[from]];
  ElementLaw law = ModelElementLaw(a, from);
  double thickness = m->thickness;
  for (int i = 0; i < 3; i++) s->element[3 * k + i] = e->node[i][k] = local[a->element[3 * from + i]];
  TakeSixNode(s, a, from, k, local);
  if (e->six_node[k]) DivideSixNode(e->six_node[k], &law, &thickness);
  const Tensor inverse = TensorInverse(SolidElementEdges(e, k, s->rest));
  e->inverse[0][k] = inverse.xx;
  e->inverse[1][k] = inverse.xy;
  e->inverse[2][k] = inverse.yx;
  e->inverse[3][k] = inverse.yy;
  e->mu[k] = law.mu;
  e->lambda[k] = law.lambda;
  e->eta[k] = law.eta;
  e->density[k] = m->thickness * m->density;
  e->thickness[k] = thickness;
  e->plane_stress[k] = law.plane_stress;
  e->kind[k] = law.kind;
  e->material[k] = a->element_material[from];
  e->body[k] = a->element_body[from];
  e->number[k] = from;
  if (law.eta > 0.0) e->damped = PETSC_TRUE;
  e->laws = PetscMax(e->laws, ElementLawsWith(law));
}

/* Elements, facets, and for each node the places of its corners' forces. */
static void TakeElements(Solid s, const Model *a, const int part[], const int local[], int renumber[])
{
  for (int from = 0, k = 0; from < a->nelements; from++) {
    if (part[from] != s->rank) continue;
    renumber[from] = k;
    TakeElement(s, a, from, k++, local);
  }
  for (int from = 0, k = 0; from < a->nfacets; from++) {
    if (part[a->facet_element[from]] != s->rank) continue;
    const int *node = a->element + 3 * a->facet_element[from];
    for (int i = 0; i < 2; i++) s->facet[2 * k + i] = local[a->facet[2 * from + i]];
    s->facet_side[k] = a->facet[2 * from] == node[0] ? 0 : a->facet[2 * from] == node[1] ? 1 : 2;
    s->facet_across[k] = s->facet_material[k] = -1;
    s->facet_element[k++] = renumber[a->facet_element[from]];
  }
  SolidListCorners(s);
}

/* The prescribed motions, and which of this rank's nodes they move. */
static PetscErrorCode TakeMotions(Solid s, const Model *a, const int local[])
{
  PetscFunctionBeginUser;
  s->nmotions = a->nmotions;
  PetscCall(PetscMalloc1((size_t)a->nmotions, &s->motion));
  PetscCall(PetscCalloc1((size_t)a->nmotions, &s->motion_impulse));
  PetscCall(PetscMalloc1((size_t)a->nprescribed, &s->prescribed));
  PetscCall(PetscMalloc1(2 * (size_t)a->nprescribed, &s->position_before));
  PetscCall(PetscMalloc1(2 * (size_t)a->nprescribed, &s->velocity_before));
  for (int k = 0; k < a->nmotions; k++) {
    s->motion[k] = a->motion[k];
    PetscCall(ModelCopyRows(3 * s->motion[k].nrows, &s->motion[k].row));
    PetscCall(ModelCopyRows(2 * s->motion[k].spin.nrows, &s->motion[k].spin.row));
  }
  for (int k = 0; k < a->nprescribed; k++)
    if (local[a->prescribed[k].node] >= 0)
      s->prescribed[s->nprescribed++] =
          (PrescribedNode){local[a->prescribed[k].node], a->prescribed[k].motion};
  for (int k = 0; k < s->nprescribed; k++) s->is_prescribed[s->prescribed[k].node] = 1;
  s->nprescribed_first = s->nprescribed;
  PetscFunctionReturn(0);
}

PetscErrorCode SolidTakeSubdomain(Solid s, const Model *a, const int part[])
{
  InteriorEdges edges;
  GhostElement *ghost;
  int *local, *renumber, nghosts;
  PetscFunctionBeginUser;
  PetscCall(InteriorEdgesFind(a, &edges));
  PetscCall(PetscMalloc2((size_t)a->nnodes, &local, (size_t)a->nelements, &renumber));
  s->global = (GlobalSizes){a->nelements, a->nnodes, edges.njoints};
  s->nbodies = a->nbodies;
  s->nmaterials = a->nmaterials;
  PetscCall(InteriorEdgesGhosts(&edges, a, part, &nghosts, &ghost));
  NumberLocally(s, a, nghosts, ghost, part, local);
  PetscCall(FindCapacities(s, a, &edges, part, local));
  PetscCall(Allocate(s));
  PetscCall(PetscArraycpy(s->body, a->body, (size_t)a->nbodies));
  PetscCall(PetscArraycpy(s->material, a->material, (size_t)a->nmaterials));
  TakeNodes(s, a, local);
  LumpMass(s, a, local);
  TakeElements(s, a, part, local, renumber);
  PetscCall(FindCopies(s, a, nghosts, ghost, part, local));
  PetscCall(TakeMotions(s, a, local));
  PetscCall(LoadsTake(s, a, part, renumber));
  PetscCall(SpringsFind(s));
  PetscCall(RigidFind(s));
  PetscCall(PetscCalloc5(2 * s->node_capacity, &s->start, 2 * s->node_capacity, &s->interface_velocity,
                         s->node_capacity, &s->mobility, 2 * s->node_capacity, &s->acceleration,
                         s->node_capacity, &s->piece));
  PetscCall(PetscArraycpy(s->interface_velocity, s->v, 2 * (size_t)s->nnodes));
  if (edges.njoints) PetscCall(JointsCreate(s, a, &edges, nghosts, ghost, part, local, &s->joints));
  PetscCall(InteriorEdgesDestroy(&edges));
  PetscCall(PetscFree(ghost));
  PetscCall(PetscFree2(local, renumber));
  PetscFunctionReturn(0);
}
