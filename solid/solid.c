#include "solid/loads.h"
#include "solid/ranks/partition.h"
#include "solid/rigid.h"
#include "solid/step_response.h"

/* The first subdomain; elements that may change ranks later need the model. */
static PetscErrorCode Distribute(Solid s, const Model *a)
{
  PartitionGraph graph;
  int *part;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)a->nelements, &part));
  if (s->size > 1) {
    PetscCall(PartitionGraphCreate(a, &graph));
    PetscCall(PartitionGraphNear(&graph, a));
    PetscCall(PartitionGraphCut(&graph, a, s->size, part));
  }
  PetscCall(SolidTakeSubdomain(s, a, part));
  if (s->size > 1 && s->setup.rebalance > 0.0) {
    s->part = part;
    PetscCall(PetscNew(&s->model));
    PetscCall(ModelCopy(a, s->model));
  } else {
    PetscCall(PetscFree(part));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SolidCreate(MPI_Comm comm, const Model *model, const SolidSetup *setup, Solid *solid)
{
  Solid s;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  s->comm = comm;
  s->setup = *setup;
  PetscCallMPI(MPI_Comm_rank(comm, &s->rank));
  PetscCallMPI(MPI_Comm_size(comm, &s->size));
  PetscCall(Distribute(s, model));
  PetscCall(ContactCreate(s, &s->contact));
  PetscCall(ContactSearch(s->contact, s, NULL));
  *solid = s;
  PetscFunctionReturn(0);
}

/* All that depends on which elements this rank has. */
PetscErrorCode SolidFreeSubdomain(Solid s)
{
  Elements *e = &s->elements;
  PetscFunctionBeginUser;
  PetscCall(ContactDestroy(&s->contact));
  PetscCall(JointsDestroy(&s->joints));
  PetscCall(StepResponseDestroy(&s->response));
  PetscCall(PetscFree(s->shared.node));
  PetscCall(CopiesDestroy(&s->copies));
  PetscCall(
      PetscFree7(s->gid, s->node_body, s->surface, s->mass, s->inverse_mass, s->corner_start, s->corner));
  PetscCall(PetscFree(s->fixed));
  PetscCall(PetscFree7(s->rest, s->x, s->v, s->force, s->load, s->saved.x, s->saved.v));
  PetscCall(PetscFree5(s->start, s->interface_velocity, s->mobility, s->acceleration, s->piece));
  PetscCall(
      PetscFree7(s->element, s->facet, s->facet_element, s->facet_side, s->facet_across, s->base, s->body));
  PetscCall(PetscFree(s->facet_material));
  PetscCall(PetscFree(s->is_prescribed));
  PetscCall(PetscFree(s->is_taken));
  PetscCall(PetscFree(s->reaction));
  PetscCall(PetscFree(s->momentum));
  PetscCall(PetscFree(s->motion_impulse));
  PetscCall(PetscFree(s->material));
  for (int k = 0; k < s->nmotions; k++) {
    PetscCall(PetscFree(s->motion[k].row));
    PetscCall(PetscFree(s->motion[k].spin.row));
  }
  PetscCall(PetscFree(s->motion));
  PetscCall(PetscFree(s->prescribed));
  PetscCall(PetscFree(s->position_before));
  PetscCall(PetscFree(s->velocity_before));
  PetscCall(LoadsFree(s));
  PetscCall(RigidFree(s));
  PetscCall(PetscFree(e->held));
  PetscCall(PetscFree(e->bends));
  PetscCall(PetscFree5(e->six_node, e->six_first, e->far[0], e->far[1], e->far[2]));
  PetscCall(PetscFree3(e->node[0], e->node[1], e->node[2]));
  PetscCall(PetscFree4(e->inverse[0], e->inverse[1], e->inverse[2], e->inverse[3]));
  PetscCall(PetscFree3(e->stress[0], e->stress[1], e->stress[2]));
  PetscCall(PetscFree5(e->mu, e->lambda, e->eta, e->density, e->kind));
  PetscCall(
      PetscFree7(e->body, e->number, e->force[0], e->force[1], e->thickness, e->plane_stress, e->material));
  PetscCall(PetscFree(s->part));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidDestroy(Solid *solid)
{
  Solid s = *solid;
  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(0);
  if (s->before) PetscCall(SolidFreeSubdomain(s->before));
  PetscCall(PetscFree(s->before));
  PetscCall(SolidFreeSubdomain(s));
  if (s->model) PetscCall(ModelDestroy(s->model));
  PetscCall(PetscFree(s->model));
  PetscCall(PetscFree(*solid));
  PetscFunctionReturn(0);
}

void SolidGetView(Solid s, SolidView *view)
{
  *view = (SolidView){s->nnodes,
                      s->elements.n,
                      s->nfacets,
                      s->nbodies,
                      s->revision,
                      s->partition_number,
                      s->gid,
                      s->rest,
                      s->x,
                      s->v,
                      s->load,
                      s->start,
                      s->element,
                      s->facet,
                      s->elements.body,
                      s->elements.number};
}

const SolidStats *SolidGetStats(Solid s)
{
  return &s->stats;
}

PetscErrorCode SolidState(Solid s, int save)
{
  SavedState *k = &s->saved;
  PetscFunctionBeginUser;
  PetscCall(save ? SolidKeepSubdomain(s) : SolidRestoreSubdomain(s));
  if (s->joints) PetscCall(JointsState(s->joints, s, save));
  const size_t n = 2 * (size_t)s->nnodes;
  PetscCall(PetscArraycpy(save ? k->x : s->x, save ? s->x : k->x, n));
  PetscCall(PetscArraycpy(save ? k->v : s->v, save ? s->v : k->v, n));
  if (save) {
    k->balance = s->balance;
    k->h = s->h;
    k->t = s->stats.t;
    k->moved_for = s->moved_for;
    k->planned = s->planned;
  } else {
    s->balance = k->balance;
    s->h = k->h;
    s->stats.t = k->t;
    s->moved_for = k->moved_for;
    s->planned = k->planned;
    s->force_valid = PETSC_FALSE;
  }
  PetscCall(ContactState(s->contact, save));
  PetscFunctionReturn(0);
}

/* --- sums over bodies --------------------------------------------------------------------------------- */

/* First sums: mass, mass x, mass v, load, kinetic energy; then strain energy, impulse of the reaction, momentum before the last step. */
enum { M, MX, MY, MU, MV, FX, FY, KINETIC, STRAIN, RX, RY, BEFORE, NSUMS = BEFORE + 2 };

/* moved[nnodes][2]: components that have their own velocity, whatever acts on them. */
static void AddNodes(const Solid s, int n, const char moved[], double sum[][NSUMS])
{
  for (int i = 0; i < s->nnodes; i++) {
    if (s->node_body[i] >= n || !SolidOwns(s, i)) continue;
    double *k = sum[s->node_body[i]];
    const double m = s->mass[i], *v = s->v + 2 * i;
    k[M] += m;
    for (int c = 0; c < 2; c++) {
      const double f = s->force[2 * i + c] + s->load[2 * i + c];
      const double a = s->inverse_mass[i] > 0.0 && !moved[2 * i + c] ? f / m + s->setup.gravity[c] : 0.0;
      k[MX + c] += m * s->x[2 * i + c];
      k[MU + c] += m * v[c];
      k[FX + c] += s->load[2 * i + c];
      k[KINETIC] += 0.5 * m * v[c] * (v[c] + s->h * a);
    }
  }
}

static void AddStrainEnergy(const Solid s, int n, double sum[][NSUMS])
{
  const Elements *e = &s->elements;
  for (int k = 0; k < e->n; k++) {
    Tensor edges, f;
    if (e->body[k] >= n) continue;
    SolidElementShape(e, k, s->x, &edges, &f);
    const double j = TensorDeterminant(f), area = 0.5 * TensorDeterminant(edges) / j;
    sum[e->body[k]][STRAIN] += area * ElementEnergy(f, ElementsLaw(e, k));
  }
}

/* What is about the mass centres: angular momentum, moment of inertia, the load's moment; the sums of m X x x and m X.x, X at rest, whose
 * ratio is the tangent of the rotation's angle. */
static PetscErrorCode AboutCentres(const Solid s, int n, BodyState state[])
{
  double(*sum)[5];
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)n, &sum));
  for (int i = 0; i < s->nnodes; i++) {
    const int b = s->node_body[i];
    if (b >= n || !SolidOwns(s, i)) continue;
    const Point r = {s->x[2 * i] - state[b].x[0], s->x[2 * i + 1] - state[b].x[1]};
    const Point rest = {s->rest[2 * i] - state[b].x[0], s->rest[2 * i + 1] - state[b].x[1]};
    const Point v = {s->v[2 * i] - state[b].v[0], s->v[2 * i + 1] - state[b].v[1]};
    sum[b][0] += s->mass[i] * PointCross(r, v);
    sum[b][1] += s->mass[i] * (r.x * r.x + r.y * r.y);
    sum[b][2] += r.x * s->load[2 * i + 1] - r.y * s->load[2 * i];
    sum[b][3] += s->mass[i] * PointCross(rest, r);
    sum[b][4] += s->mass[i] * (rest.x * r.x + rest.y * r.y);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 5 * n, MPI_DOUBLE, MPI_SUM, s->comm));
  for (int b = 0; b < n; b++) {
    state[b].moment = sum[b][2];
    state[b].inertia = sum[b][1];
    state[b].angular_velocity = sum[b][0] / sum[b][1];
    state[b].angle = atan2(sum[b][3], sum[b][4]);
  }
  PetscCall(PetscFree(sum));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidBodies(Solid s, int n, BodyState state[])
{
  double(*sum)[NSUMS];
  const double *force;
  char *moved;
  PetscFunctionBeginUser;
  PetscCall(SolidForces(s, &force));
  PetscCall(PetscCalloc2((size_t)n, &sum, 2 * (size_t)s->nnodes, &moved));
  SolidFindMoved(s, moved);
  AddNodes(s, n, moved, sum);
  AddStrainEnergy(s, n, sum);
  for (int k = 0; k < 2 * n; k++) {
    sum[k / 2][RX + k % 2] = s->reaction[k / 2][k % 2];
    sum[k / 2][BEFORE + k % 2] = s->momentum[k / 2][k % 2];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, NSUMS * n, MPI_DOUBLE, MPI_SUM, s->comm));
  for (int b = 0; b < n; b++) {
    const double *k = sum[b];
    state[b] = (BodyState){.mass = k[M], .kinetic = k[KINETIC], .strain = k[STRAIN]};
    for (int c = 0; c < 2; c++) {
      state[b].x[c] = k[MX + c] / k[M];
      state[b].v[c] = k[MU + c] / k[M];
      state[b].load[c] = k[FX + c];
      if (s->dt <= 0.0) continue;
      state[b].reaction[c] = k[RX + c] / s->dt;
      state[b].contact[c] =
          (k[MU + c] - k[BEFORE + c] - k[RX + c]) / s->dt - k[FX + c] - k[M] * s->setup.gravity[c];
    }
  }
  PetscCall(AboutCentres(s, n, state));
  PetscCall(PetscFree2(sum, moved));
  PetscFunctionReturn(0);
}
