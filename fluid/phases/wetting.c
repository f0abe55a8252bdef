/* Surface tension with a solid among the phases. */
#include "fluid/phases/wetting.h"
#include "fluid/phases/phases_impl.h"

/* Contacts of the same two lines that are nearer than this, in square roots of an element's area, are one. */
#define SAME 2.0

enum { AROUND_MAX = 512 };

/* What elements around this one get: contact lines' forces, less excess; N. */
typedef struct {
  double force[2], weights;
} Share;

/* most: the phase that it has most of beside the solid. */
typedef struct {
  double alpha;
  int most, moves;
} Solid;

struct Wetting_s {
  const Stars *stars;      /* borrowed */
  Phases wet;              /* the solid, then those of the fluid */
  Solid *solid;            /* [nl] */
  Share *share;            /* [nl] */
  WettingContact *contact; /* [nl][np - 1] */
  double *excess, *volume; /* [ne][2]; [ne][np] */
  VertexSurface *vertex;   /* [nowned] */
  PhasesPairs *boundary;   /* [ntags] of phases of wet */
};

PetscErrorCode WettingCreate(const Stars *s, int nphases, Wetting *wetting)
{
  const int np = nphases + 1, tags = s->mesh->ntags;
  Wetting w;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&w));
  w->stars = s;
  PetscCall(PhasesCreate(s, np, &w->wet));
  PetscCall(PetscMalloc4(s->nl, &w->solid, s->nl, &w->share, s->nowned, &w->vertex, tags, &w->boundary));
  PetscCall(PetscMalloc3((np - 1) * s->nl, &w->contact, 2 * s->ne, &w->excess, np * s->ne, &w->volume));
  w->wet->first = 1;
  w->wet->contact = w->contact;
  *wetting = w;
  PetscFunctionReturn(0);
}

PetscErrorCode WettingDestroy(Wetting *wetting)
{
  Wetting w = *wetting;
  PetscFunctionBeginUser;
  if (!w) PetscFunctionReturn(0);
  PetscCall(PhasesDestroy(&w->wet));
  PetscCall(PetscFree4(w->solid, w->share, w->vertex, w->boundary));
  PetscCall(PetscFree3(w->contact, w->excess, w->volume));
  PetscCall(PetscFree(*wetting));
  PetscFunctionReturn(0);
}

/* --- the solid as a phase ------------------------------------------------------------------------------- */

/* The phase of n that volume[n] has most of. */
static int Most(int n, const double volume[])
{
  int most = 0;
  for (int p = 1; p < n; p++)
    if (volume[p] > volume[most]) most = p;
  return most;
}

/* Volumes beside the solid, which leaves `open`, m2, of n phases that have volume[n] with what fills the solid. */
static void Outside(int n, int filler, const double volume[], double open, double outside[])
{
  for (int p = 0; p < n; p++) {
    if (p == filler) continue;
    outside[p] = fmin(fmax(volume[p], 0.0), open);
    open -= outside[p];
  }
  outside[filler] = open;
}

/* Whether an element across a face of e, or (wide) around it, has most of phase p beside the solid. */
static int IsBeside(Wetting w, int e, int p, int wide)
{
  const Stars *s = w->stars;
  for (int i = 0; i < 3 && !wide; i++) {
    const int o = s->neighbor[e][i];
    if (o >= 0 && w->solid[o].alpha < 1.0 && w->solid[o].most == p) return 1;
  }
  for (int i = 0; i < 3 && wide; i++)
    for (int m = s->start[s->vertex[e][i]]; m < s->start[s->vertex[e][i] + 1]; m++) {
      const Solid *o = &w->solid[s->around[m] / 3];
      if (o->alpha < 1.0 && o->most == p) return 1;
    }
  return 0;
}

/* Whether element e, or one across a face, has a solid. */
static int IsAtSolid(Wetting w, int e)
{
  const int *o = w->stars->neighbor[e];
  int solid = w->solid[e].alpha > 0.0;
  for (int i = 0; i < 3; i++) solid |= o[i] >= 0 && w->solid[o[i]].alpha > 0.0;
  return solid;
}

/* What of phases in element e, beside a solid, is no part of what is around it, but has moved with the surface, goes to the one that it
 * has most of. */
static void DropFilms(Wetting w, int e, double volume[])
{
  const int n = w->wet->np - 1, most = Most(n, volume);
  double open = 0.0;
  for (int p = 0; p < n; p++) open += volume[p];
  for (int p = 0; p < n; p++) {
    const int film = volume[p] < WETTING_FILM * open;
    if (p == most || (volume[p] > WETTING_TRACE * open && IsBeside(w, e, p, !film))) continue;
    volume[most] += volume[p];
    volume[p] = 0.0;
  }
}

static PetscErrorCode SetVolumes(Wetting w, Phases fluid, const WettingSolid *solid)
{
  const Stars *s = w->stars;
  const int n = fluid->np;
  PetscFunctionBeginUser;
  for (int e = 0; e < s->ne; e++) {
    const double area = StarsArea(s, e), *from = &fluid->volume[(size_t)e * (size_t)n];
    const double alpha = solid->alpha[e] > 1.0 - WETTING_OPEN ? 1.0 : solid->alpha[e];
    double *to = &w->volume[(n + 1) * e];
    to[0] = alpha * area;
    if (alpha > 0.0)
      Outside(n, solid->filler, from, area - to[0], to + 1);
    else
      for (int p = 0; p < n; p++) to[p + 1] = from[p];
    w->solid[e] = (Solid){alpha, Most(n, to + 1), solid->moves[e]};
  }
  PetscCall(StarsExchange(s, sizeof *w->solid, w->solid));
  for (int e = 0; e < s->ne; e++)
    if (IsAtSolid(w, e)) DropFilms(w, e, &w->volume[(n + 1) * e + 1]);
  PetscCall(PhasesSetVolumes(w->wet, w->volume));
  PetscCall(PhasesReconstruct(w->wet));
  PetscFunctionReturn(0);
}

/* Of pairs of phases of the fluid, those of the same behind the solid. */
static PhasesPairs Shifted(const PhasesPairs *pairs)
{
  PhasesPairs shifted = {{{0.0}}};
  for (int p = 1; p < PHASES_MAX; p++)
    for (int q = 1; q < PHASES_MAX; q++) shifted.value[p][q] = pairs->value[p - 1][q - 1];
  return shifted;
}

/* --- contact points ------------------------------------------------------------------------------------- */

static PetscErrorCode SetContacts(Wetting w, const PhasesPairs *cosine)
{
  const Stars *s = w->stars;
  const int lines = w->wet->np - 1;
  PetscFunctionBeginUser;
  for (int e = 0; e < s->ne; e++)
    for (int k = 0; k < lines; k++)
      w->contact[lines * e + k] = k ? WettingFindContact(w->wet, e, k, cosine) : (WettingContact){.found = 0};
  PetscCall(StarsExchange(s, (size_t)lines * sizeof *w->contact, w->contact));
  PetscFunctionReturn(0);
}

/* --- the force on what moves ---------------------------------------------------------------------------- */

/* around[]: element e and those up to two rings of vertices away, as far as they are local; returns their number. */
static int TwoRings(const Stars *s, int e, int around[AROUND_MAX])
{
  int n = 1, begin = 0;
  around[0] = e;
  for (int ring = 0; ring < 2; ring++) {
    const int end = n;
    for (; begin < end; begin++)
      for (int i = 0; i < 3; i++) n = StarsAddAround(s, s->vertex[around[begin]][i], n, AROUND_MAX, around);
  }
  return n;
}

/* What element e takes of a share, before it is divided by the sum of all. */
static double Weight(const Wetting w, int e)
{
  const double alpha = w->solid[e].alpha;
  return w->solid[e].moves ? alpha * alpha * StarsArea(w->stars, e) : 0.0;
}

/* force[2] += sigma t at the contact of line k of element e, divided by how many elements of around[n] have found the same. */
static void AddContactForce(Wetting w, int e, int k, const PhasesPairs *tension, int n, const int around[],
                            double force[2])
{
  const int lines = w->wet->np - 1;
  const WettingContact *c = &w->contact[lines * e + k];
  const HalfPlane *line = &w->wet->line[lines * e + k];
  const double same = SAME * sqrt(StarsArea(w->stars, e)),
               sigma = tension->value[k][PhasesBehind(w->wet, e, k)];
  double normal[2];
  int count = 0;
  if (!c->found) return;
  for (int j = 0; j < n; j++) {
    const WettingContact *o = &w->contact[lines * around[j] + k];
    count += o->found && hypot(o->x[0] - c->x[0], o->x[1] - c->x[1]) < same;
  }
  PhasesContactNormal(c->wall, c->cosine, line->n, normal);
  const double side = c->wall[0] * line->n[1] - c->wall[1] * line->n[0] < 0.0 ? -1.0 : 1.0;
  force[0] -= side * sigma / count * normal[1];
  force[1] += side * sigma / count * normal[0];
}

/* What element e gives to those around it. */
static Share ShareOf(Wetting w, int e, const PhasesPairs *tension)
{
  const int lines = w->wet->np - 1;
  Share share = {{0.0, 0.0}, 0.0};
  int around[AROUND_MAX],
      has = w->solid[e].alpha > 0.0 && (w->excess[2 * e] != 0.0 || w->excess[2 * e + 1] != 0.0);
  for (int k = 1; k < lines; k++) has |= w->contact[lines * e + k].found;
  if (!has) return share;
  const int n = TwoRings(w->stars, e, around);
  for (int j = 0; j < n; j++) share.weights += Weight(w, around[j]);
  for (int k = 1; k < lines; k++) AddContactForce(w, e, k, tension, n, around, share.force);
  for (int c = 0; c < 2 && w->solid[e].alpha > 0.0; c++) share.force[c] -= w->excess[2 * e + c];
  return share;
}

/* force[ne][2] += that of the contact lines on solids that move. */
static PetscErrorCode AddSolids(Wetting w, const PhasesPairs *tension, double force[])
{
  const Stars *s = w->stars;
  int around[AROUND_MAX];
  PetscFunctionBeginUser;
  for (int e = 0; e < s->ne; e++) w->share[e] = ShareOf(w, e, tension);
  PetscCall(StarsExchange(s, sizeof *w->share, w->share));
  for (int e = 0; e < s->nl; e++) {
    if (!(w->share[e].weights > 0.0)) continue;
    const int n = TwoRings(s, e, around);
    for (int j = 0; j < n; j++) {
      const int o = around[j];
      if (o >= s->ne) continue;
      const double part = Weight(w, o) / (w->share[e].weights * StarsArea(s, o));
      for (int c = 0; c < 2; c++) force[2 * o + c] += part * w->share[e].force[c];
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode WettingSurfaceForce(Wetting w, Phases phases, const WettingSolid *solid,
                                   const WettingSurface *surface, double force[])
{
  const PhasesPairs tension = Shifted(surface->tension), cosine = Shifted(surface->solid);
  PetscFunctionBeginUser;
  for (int b = 0; b < w->stars->mesh->ntags; b++) w->boundary[b] = Shifted(&surface->boundary[b]);
  PetscCall(PetscArrayzero(force, 2 * w->stars->ne));
  PetscCall(PetscArrayzero(w->excess, 2 * w->stars->ne));
  PetscCall(SetVolumes(w, phases, solid));
  PetscCall(SetContacts(w, &cosine));
  for (int k = 1; k + 1 < w->wet->np; k++)
    PhasesAddSurfaceForce(w->wet, k, &tension, w->boundary, w->vertex, force, w->excess);
  PetscCall(AddSolids(w, &tension, force));
  PetscFunctionReturn(0);
}
