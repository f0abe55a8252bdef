/* Private to the phases room. */
#ifndef CORACLE_PHASES_IMPL_H
#define CORACLE_PHASES_IMPL_H
#include "fluid/phases/phases.h"

/* Where line k of an element meets the solid's surface (wetting.h). */
typedef struct {
  double x[2], wall[2]; /* m; unit, into the solid */
  double cosine;        /* of the contact angle through phase k */
  int found;
} WettingContact;

/* Of an element: less of a solid is none. */
#define PHASES_LEAST_SOLID 1e-6
/* An element within this fraction of empty or full of a phase counts as such when lines are made. */
#define PHASES_TINY 1e-12
/* Less may be what round-off has left. */
#define PHASES_DUST 1e-9

/* Lines of a cut element, relative to its first vertex.  A line of n = 0 takes all (d >= 0) or nothing. */
struct Phases_s {
  const Stars *stars; /* borrowed */
  int np, first;      /* phases before `first` are the solid's (wetting.h): 0, or 1 */
  PhasesAdvection advection;
  double *volume;  /* [nl][np] m2 */
  HalfPlane *line; /* [nl][np - 1] */
  int *single;     /* [nl] the only phase, or -1 */
  char *
      spread; /* [nl] whether what is moved has the phases' shares everywhere, not by lines (reconstruct.c) */
  /* NULL: all phases are incompressible */
  EquationOfState *state;        /* [np] */
  double *mass, *density;        /* [nl][np] kg, kg/m3; of incompressible phases nothing, and theirs */
  const WettingContact *contact; /* [nl][np - 1], borrowed; NULL: no solid */
  double *solid;                 /* [nl] |K and S|/|K|; NULL: none */
  int filler;                    /* the phase that fills S */
  double courant;
  PetscBool has_lines;
};

/* The part of phase p in local element e, relative to origin. */
void PhasesPart(Phases phases, int e, int p, const double origin[2], Polygon *part);
/* The same, of those that phases 0 .. p - 1 leave together. */
void PhasesRest(Phases phases, int e, int p, const double origin[2], Polygon *rest);
/* The half plane of line p of element e, relative to origin. */
static inline HalfPlane PhasesMoveLine(HalfPlane h, const double x0[2], const double origin[2])
{
  h.d += h.n[0] * (x0[0] - origin[0]) + h.n[1] * (x0[1] - origin[1]);
  return h;
}

static inline HalfPlane PhasesLine(Phases f, int e, int p, const double origin[2])
{
  return PhasesMoveLine(f->line[(size_t)e * (size_t)(f->np - 1) + (size_t)p], f->stars->element[e].x[0],
                        origin);
}
/* The part of local element e that the solid leaves, 0 .. 1. */
static inline double PhasesOpen(Phases f, int e)
{
  return f->solid ? 1.0 - f->solid[e] : 1.0;
}
/* The volume of phase p in local element e if the solid's part of it were as what it leaves, more than 0, m2. */
static inline double PhasesVolumeBeside(Phases f, int e, int p)
{
  const double area = StarsArea(f->stars, e), open = PhasesOpen(f, e),
               filled = p == f->filler ? (1.0 - open) * area : 0.0;
  return fmin(fmax((f->volume[(size_t)e * (size_t)f->np + (size_t)p] - filled) / open, 0.0), area);
}

/* Whether line k of local element e divides no more than dust from the rest. */
static inline int PhasesIsThin(Phases f, int e, int k)
{
  const double *v = &f->volume[(size_t)e * (size_t)f->np];
  double behind = 0.0;
  for (int p = k + 1; p < f->np; p++) behind += v[p];
  return fmin(v[k], behind) < PHASES_DUST * StarsArea(f->stars, e);
}

/* Whether it does where another line divides more: of three phases or more, what round-off has left of one of them in an element of the
 * interface of two others.  The place of its line says nothing. */
static inline int PhasesIsDust(Phases f, int e, int k)
{
  if (f->np - f->first < 3 || k < f->first || !PhasesIsThin(f, e, k)) return 0;
  for (int j = f->first; j + 1 < f->np; j++)
    if (!PhasesIsThin(f, e, j)) return 1;
  return 0;
}

/* Whether line k divides local element e; what is spread has no place, and none does; dust has none, either. */
static inline int PhasesHasLine(Phases f, int e, int k)
{
  const HalfPlane *h = &f->line[(size_t)e * (size_t)(f->np - 1) + (size_t)k];
  return f->single[e] < 0 && !f->spread[e] && (h->n[0] != 0.0 || h->n[1] != 0.0) && !PhasesIsDust(f, e, k);
}
/* Whether all phases but one that owned element e has, at most, are fragments (reconstruct.c); beside a solid none is. */
int PhasesHasFragments(Phases phases, int e);
/* The next phase behind k that element e has, if it can be more than dust: what its line k divides phase k from. */
int PhasesBehind(Phases phases, int e, int k);
/* Of local element e, which line k does not divide: -1 below it (the last of its phases is k), 1 above it (all are behind k); else,
 * and where line k divides it, 0. */
int PhasesSide(Phases phases, int e, int k);
/* The phase that local element e has to itself, beside a solid, too, or that has most of it, where others are spread; -1: it has several;
 * below `first`: it has none. */
int PhasesOnly(Phases phases, int e);
/* The segment of line k of cut element e in what earlier lines leave, and *line, relative to origin. */
PolygonCut PhasesSegment(Phases phases, int e, int k, const double origin[2], HalfPlane *line);
/* The distance of vertex v of an owned element from the lines k around it, negative in phase k, m; 0 where elements below and
 * above meet there, and around which no element has such a line.  *inside: 1 in phase k, 0 behind it, 1/2 on the interface. */
double PhasesDistance(Phases phases, int k, int v, double *inside);
/* The curvature of lines k near vertex v of an owned element, 1/m, positive where phase k is convex; 0 is returned where none is
 * known.  cosine: of contact angles, as in PhasesGetSurfaceForce. */
int PhasesCurvature(Phases phases, int k, int v, const PhasesPairs cosine[], double *curvature);
/* The forces of lines k: force[ne][2] += as in PhasesGetSurfaceForce; excess[ne][2], N/m, unless it is NULL, += what the force of an
 * element has beyond that of the line's segment in it, - tension kappa n times its length; vertex[nowned]: scratch. */
typedef struct {
  double inside, curvature; /* of PhasesDistance and PhasesCurvature */
  int known;
} VertexSurface;
void PhasesAddSurfaceForce(Phases phases, int k, const PhasesPairs *tension, const PhasesPairs cosine[],
                           VertexSurface vertex[], double force[], double excess[]);
/* The nearest point in which line k of owned element e, made longer, meets the solid's surface in the elements around; cosine: of contact
 * angles. */
WettingContact WettingFindContact(Phases phases, int e, int k, const PhasesPairs *cosine);
/* The interface's unit normal, out of its first phase, where it meets a wall of unit normal wall[2], out of the fluid, at an angle
 * of this cosine; line[2]: its normal as it is, which says to which side it is inclined. */
void PhasesContactNormal(const double wall[2], double cosine, const double line[2], double normal[2]);
/* Where line k of cut element e crosses its face i, m; 0 if it does not. */
int PhasesCrossing(Phases phases, int e, int k, int i, double x[2]);
/* area[np] += weight * |polygon and phase p| in local element e; polygon lies in the element, relative to
 * origin. */
void PhasesSplit(Phases phases, int e, const Polygon *polygon, const double origin[2], double weight,
                 double area[]);
/* The same in an element whose first vertex is x0 and that has these lines[np - 1], or is of a single phase.
 * */
void PhasesSplitBy(int np, int single, const HalfPlane line[], const double x0[2], const Polygon *polygon,
                   const double origin[2], double weight, double area[]);
/* share[np] of what comes in through boundary face i: of each layer outside its part of the face, of the rest the boundary's. */
void InflowShares(const PhasesInflow *inflow, const StarElement *element, int i, int np, double share[]);
/* Density of phase p, kg/m3, that flows into local element e through the boundary. */
static inline double PhasesIncoming(Phases f, const PhasesInflow *inflow, int e, int p)
{
  return inflow && inflow->density ? inflow->density[(size_t)e * (size_t)f->np + (size_t)p]
                                   : f->state[p].density;
}
/* The two ways of PhasesAdvect; inflow: NULL where boundaries are closed; swept is written, mass, too, unless it is NULL.  Lines are
 * those of the start, or none.  The compressive one divides its step where an element would lose too much of its content. */
PetscErrorCode GeometricAdvect(Phases phases, double dt, const double flux[], const double velocity[],
                               const PhasesInflow *inflow, double swept[], double mass[]);
PetscErrorCode CompressiveAdvect(Phases phases, double dt, const double flux[], const double velocity[],
                                 const PhasesInflow *inflow, double swept[], double mass[]);
#endif
