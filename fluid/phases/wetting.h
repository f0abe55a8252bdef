/* Surface tension among phases with a solid in them.  The lightest phase fills the solid (README.md), so the lines of the phases run
 * along its wetted surface, too.  Here the solid is a phase of its own, the first one, and the lines behind it divide what it
 * leaves:
 *
 *       air   |/////       volumes   V_0 = |K and S|,  V_{p + 1} = V_p, that of the filler less what of it is in S
 *      -------x/ S /       x         the contact point: where line k of an element, made longer, meets a line 0 nearby
 *       water |/////
 *
 * - Elements in S have no tension, those beside it have that of the lines between fluids alone.  A vertex's distance from a line
 *   and the curvature around it are of the parts outside of S; the contact angle at x is one more equation of the fit, as at walls.
 * - Where the line goes into S the force sigma kappa grad H of an element has a part inside S.  What moves freely there gets instead
 *   the force of the contact line, sigma t, t the tangent of the free surface out of S (Young 1805 with the contact angle):
 *   over elements e around,  sum w_e (sigma t - excess),  w ~ alpha^2 |K|.  The solid has it as it has all forces inside
 *   it, through the coupling, and free surface, contact lines and solids together get what the ends at walls do.
 * - What moves with the surface leaves films of one phase along it in the other (README.md, Solids).  They have no lines: beside a solid
 *   a phase counts that an element across a face has most of; with more than WETTING_FILM of what the solid leaves, one around it.
 */
#ifndef CORACLE_PHASES_WETTING_H
#define CORACLE_PHASES_WETTING_H
#include "fluid/phases/phases.h"

/* Of what the solid leaves of an element: less of a phase may be a film; never makes a line. */
#define WETTING_FILM 0.2
#define WETTING_TRACE 0.02
/* Of an element: less than that beside the solid is none. */
#define WETTING_OPEN 0.01

typedef struct Wetting_s *Wetting;

/* Of the owned elements. */
typedef struct {
  const double *alpha; /* [ne] |K and S|/|K| */
  const char *moves;   /* [ne] whether the solid in the element moves freely */
  int filler;          /* the phase that fills it */
} WettingSolid;

/* Contact angles at boundaries, cosine[mesh->ntags], as in PhasesGetSurfaceForce, and at solids. */
typedef struct {
  const PhasesPairs *tension, *boundary, *solid;
} WettingSurface;

/* For nphases < PHASES_MAX of the fluid; stars: borrowed.  Collective, like what follows. */
PetscErrorCode WettingCreate(const Stars *stars, int nphases, Wetting *wetting);
PetscErrorCode WettingDestroy(Wetting *wetting);
/* force[ne][2], N/m3, as of PhasesGetSurfaceForce, with the solid.  phases: of the fluid. */
PetscErrorCode WettingSurfaceForce(Wetting wetting, Phases phases, const WettingSolid *solid,
                                   const WettingSurface *surface, double force[]);
#endif
