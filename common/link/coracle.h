/* Coracle's client library: how a solid or a fluid joins a coupled run.  This is the only public header.
 *
 * A run is one MPI job of several programs ("participants"), each started with any number of ranks:
 *
 *     mpirun -n 2 coracle-fluid case.yaml : -n 1 coracle-coupler case.yaml : -n 1 coracle-solid case.yaml
 *
 *        fluid  -- u, p, mu, rho near the solid -->  coupler  -- nodal forces -------------------->  solid
 *        fluid  <-- a, s_c, solid mass per element -- coupler <-- positions, time-averaged velocity -- solid
 *
 * One coupled step, seen by each side (collective over the participant's ranks unless said otherwise):
 *
 *     solid                                             fluid
 *     CoracleBegin(c, &t, &dt, &action)                 CoracleBegin(c, &t, &dt, &action)
 *     CoracleGetForce(c, &force)                        CoracleGetCoupling(c, &k)
 *       m substeps: advance by h; CoracleSubstep        solve from t to t + dt
 *     CoracleEnd(c, x)                                  CoracleSetFlow(c, ...); CoracleEnd(c, NULL)
 *                                                       if CoracleStepAccepted(c): CoracleGetCorrection
 *
 * The coupler decides t, dt and the action; the library restores bound state when a step is redone, so that
 * an adapter need not keep what a step changes.  Arrays are C order, dim is 2 (3 to come), units are SI.
 * All functions return 0, or end the whole job with one message: there is no partial failure to handle.
 * Ranks that own nothing are normal: pass n = 0. */
#ifndef CORACLE_H
#define CORACLE_H
#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

#define CORACLE_VERSION "0.1.0"

typedef struct CoracleClient_s *CoracleClient;

typedef enum {
  CORACLE_RUN,  /* advance from t to t + dt */
  CORACLE_REDO, /* bound state has been put back to t: advance again with the new coupling data */
  CORACLE_STOP  /* the run is over: close */
} CoracleAction;

/* --- joining -------------------------------------------------------------------------------------------- */

/* Joins the job as `role` ("fluid" or "solid").  Collective over the whole job; calls MPI_Init if nobody has.
 * argv carries the case file and `--set key=value` pairs (see case_file.h); all participants must carry the
 * same.
 * app_comm: [out] this participant's communicator, ready before PetscInitialize; owned by the library.
 * Refuses, naming the odd one out: two fluids, no coupler, different versions, different case files or
 * settings. */
int CoracleOpen(const char *role, int argc, char **argv, MPI_Comm *app_comm, CoracleClient *c);

/* Ends the whole job (not collective) with "coracle <role>[rank]: error: ..." on stderr. */
_Noreturn void CoracleFail(CoracleClient c, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A number for summary.json under participants.<role>.<key>; summed over the ranks when sum is not 0, else
 * their maximum.  Local; travels when the client closes. */
int CoracleReport(CoracleClient c, const char *key, double value, int sum);

/* Leaves the job and nulls the handle; an error before CORACLE_STOP was received. */
int CoracleClose(CoracleClient *c);

/* --- what a solid gives: before CoracleReady, and after fracture between CoracleBegin and End ----------- */

/* n nodes of this rank; gid[n]: global ids (a node shared by ranks has one id, each rank lists it);
 * x[n][dim]: positions, m;  u[n][dim]: velocities, m/s.  All copied.
 * Within a step: nodes whose ids were there keep what their substeps have summed up, new ones are taken to
 * have moved with u so far.  A redone step starts on the mesh that it first started on. */
int CoracleSetNodes(CoracleClient c, int dim, int n, const long long gid[], const double x[],
                    const double u[]);
/* conn[ne][dim]: this rank's surface facets; in 2D the solid lies on the left of the edge conn[e][0] ->
 * conn[e][1]. */
int CoracleSetSurface(CoracleClient c, int ne, const int conn[]);
/* conn[ne][dim + 1]: this rank's simplices of the volume, positively oriented; ne = 0 for a surface-only
 * solid. Every element and facet is given by one rank. */
int CoracleSetVolume(CoracleClient c, int ne, const int conn[]);

/* --- what a fluid gives --------------------------------------------------------------------------------- */

/* Called back (on every fluid rank, in CoracleReady and CoracleEnd) when the region near the solid has
 * changed. box[nbox][2][dim]: lower and upper corners of the region.  The fluid answers with those of its own
 * elements that overlap any box: x[n][dim + 1][dim] their vertices, rho[n] their density, kg/m3; both
 * borrowed until the next call. */
typedef int (*CoracleRegionFunction)(void *context, int nbox, const double box[], int *n, const double **x,
                                     const double **rho);
/* lower[dim], upper[dim]: the bounds of the fluid's whole domain, the same on all ranks. */
int CoracleSetRegion(CoracleClient c, int dim, const double lower[], const double upper[],
                     CoracleRegionFunction region, void *context);
/* Tells that the fluid's elements have changed (mesh adaptation): region is called again in the next
 * CoracleEnd, if the step stands. */
int CoracleElementsChanged(CoracleClient c);

/* --- the run -------------------------------------------------------------------------------------------- */

/* Registers `bytes` at `state` to be saved at CORACLE_RUN and put back at CORACLE_REDO; before the first
 * step.  It is also what the library saves in checkpoints and, in a run that goes on from one, puts back
 * at once (on as many ranks): bind before the mesh is given. */
int CoracleBindState(CoracleClient c, void *state, size_t bytes);
/* As above for state that is no flat buffer: called with save = 1 and save = 0.  In checkpoints it is the
 * participant's own affair (CoracleCheckpointPath). */
int CoracleBindStateFunction(CoracleClient c, int (*f)(void *context, int save), void *context);

/* The first exchange: surface, volume and elements travel, the first coupling data come back. */
int CoracleReady(CoracleClient c);
/* Waits for the next step: from *t over *dt, s. */
int CoracleBegin(CoracleClient c, double *t, double *dt, CoracleAction *action);

/* Solid: force[n][dim], N, on this rank's nodes from this rank's elements and facets: a node shared by ranks
 * has its force spread over them and the solid sums it, as it sums its internal forces.  Borrowed until
 * CoracleEnd. */
int CoracleGetForce(CoracleClient c, const double **force);
/* Solid: one substep of h seconds has been made with nodal velocities u[n][dim].  u is what moves the nodes:
 * x += h u.  From the substeps the library makes what the fluid sees: the mean velocity over the step
 * (displacement / dt), and the line fitted to the velocities in the least-squares sense, taken at the last
 * substep, for couplings that need the end's. */
int CoracleSubstep(CoracleClient c, double h, const double u[]);
/* Solid, optional, between the last substep and CoracleEnd: u[n][dim], m/s, instead of that fitted line, from
 * a solid that knows better what of its velocity is motion and what vibration.  For this step only. */
int CoracleSetVelocity(CoracleClient c, const double u[]);
/* Solid, optional, before CoracleReady and where CoracleSetVelocity is: how nodes give way to the fluid by
 * themselves.
 *   mobility[n]           1/kg, velocity that a unit of impulse on the node gives it: one over its mass, all
 *                         ranks' elements together; 0 where it is held, or too stiff to move but as a body
 *   acceleration[n][dim]  m/s2, what all forces but the fluid's give it now, gravity too; 0 where mobility is
 * The coupler then takes the solid's inertia into the fluid's solve, so that soft and thin bodies can be held
 * as firmly as one likes; without it, or where mobility is 0, the fluid meets the velocity as it is.  For the
 * next step only. */
int CoracleSetInertia(CoracleClient c, const double mobility[], const double acceleration[]);

/* A checkpoint, from which another run can go on (keys output.checkpoint and resume of the case): the
 * folder into which to save what the participant is at t, when one is due in the step that CoracleBegin
 * has begun (or at CORACLE_STOP), else NULL.  Who asks has to have saved, on all ranks, by CoracleEnd, in
 * files called after its role; while one participant never asks there are no checkpoints.  The same on all
 * ranks; borrowed until CoracleEnd. */
const char *CoracleCheckpointPath(CoracleClient c);
/* After CoracleOpen: the folder that an earlier run has given so, from which this one goes on, or NULL:
 * from the start.  Who asks has to be, by CoracleReady, what it was then; the next CoracleBegin has that
 * t.  The run is refused if one does not ask. */
const char *CoracleResumePath(CoracleClient c);

/* Fluid: the flow on the elements last given by region, for the n of them:
 *   u_star[n][dim][dim + 1]  velocity with the coupling solved, before the pressure correction, m/s
 *   u_plus[n][dim][dim + 1]  velocity after it
 *   p[n][6]                  pressure on the P2 nodes: 3 vertices, then the midpoints opposite to them, Pa
 *   mu[n]                    dynamic viscosity, Pa s */
int CoracleSetFlow(CoracleClient c, const double u_star[], const double u_plus[], const double p[],
                   const double mu[]);
/* Fluid, before CoracleReady and every CoracleEnd: the largest next time step that this rank wants, s. */
int CoracleProposeStep(CoracleClient c, double dt);

/* What the solid does to one fluid element K (S the solid; i, j vertices; c, d components; in 2D per metre):
 *   a[c][i][d][j]  = int_K a_cd N_i N_j          implicit coefficient, shell and volume together, kg/s
 *   s[c][i]        = int_K (a u_s)_c N_i         explicit part of s_c, N
 *   give           = of a, what gives way as the pressure moves the fluid: u+ = u* - dt W^-1 M grad phi,
 *                    W = rho M/dt + give
 *   ms[i][j]       = int_{K and S} b N_i N_j     sub-cell solid mass, m2; b = 1, less where nodes give way
 *   us[c][i]       = int_{K and S} b N_i (u_s)_c m3/s
 *   alpha          = |K and S| / |K|             solid volume fraction
 *   shell          = |K and shell| / |K|         volume fraction of the covered shell */
typedef struct {
  int element; /* index into the elements last given by region */
  double a[2][3][2][3], give[2][3][2][3], s[2][3], ms[3][3], us[2][3], alpha, shell;
} CoracleCoupling;
/* The correction of the step just made, on its overlap: u += M^-1 r with the element's mass matrix M and
 * r[c][i] = int_{K and S} N_i (u_s - u_plus)_c, u_s the solid's new velocity, m3/s. */
typedef struct {
  int element;
  double r[2][3];
} CoracleCorrection;
/* Fluid, after CoracleEnd: 1 when the step just made stands, 0 when it will be redone: there is no
 * correction then, and what it did beside its bound state (a mesh it has adapted, a row it would write) is
 * void.  A solid learns this by the next action. */
int CoracleStepAccepted(CoracleClient c);
/* Fluid, after CoracleReady and after CoracleEnd: the coupling of the coming step.  Borrowed until the next
 * CoracleEnd. */
int CoracleGetCoupling(CoracleClient c, int *n, const CoracleCoupling **coupling);
/* Fluid, after CoracleEnd: one entry for every coupling entry of the step just made (same order, and indices
 * into the elements of that step even when region has been called again since). */
int CoracleGetCorrection(CoracleClient c, int *n, const CoracleCorrection **correction);

/* Ends the step.  Solid: x[n][dim] new positions; fluid: NULL; blocks until the next coupling is here. */
int CoracleEnd(CoracleClient c, const double x[]);

#ifdef __cplusplus
}
#endif
#endif
