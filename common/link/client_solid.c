/* The solid's end: its velocity over the substeps, the force on it. */
#include "common/link/client_impl.h"
#include <math.h>
#include <string.h>

/* Of the largest displacement of a step: what the sum of h u may miss. */
#define DISPLACEMENT_ERROR 1e-6

/* Mobilities and accelerations of CoracleSetInertia, none by default. */
static const double *Inertia(CoracleClient c)
{
  ClientSolid *s = &c->solid;
  const size_t bytes = (1 + DIM) * (size_t)s->mesh.n * sizeof(double);
  if (s->has_inertia && s->inertia.size != bytes)
    ClientMisuse(c, "CoracleSetInertia", "it comes after CoracleSetNodes");
  if (!s->has_inertia && bytes) memset(BufferResize(&s->inertia, bytes), 0, bytes);
  s->has_inertia = false;
  return Doubles(&s->inertia);
}

/* SURFACE or MOTION, with positions x and velocities, fitted and mean. */
static void SendMotion(CoracleClient c, const double x[], const double fitted[], const double mean[])
{
  ClientSolid *s = &c->solid;
  const SolidMesh *m = &s->mesh;
  const double *inertia = Inertia(c);
  if (s->changed) CheckMesh(c, x);
  const ServerSolid fields = {.gid = Ids(&m->gid),
                              .x = x,
                              .u = fitted,
                              .mean = mean,
                              .mobility = inertia,
                              .acceleration = inertia ? inertia + m->n : NULL,
                              .facet = Ints(&m->facet),
                              .element = Ints(&m->element)};
  MessageHeader *h = MessageStart(&c->out, s->changed ? KIND_SURFACE : KIND_MOTION, c->p->step);
  h->count[0] = m->n;
  h->count[1] = m->nfacets;
  h->count[2] = m->nelements;
  h->flag = ClientFlags(c) | (s->pressure_load ? FLAG_PRESSURE_LOAD : 0);
  if (s->changed) FieldsPack(c->p, &c->out, &FIELDS_NODES, (size_t)m->n, &fields);
  FieldsPack(c->p, &c->out, &FIELDS_MOTION, (size_t)m->n, &fields);
  if (s->changed) {
    FieldsPack(c->p, &c->out, &FIELDS_FACETS, (size_t)m->nfacets, &fields);
    FieldsPack(c->p, &c->out, &FIELDS_SIMPLICES, (size_t)m->nelements, &fields);
  }
  ClientSend(c);
  s->changed = false;
}

void SolidReady(CoracleClient c)
{
  if (!c->solid.has_nodes)
    ClientMisuse(c, "CoracleReady", "CoracleSetNodes comes first (with n = 0 on empty ranks)");
  const SolidMesh *m = &c->solid.mesh;
  CheckMesh(c, Doubles(&m->x));
  /* cohesive edges that hold yet may have a node a side, and no facet: only before there are cracks */
  if (!c->p->resume) CheckSurface(c);
  SendMotion(c, Doubles(&m->x), Doubles(&m->u), Doubles(&m->u));
}

/* The mesh that the step begins with: at REDO the one before it, which the coupler must then see again. */
static void BeginMesh(ClientSolid *s, CoracleAction action)
{
  if (action == CORACLE_REDO && s->has_before) {
    SolidMesh changed = s->mesh;
    s->mesh = s->before;
    s->before = changed;
    s->changed = true;
  }
  s->has_before = false;
  s->elapsed = s->first = s->second = s->last = 0.0;
  s->has_given = false;
  if (action == CORACLE_RUN) BufferCopy(&s->mesh.start, s->mesh.x.data, s->mesh.x.size);
  if (s->mesh.n) memset(s->mesh.sums.data, 0, s->mesh.sums.size);
}

void SolidBegin(CoracleClient c)
{
  const int step = c->p->step;
  const MessageHeader *h = MessageReceive(c->p, &c->in, KIND_FORCE, KIND_FORCE, step);
  ClientTakeStep(c, h);
  FieldListsClear(&c->solid.force);
  FieldsAppend(c->p, &c->in, &FIELDS_FORCE, (size_t)h->count[0], &c->solid.force);
  c->solid.has_film = (h->flag & FLAG_FILM) != 0;
  ClientTakePath(c, h);
  if (c->action == CORACLE_STOP) return;
  BeginMesh(&c->solid, c->action);
  if (h->count[0] != c->solid.mesh.n)
    ParticipantFail(c->p, "the coupler has sent forces on %lld nodes in step %d, this rank has %d",
                    (long long)h->count[0], step, c->solid.mesh.n);
}

int CoracleGetForce(CoracleClient c, const double **force)
{
  ClientExpect(c, "CoracleGetForce", ROLE_SOLID, STAGE_STEP, STAGE_STEP);
  *force = Doubles(&c->solid.force.list[0]);
  return 0;
}

int CoracleGetFilm(CoracleClient c, const double **load, const double **resistance)
{
  ClientExpect(c, "CoracleGetFilm", ROLE_SOLID, STAGE_STEP, STAGE_STEP);
  static const double NOTHING[1] = {0.0}; /* of a rank without nodes */
  const double *list[2] = {Doubles(&c->solid.force.list[1]), Doubles(&c->solid.force.list[2])};
  *load = c->solid.has_film ? (list[0] ? list[0] : NOTHING) : NULL;
  *resistance = c->solid.has_film ? (list[1] ? list[1] : NOTHING) : NULL;
  return 0;
}

int CoracleSubstep(CoracleClient c, double h, const double u[])
{
  ClientSolid *s = &c->solid;
  ClientExpect(c, "CoracleSubstep", ROLE_SOLID, STAGE_STEP, STAGE_STEP);
  double *sums = Doubles(&s->mesh.sums);
  ClientGiven(c, "CoracleSubstep", "u", u, s->mesh.n);
  if (!(h > 0.0)) ParticipantFail(c->p, "CoracleSubstep: h is %g s in step %d", h, c->p->step);
  MessageCheckFinite(c->p, "velocity", "node", NULL, (size_t)s->mesh.n, DIM, u);
  s->last = s->elapsed + 0.5 * h;
  for (int i = 0; i < s->mesh.n; i++)
    for (int d = 0; d < DIM; d++) {
      sums[2 * DIM * i + d] += h * u[DIM * i + d];
      sums[2 * DIM * i + DIM + d] += h * s->last * u[DIM * i + d];
    }
  s->elapsed += h;
  s->first += h * s->last;
  s->second += h * s->last * s->last;
  return 0;
}

int CoracleSetVelocity(CoracleClient c, const double u[])
{
  ClientSolid *s = &c->solid;
  ClientExpect(c, "CoracleSetVelocity", ROLE_SOLID, STAGE_STEP, STAGE_STEP);
  ClientGiven(c, "CoracleSetVelocity", "u", u, s->mesh.n);
  MessageCheckFinite(c->p, "velocity", "node", NULL, (size_t)s->mesh.n, DIM, u);
  BufferCopy(&s->given, u, s->mesh.x.size);
  s->has_given = true;
  return 0;
}

int CoracleSetInertia(CoracleClient c, const double mobility[], const double acceleration[])
{
  ClientSolid *s = &c->solid;
  ClientExpect(c, "CoracleSetInertia", ROLE_SOLID, STAGE_SETUP, STAGE_STEP);
  const size_t n = (size_t)s->mesh.n;
  ClientGiven(c, "CoracleSetInertia", "mobility", mobility, s->mesh.n);
  ClientGiven(c, "CoracleSetInertia", "acceleration", acceleration, s->mesh.n);
  double *to = (double *)BufferResize(&s->inertia, (1 + DIM) * n * sizeof *to);
  if (n) memcpy(to, mobility, n * sizeof *to);
  if (n) memcpy(to + n, acceleration, DIM * n * sizeof *to);
  s->has_inertia = true;
  return 0;
}

int CoracleSetPressureLoad(CoracleClient c)
{
  ClientExpect(c, "CoracleSetPressureLoad", ROLE_SOLID, STAGE_SETUP, STAGE_SETUP);
  c->solid.pressure_load = true;
  return 0;
}

/* The mean over the step, and the least-squares line through the substeps' velocities at the last of them:
 * the velocity at the step's end without the body's vibrations. */
static void Velocities(ClientSolid *s)
{
  const SolidMesh *m = &s->mesh;
  const double *sums = Doubles(&m->sums), middle = s->first / s->elapsed;
  const double spread = s->second - middle * s->first; /* of tau; 0 for one substep */
  const double lever = spread > 1e-12 * s->second ? (s->last - middle) / spread : 0.0;
  double *fitted = (double *)BufferResize(&s->velocity, 2 * m->x.size), *mean = fitted + DIM * m->n;
  for (int i = 0; i < m->n; i++)
    for (int d = 0; d < DIM; d++) {
      const double zeroth = sums[2 * DIM * i + d], first = sums[2 * DIM * i + DIM + d];
      mean[DIM * i + d] = zeroth / s->elapsed;
      fitted[DIM * i + d] = mean[DIM * i + d] + lever * (first - middle * zeroth);
    }
}

/* The substeps' displacements must be those of the nodes, to a part of the largest on this rank. */
static void CheckDisplacement(CoracleClient c, const double x[])
{
  const SolidMesh *m = &c->solid.mesh;
  const double *start = Doubles(&m->start), *sums = Doubles(&m->sums);
  double largest = 0.0, size = 0.0;
  for (int k = 0; k < DIM * m->n; k++) {
    largest = fmax(largest, fmax(fabs(x[k] - start[k]), fabs(sums[2 * DIM * (k / DIM) + k % DIM])));
    size = fmax(size, fabs(x[k]));
  }
  for (int k = 0; k < DIM * m->n; k++) {
    const double moved = x[k] - start[k], summed = sums[2 * DIM * (k / DIM) + k % DIM];
    if (fabs(moved - summed) > DISPLACEMENT_ERROR * largest + 1e-12 * size)
      ParticipantFail(
          c->p,
          "node %lld has moved by %g m in component %d in step %d, its velocities over the substeps sum up "
          "to %g m: CoracleSubstep's u must be what moves the nodes%s",
          Ids(&m->gid)[k / DIM], moved, k % DIM, c->p->step, summed,
          c->action == CORACLE_REDO ? ", from where they were before the step was redone (CoracleBindState)"
                                    : "");
  }
}

void SolidEnd(CoracleClient c, const double x[])
{
  ClientSolid *s = &c->solid;
  const SolidMesh *m = &s->mesh;
  if (c->rejection.size) {
    s->has_inertia = false;
    ClientReject(c, KIND_MOTION);
    ClientSend(c);
    return;
  }
  if (!(fabs(s->elapsed - c->dt) <= 1e-9 * c->dt))
    ParticipantFail(c->p, "the substeps of step %d sum up to %.12g s, the step is %.12g s", c->p->step,
                    s->elapsed, c->dt);
  if (!x && m->n) ClientMisuse(c, "CoracleEnd", "a solid gives its positions");
  if (s->has_given && s->given.size != m->x.size)
    ClientMisuse(c, "CoracleSetVelocity", "it comes after CoracleSetNodes");
  MessageCheckFinite(c->p, "position", "node", NULL, (size_t)m->n, DIM, x);
  CheckDisplacement(c, x);
  Velocities(s);
  if (s->has_given && m->n) memcpy(s->velocity.data, s->given.data, m->x.size);
  SendMotion(c, x, Doubles(&s->velocity), Doubles(&s->velocity) + DIM * m->n);
  if (m->n) memcpy(s->mesh.x.data, x, m->x.size);
}

void SolidFree(CoracleClient c)
{
  SolidMeshFree(&c->solid.mesh);
  SolidMeshFree(&c->solid.before);
  BufferFree(&c->solid.velocity);
  BufferFree(&c->solid.given);
  BufferFree(&c->solid.inertia);
  FieldListsFree(&c->solid.force);
}
