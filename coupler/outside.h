/* The fluid beside the solid in elements that the surface crosses, among phases (mode reaction); with one fluid this is nothing.
 *
 * Such an element K has the mean density rho_K, of which the part inside the solid, alpha = |K and S|/|K|, has rho_f (the
 * phase that fills solids); so beside the solid it is
 *
 *     rho_o  =  (rho_K - alpha rho_f)/(1 - alpha).
 *
 * The fluid spreads its weight evenly over K.  Where it is, it is rho_o beside the solid and rho_f inside; the difference,
 * whose sum over K's functions is 0, is added to s:
 *
 *     (rho_o - rho_f) (alpha int_K N - int_{K and S} N) g.
 *
 * Without it each element that is crossed turns beside a solid at rest.  (Its inertia, moved likewise, needs a reaction with
 * the water's density on the solid's nodes: nodes lighter than that are thrown about.)
 *
 * The fluid slips along the solid (slip.h) where what is beside it is of the phases that do not fill solids: `slip` goes from
 * 0 to 1 where their share of K outside goes from SLIP_SHARE[0] to SLIP_SHARE[1], and with what is outside, 1 - alpha, from
 * SLIP_OPEN[0] to SLIP_OPEN[1].  In the phase that fills solids (air) it does not: what an element of one velocity and one
 * pressure leaves of forces beside a solid is many times the weight of air (2.9 m/s beside a block at rest).  Neither does it
 * in elements that are nearly inside the solid: nothing stops there what such forces leave, water is not viscous enough
 * (steps of 1 ms, le 0.008 m, a block that rolls: 0.95 m/s along its bottom after 0.5 s).  Nor beside solids that are held,
 * whose inside has no inertia. */
#ifndef CORACLE_COUPLER_OUTSIDE_H
#define CORACLE_COUPLER_OUTSIDE_H
#include "coupler/wall_term.h"

#define SLIP_SHARE                                                                                           \
  {                                                                                                          \
    0.5, 0.9                                                                                                 \
  }
#define SLIP_OPEN                                                                                            \
  {                                                                                                          \
    0.1, 0.5                                                                                                 \
  }

typedef struct {
  double density; /* rho_o - rho_f, kg/m3 */
  double slip;    /* 0 .. 1 */
} OutsideFluid;

/* Local.  outside[overlap->ncoupled]; density[overlap->nsources]: of the solid, 0 where it is held (inertia.h). */
PetscErrorCode OutsideFind(const Overlap overlap, const double density[], OutsideFluid outside[]);
/* Local: the weight above of the pairs in the solid's volume that are not held; gravity in m/s2. */
void OutsideWeight(const Overlap overlap, const OutsideFluid outside[], const double density[],
                   const double gravity[2], PairTerm term[]);
#endif
