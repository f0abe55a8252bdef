/* P immiscible phases on a distributed mesh of triangles: one volume V[element][phase] each, a straight line
 * between phases in each cut element, both moved with the fluid without diffusion.
 *
 *          /\            In a cut element the lines are taken in order: what n_0.x <= d_0 holds is phase 0;
 *         /  \           of the rest, what n_1.x <= d_1 holds is phase 1; the last phase is what remains.
 *        / 0 .\
 *       /   . 1\         Volumes are in m2 (per metre of depth).  Sum over the phases = area of the element,
 *      /  . `.  \        to round-off in each step.
 *     / .  2  `. \
 *    /__________`_\
 *
 * Order of use: PhasesCreate, PhasesFill (region.h) or PhasesSetVolumes, then for each step PhasesReconstruct
 * and PhasesAdvect.  All functions are collective unless they say otherwise. */
#ifndef CORACLE_PHASES_H
#define CORACLE_PHASES_H
#include "common/transfer/transfer.h"
#include "fluid/phases/effective_density.h"
#include "fluid/phases/gas.h"
#include "fluid/phases/plic.h"
#include "fluid/phases/stars.h"

typedef struct Phases_s *Phases;

/* stars: borrowed until PhasesDestroy.  nphases >= 2, at most PHASES_MAX. */
enum { PHASES_MAX = 8 };
PetscErrorCode PhasesCreate(const Stars *stars, int nphases, Phases *phases);
PetscErrorCode PhasesDestroy(Phases *phases);

/* How volumes move: by the regions that faces sweep, cut by the lines (as from PhasesCreate), or by limited shares on faces
 * (face_share.h).  Not collective. */
typedef enum { PHASES_GEOMETRIC, PHASES_COMPRESSIVE } PhasesAdvection;
void PhasesSetAdvection(Phases phases, PhasesAdvection advection);

/* volume[ne][nphases], m2.  Not collective. */
PetscErrorCode PhasesSetVolumes(Phases phases, const double volume[]);
/* Borrowed: [ne][nphases].  Not collective. */
PetscErrorCode PhasesGetVolumes(Phases phases, const double *volume[]);

/* From now on phases have masses: state[nphases], incompressible where its pressure is 0.  Not collective. */
PetscErrorCode PhasesSetStates(Phases phases, const EquationOfState state[]);
/* Those of a start, after the volumes are set, from the densities at pressure[nphases], Pa.  Not collective. */
void PhasesStartMasses(Phases phases, const double pressure[]);
/* [ne][nphases], borrowed, of compressible phases: masses, kg, to be read and set; NULL without. */
double *PhasesMasses(Phases phases);
/* [nl][nphases], borrowed, kg/m3, as of the last PhasesReconstruct; NULL without. */
const double *PhasesDensities(Phases phases);
/* Share of local element e, outside of the solid's share of it, that is compressible times its mean compressibility, 1/Pa; its
 * pressure by the equation of state, Pa.  filler: the phase that the solid's part has.  Of volumes and densities as of the last
 * PhasesReconstruct or PhasesUpdateDensities.  Not collective. */
double PhasesCompressibility(Phases phases, int e, double solid, int filler, double *pressure);
/* Densities of all local elements, from volumes and masses; PhasesReconstruct has this.  Collective. */
PetscErrorCode PhasesUpdateDensities(Phases phases);
/* Collective: with the volumes that passed faces beyond `before` to make swept (PhasesExpel) goes their mass, also in swept_mass; all
 * [ne][3][nphases].  An element gives what it has and passes on what comes to it: its density stays between those that there were, and no mass
 * becomes negative. */
PetscErrorCode PhasesMoveMasses(Phases phases, const double before[], const double swept[],
                                double swept_mass[]);
/* Collective, after PhasesAdvect along fluxes with divergence: compressible phases take the volume that elements lack or have too
 * much, which goes to the nearest ones that have some; expected[ne][nphases]: density near which theirs stays, kg/m3 (within a
 * factor of 2).  Added to swept of PhasesAdvect. */
PetscErrorCode PhasesFillGaps(Phases phases, const double expected[], double swept[]);

/* What a solid covers of the elements, filled by phase `filler`, until the next call: solid[ne], |K and S|/|K|.  Lines of elements beside it and the
 * distances of their vertices are those of the phases outside of the solid. */
PetscErrorCode PhasesSetSolid(Phases phases, int filler, const double solid[]);
/* Borrowed: [ne]; NULL: never set.  Not collective. */
const double *PhasesSolid(Phases phases);

/* The lines in cut elements, from the volumes.  Straight interfaces are found to round-off; the error of a
 * curved one is of order h^2. */
PetscErrorCode PhasesReconstruct(Phases phases);
/* Not collective.  The part of phase p in owned element e as a polygon in the mesh's coordinates; n = 0:
 * none. */
PetscErrorCode PhasesGetPolygon(Phases phases, int e, int p, Polygon *polygon);
/* Not collective.  The single phase of local element e, -1 if it is cut, as of the last PhasesReconstruct. */
int PhasesSingle(Phases phases, int e);
/* The interface lies along a face of local element e, whose only phase ends there: across it is one that comes after it, and no solid. */
PetscBool PhasesEndAt(Phases phases, int e);
/* Not collective.  Whether local element e has a fragment of no known place in it, which moves as if it were everywhere, as of the
 * last PhasesReconstruct. */
int PhasesSpread(Phases phases, int e);
/* Of such an element, less than which is a cloud that fragments have become: no surface, and nothing to refine for.  (With a tenth a drop of 0.3 of an
 * element falls half as far, coupled.fragment.) */
#define PHASES_CLOUD 1e-2
/* What a solid leaves of an element, if less, says nothing of where lines are. */
#define PHASES_LEAST_OPEN 0.1
/* Not collective.  Where phase p of owned element e is when it moves: *share of this polygon, 1 unless it is spread. */
PetscErrorCode PhasesGetExtent(Phases phases, int e, int p, Polygon *polygon, double *share);

/* Not collective.  How the owned elements respond to a pressure gradient: inverse[ne], of phases of density rho[nphases].
 * Needs the lines. */
PetscErrorCode PhasesGetInverseDensity(Phases phases, const double rho[], const double gravity[2],
                                       InverseDensity inverse[]);

/* Of the interfaces between two phases: [first][second], 0 among themselves. */
typedef struct {
  double value[PHASES_MAX][PHASES_MAX];
} PhasesPairs;

/* Not collective.  Surface tension, N/m, in the owned elements: force[ne][2], N/m3, is the sum over the lines k of tension kappa
 * grad H, tension that of the phases on both sides, kappa the line's curvature (curvature.h) and H linear between its values at
 * the vertices, 1 in phase k and 0 behind it.  So tension kappa H is a pressure that holds it to round-off where kappa is
 * constant, and sharp (the jumps of Kang, Fedkiw and Liu 2000 on squares).  cosine[mesh->ntags]: of the contact angles at
 * boundaries, through the first phase of each pair; NULL: 90 degrees.  Needs the lines. */
PetscErrorCode PhasesGetSurfaceForce(Phases phases, const PhasesPairs *tension, const PhasesPairs cosine[],
                                     double force[]);

/* Collective.  Length of the interfaces between a phase and others, m: of the polygon through the means of the points in which
 * the lines of neighbours cross their common face.  (The lines themselves turn too much in curved interfaces: 1 % at edges of
 * R/20.)  Where an element has several lines: of these.  A fragment, a phase of which the element and those
 * around it hold less than its area, has none: lines do not tell its place.  Needs the lines. */
PetscErrorCode PhasesInterfaceLength(Phases phases, int phase, double *length);

/* Layers outside of a boundary: phase[k] alone flows in where n.x < d[k], and not n.x < d[k - 1]. */
typedef struct {
  int n, phase[PHASES_MAX];
  double normal[2], d[PHASES_MAX];
} PhasesLevels;

/* What flows in where nothing is known: outside of open boundaries. */
typedef struct {
  const double (*fraction)[PHASES_MAX]; /* [ntags][nphases], sum 1; NULL: boundaries are closed */
  const PhasesLevels *levels;           /* [ntags], borrowed; NULL: none */
  /* [nl][nphases] kg/m3, of compressible phases that flow into an element; phases without masses: NULL */
  const double *density;
} PhasesInflow;

/* One step of dt, s, along fluxes flux[ne][3] (outward through face i, m2/s; what leaves an element enters
 * its neighbour, to the last bit; their sum over an element is 0) and the continuous velocity[ne][3][2] at
 * the vertices, m/s, the same bits wherever a vertex appears; both are those of the middle of the step.
 * Needs the lines; afterwards these belong to the old volumes.  swept[ne][3][nphases], or NULL: volume of
 * each phase that left through face i, m2.  A boundary face of flux 0 is a wall: its vertices slide along it,
 * or stay at corners.  With masses: swept_mass[ne][3][nphases], kg, is what of the compressible phases' leaves with them; fluxes
 * may have a divergence then, and PhasesFillGaps is due.  Error PETSC_ERR_ARG_OUTOFRANGE, on all ranks, for a step that traces a
 * vertex out of its two rings; compressive advection divides such a step. */
PetscErrorCode PhasesAdvect(Phases phases, double dt, const double flux[], const double velocity[],
                            const PhasesInflow *inflow, double swept[], double swept_mass[]);

/* Collective.  What an element holds of `phase` beyond capacity[ne], m2, is exchanged for the filler of the nearest elements that
 * hold filler beside it and have capacity left, however far they are: each phase's volume is conserved, that of elements, too.
 * Where all together have less room than there is excess, or in unconnected meshes, some is left.  Elements that are covered[ne] (NULL: those
 * without capacity) are passed only where there is no other way.  Added to swept[ne][3][nphases] of PhasesAdvect. */
PetscErrorCode PhasesExpel(Phases phases, int phase, int filler, const double capacity[],
                           const char covered[], double swept[]);

/* Volumes of `to` from lines and volumes of `from`, both on the meshes that the transfer was made of: copies
 * where elements are the same, else exact intersections of each phase's polygons with the new elements.
 * Conserves each phase to round-off and stays within [0, area].  Needs the lines of `from`. */
PetscErrorCode PhasesRemap(Phases from, Transfer transfer, Phases to);

typedef struct {
  double volume[PHASES_MAX]; /* of each phase, m2 */
  double lowest, highest;    /* fraction of any phase in any element */
  double gap;                /* largest |sum of volumes - area| / area */
  PetscInt cut;              /* elements with a line, as of the last PhasesReconstruct */
  double courant; /* of the last step: largest dt * outflow / area among elements near an interface */
} PhasesStats;
PetscErrorCode PhasesGetStats(Phases phases, PhasesStats *stats);
#endif
