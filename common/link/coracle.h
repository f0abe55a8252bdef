/* Coracle's client library: how a solid or a fluid joins a coupled run.  Case files are read with case_file.h,
 * the other public header.
 *
 * A run is one MPI job of several programs ("participants"), each started with any number of ranks:
 *
 *     mpirun -n 2 coracle-fluid case.yaml : -n 1 coracle-coupler case.yaml : -n 1 coracle-solid case.yaml
 *
 *     +-------+  u*, u projected, rho, mu, (p)      +---------+  nodal forces                     +-------+
 *     |       | ----------------------------------> |         | --------------------------------> |       |
 *     | fluid |                                     | coupler |                                   | solid |
 *     |       | <---------------------------------- |         | <-------------------------------- |       |
 *     +-------+  a, s_c, solid mass per element     +---------+  positions, velocities, inertia   +-------+
 *
 * The order of calls, by participant (collective over its ranks unless said otherwise):
 *
 *     solid                                             fluid
 *     -----                                             -----
 *     CoracleOpen                                       CoracleOpen
 *     CoracleBindState                                  CoracleGetRegion        where the solid is
 *     CoracleSetNodes, SetSurface, SetVolume            CoracleBindState
 *     CoracleSetInertia, SetPressureLoad (optional)     CoracleSetRegion, CoracleProposeStep
 *     CoracleReady                                      CoracleReady
 *     loop                                              loop
 *       CoracleBegin(c, &t, &dt, &action)                 CoracleBegin(c, &t, &dt, &action)
 *       stop if action is CORACLE_STOP                    stop if action is CORACLE_STOP
 *       CoracleGetForce                                   CoracleGetCoupling
 *       m substeps: advance by h; CoracleSubstep          solve from t to t + dt
 *       CoracleSetVelocity, CoracleSetInertia             CoracleSetFlow, CoracleProposeStep
 *       CoracleEnd(c, x)                                  CoracleEnd(c, NULL)
 *                                                         if CoracleStepAccepted(c): CoracleGetCorrection
 *     CoracleClose                                      CoracleClose
 *
 * A participant that cannot make the step (its iteration diverges, an element turns inside out) calls CoracleRejectStep before
 * CoracleEnd, and is asked for a shorter one.  The coupler decides t, dt and the action; the library restores bound state when a step is redone, so that
 * an adapter need not keep what a step changes.  Arrays are in C order, units are SI.
 * All functions return 0, or end the whole job with one message: there is no partial failure to handle.  A call
 * out of order is such an error; its message says where the call belongs.  Ranks that own nothing are normal:
 * pass n = 0. */
#ifndef CORACLE_H
#define CORACLE_H

/* C++: MPI's C interface is all that is used. */
#ifndef OMPI_SKIP_MPICXX
#define OMPI_SKIP_MPICXX 1
#endif
#ifndef MPICH_SKIP_MPICXX
#define MPICH_SKIP_MPICXX 1
#endif
#include <mpi.h>
#include <stddef.h>

#ifdef __cplusplus
#define CORACLE_NORETURN [[noreturn]]
extern "C" {
#else
#define CORACLE_NORETURN _Noreturn
#endif

#define CORACLE_VERSION "0.1.0"
/* The version of the library, as CORACLE_VERSION is that of the header.  Local, at any time. */
const char *CoracleVersion(void);

/* Elements are simplices with P1 velocity; the pressure is P2. */
enum {
  CORACLE_DIM = 2,                    /* components of a vector */
  CORACLE_VERTICES = CORACLE_DIM + 1, /* of an element, and nodes of the velocity on it */
  CORACLE_PRESSURE_NODES = 6          /* nodes of the pressure on an element */
};

typedef struct CoracleClient_s *CoracleClient;

typedef enum {
  CORACLE_RUN,  /* advance from t to t + dt */
  CORACLE_REDO, /* bound state has been restored to t: advance again with the new coupling data */
  CORACLE_STOP  /* the run is over: close */
} CoracleAction;

/* --- joining and leaving -------------------------------------------------------------------------------- */

/* Joins the job as `role` ("fluid" or "solid").  Collective over the whole job; calls MPI_Init if nobody has.
 * argv carries the case file and `--set key=value` pairs (see case_file.h); all participants must carry the
 * same.
 * app_comm: [out] this participant's communicator, ready before PetscInitialize; owned by the library.
 * Refuses, naming the participant that differs: two fluids, no coupler, different versions, different case
 * files or settings. */
int CoracleOpen(const char *role, int argc, char **argv, MPI_Comm *app_comm, CoracleClient *c);

/* The same in a job whose participants' ranks are those of `job`, which MPI must have been started for; kept by
 * the caller until CoracleClose.  All participants must name the same ranks: coracle-fluid, coracle-coupler and
 * coracle-solid use MPI_COMM_WORLD, so that this serves jobs made of other programs. */
int CoracleOpenComm(MPI_Comm job, const char *role, int argc, char **argv, MPI_Comm *app_comm,
                    CoracleClient *c);

/* The same for languages that know a communicator by its Fortran handle (MPI_Comm_c2f).
 * job: the participants' ranks, or NULL for MPI_COMM_WORLD;  app_comm: [out] as above. */
int CoracleOpenFortran(const MPI_Fint *job, const char *role, int argc, char **argv, MPI_Fint *app_comm,
                       CoracleClient *c);

/* Local, at any time, also before CoracleOpen: f(context, message) is called on a rank that ends the job, after
 * the message has been written to stderr (by one rank) and before MPI_Abort.  f may save what it wants, or not
 * return: then it must end the job itself.  NULL: nothing is called.  Ranks that are ended by another rank's
 * MPI_Abort do not call it. */
int CoracleSetErrorHandler(void (*f)(void *context, const char *message), void *context);

/* Ends the whole job (not collective) with "coracle <role>[rank]: error: ..." on stderr. */
CORACLE_NORETURN void CoracleFail(CoracleClient c, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The same with a finished message; client: a CoracleClient, so that this can be the `fail` of CoracleCaseOpen. */
CORACLE_NORETURN void CoracleFailMessage(void *client, const char *message);

/* A number for summary.json under participants.<role>.<key>; summed over the ranks when sum is not 0, else
 * their maximum.  Local; travels when the client closes. */
int CoracleReport(CoracleClient c, const char *key, double value, int sum);

/* Local, at any time: what this rank computes from now on, until the next phase, wait or step, is called `name` (its first
 * 23 characters; NULL: nothing) in the trace of the run (key output.trace). */
int CoraclePhase(CoracleClient c, const char *name);

/* Leaves the job and nulls the handle; an error before CORACLE_STOP was received.  Calls MPI_Finalize if
 * CoracleOpen has called MPI_Init. */
int CoracleClose(CoracleClient *c);

/* --- the solid's mesh: before CoracleReady, and after fracture between CoracleBegin and CoracleEnd ------- */

/* n nodes of this rank; gid[n]: global ids (a node shared by ranks has one id, each rank lists it);
 * x[n][dim]: positions, m;  u[n][dim]: velocities, m/s.  All copied.
 * Within a step: nodes whose ids were there before keep the sums of their substeps, new ones are taken to
 * have moved with u so far.  A redone step starts on the mesh that its first attempt started on. */
int CoracleSetNodes(CoracleClient c, int dim, int n, const long long gid[], const double x[],
                    const double u[]);
/* conn[ne][dim]: this rank's surface facets; in 2D the solid lies on the left of the edge conn[e][0] ->
 * conn[e][1]. */
int CoracleSetSurface(CoracleClient c, int ne, const int conn[]);
/* conn[ne][dim + 1]: this rank's simplices of the volume, positively oriented; ne = 0 for a surface-only
 * solid.  Every element and facet is given by one rank. */
int CoracleSetVolume(CoracleClient c, int ne, const int conn[]);
/* Optional, before CoracleReady, on any rank for all: the pressure of the fluid around compresses the solid.  The force on its
 * nodes has no part in a uniform pressure without it; with it CoracleGetForce has, in each element of the volume, a load
 * without resultant and without moment of the pressure outside, Pa, which rises over some tens of steps.  Nothing else changes
 * for the solid: the load is a part of the fluid's force in CoracleSetInertia.  Not for bodies whose stiffness stands for
 * rigid.  Refused where the coupling mode is not reaction and where the fluid has phases; the mesh must not change after
 * it. */
int CoracleSetPressureLoad(CoracleClient c);

/* --- the fluid's elements near the solid ---------------------------------------------------------------- */

/* The fluid's elements that overlap the region, on this rank. */
typedef struct {
  int n;
  const double *x;   /* [n][dim + 1][dim] vertices, m */
  const double *rho; /* [n] density, kg/m3 */
  const double *mu;  /* [n] dynamic viscosity, Pa s */
  /* optional, for a fluid of several phases that share a velocity, kg/m3; NULL: rho */
  const double *
      rho_inside; /* [n] density of the phase that fills the solid there: the coupler fills it up from that */
  const double *rho_beside; /* [n] mean density of the element's other phases; 0 where it has none */
} CoracleElements;

/* The region near the solid, before the fluid has elements: waits until the coupler has the solid.
 * box[nbox][2][dim]: lower and upper corners, m, the same on all ranks, up to 256 or, with thousands of bodies, 4096; borrowed
 * until CoracleReady.
 * Optional, once, before CoracleReady: for a fluid whose first mesh depends on where the solid is. */
int CoracleGetRegion(CoracleClient c, int *nbox, const double **box);
/* Called back (on every fluid rank, in CoracleReady and CoracleEnd) when the region has changed: the fluid
 * answers with those of its own elements that overlap any box, with the density and the viscosity that the
 * coming step begins with.  The arrays are borrowed until the next call. */
typedef int (*CoracleRegionFunction)(void *context, int nbox, const double box[], CoracleElements *elements);
/* lower[dim], upper[dim]: the bounds of the fluid's whole domain, m, the same on all ranks. */
int CoracleSetRegion(CoracleClient c, int dim, const double lower[], const double upper[],
                     CoracleRegionFunction region, void *context);
/* The fluid's elements will be others after this step (mesh adaptation): region is called in the next
 * CoracleEnd, if the step is accepted. */
int CoracleElementsChanged(CoracleClient c);
/* Before CoracleReady and every CoracleEnd: the largest next time step that this rank wants, s. */
int CoracleProposeStep(CoracleClient c, double dt);

/* --- the run -------------------------------------------------------------------------------------------- */

/* Registers `bytes` at `state` to be saved at CORACLE_RUN and restored at CORACLE_REDO; before the first
 * step.  The library also saves it in checkpoints and restores it at once in a run that resumes from one (on
 * as many ranks): bind before the mesh is given. */
int CoracleBindState(CoracleClient c, void *state, size_t bytes);
/* As above for state that is no flat buffer: called with save = 1 and save = 0.  Such a participant saves
 * itself in checkpoints (CoracleCheckpointPath). */
int CoracleBindStateFunction(CoracleClient c, int (*f)(void *context, int save), void *context);

/* The first exchange: surface, volume and elements travel, the first coupling data come back. */
int CoracleReady(CoracleClient c);
/* Waits for the next step: from *t over *dt, s. */
int CoracleBegin(CoracleClient c, double *t, double *dt, CoracleAction *action);
/* Ends the step.  Solid: x[n][dim] new positions, m; fluid: NULL, waits for the correction. */
int CoracleEnd(CoracleClient c, const double x[]);

/* Between CoracleBegin and CoracleEnd, on any rank for all: the step cannot be made with what has been received.  CoracleEnd is called all the
 * same (a solid's x may be NULL, CoracleSetFlow may be missing), what has been given in the step is dropped, and the next action is
 * CORACLE_REDO over half of dt; after six halvings the job ends with `why`, one line that says what has failed, where (copied). */
int CoracleRejectStep(CoracleClient c, const char *why);

/* A checkpoint, from which another run can resume (keys output.checkpoint and resume of the case): the
 * folder into which to save the participant's state at t, when one is due in the step that CoracleBegin
 * has begun (or at CORACLE_STOP), else NULL.  A participant that calls this must have saved, on all ranks, by
 * CoracleEnd, in files named after its role.  It asks before it may reject the step (CoracleRejectStep): a step that is redone has no
 * path, and is without a checkpoint if the path was not asked for.  While one participant never calls it there are no checkpoints.
 * The same on all ranks; borrowed until CoracleEnd. */
const char *CoracleCheckpointPath(CoracleClient c);
/* After CoracleOpen: the checkpoint's folder from which this run resumes, or NULL: from the start.  A
 * participant that calls this must have that state by CoracleReady; the next CoracleBegin has that t.  The
 * run is refused if a participant does not call it. */
const char *CoracleResumePath(CoracleClient c);

/* --- the solid in a step -------------------------------------------------------------------------------- */

/* force[n][dim], N, on this rank's nodes from this rank's elements and facets: a node shared by ranks has its
 * force spread over them and the solid sums it, as it sums its internal forces.  Borrowed until CoracleEnd.
 * It is constant over the step, which must have its whole impulse (Newmark's average acceleration leaves half of it for the next
 * step), and it feeds vibrations that the step does not resolve: an implicit scheme needs some damping of those
 * (cases/adapters/dealii/README.md). */
int CoracleGetForce(CoracleClient c, const double **force);
/* Optional, between CoracleBegin and CoracleEnd: films of fluid between solids that are about to touch (they are thinner than the
 * fluid's elements, which cannot move them out), on this rank's nodes from this rank's facets, as the force:
 *   load[n][dim]             N, of the pressure that such a film has and does not keep
 *   resistance[n][dim][dim]  N s/m, symmetric: what it does against a velocity of the node
 * A body that is free to move gets, beside its velocity, the rigid motion w over the step for which sum resistance w = sum load, forces
 * and moments: CoracleSubstep's u has it, CoracleSetVelocity's has not.  NULL, on all ranks, where no film yields.  Borrowed until
 * CoracleEnd.  A solid that never asks closes such gaps more slowly, the shorter the steps the slower. */
int CoracleGetFilm(CoracleClient c, const double **load, const double **resistance);
/* One substep of h seconds has been made with nodal velocities u[n][dim], m/s: x += h u.  The library computes
 * from the substeps the mean velocity over the step (displacement / dt), and the least-squares line through
 * the velocities, evaluated at the last substep, for couplings that need the velocity at the step's end. */
int CoracleSubstep(CoracleClient c, double h, const double u[]);
/* Optional, between the last substep and CoracleEnd: u[n][dim], m/s, replaces the fitted line's value, from a
 * solid that can separate its motion from its vibration.  For this step only; after CoracleSetNodes where the mesh changes. */
int CoracleSetVelocity(CoracleClient c, const double u[]);
/* Optional, before CoracleReady and where CoracleSetVelocity is: how nodes respond to the fluid's force.
 *   mobility[n]           1/kg, velocity per unit of impulse on the node: one over its mass, all ranks'
 *                         elements together; 0 where it is held and does not respond
 *   acceleration[n][dim]  m/s2, by all forces but the fluid's, gravity included; of a node that the rest of
 *                         its body holds against the fluid this is about minus the fluid's force of the last
 *                         step over the node's mass; where mobility is 0 that of the motion it is held to, in the coming
 *                         step, which then is not asked for again: of a rotation w, w' at the step's end, (w' - w)/dt x r -
 *                         w w' r/2.  All 0 there: not given
 * The coupler then takes the solid's inertia into the fluid's solve: one coupling iteration suffices for
 * solids as dense as the fluid or denser, and lighter ones need few.  Without it, or where mobility is 0, the
 * velocity predicted for the step's end is prescribed to the fluid.  For the next step only. */
int CoracleSetInertia(CoracleClient c, const double mobility[], const double acceleration[]);

/* --- the fluid in a step -------------------------------------------------------------------------------- */

/* What the solid does to one fluid element K (S the solid; i, j vertices; c, d components; in 2D per metre): */
enum {
  CORACLE_HAS_SHELL = 1,   /* K overlaps the shell around the solid's surface */
  CORACLE_HAS_INERTIA = 2, /* implicit_inertia is in use */
  /* K lies in the solid as a whole, which moves freely: the step begins with the solid's velocity there, which s has, and
   * u start counts as 0 in rho M/dt (u* - u start); what CoracleSetFlow gives is the fluid's own all the same */
  CORACLE_IS_COVERED = 4,
  CORACLE_IS_HELD = 8, /* K overlaps nodes without a mobility, which the fluid does not move */
  CORACLE_HAS_CORNER =
      16 /* the surface turns in K, at a corner or where two solids meet: small elements pay there */
};
typedef struct {
  int element; /* index into the elements last given by region */
  int flags;   /* CORACLE_HAS_..., CORACLE_IS_... */
  /* kg/s: int_K a_cd N_i N_j, the implicit coefficient of u*, shell and volume together */
  double a[CORACLE_DIM][CORACLE_VERTICES][CORACLE_DIM][CORACLE_VERTICES];
  /* kg/s: the solid's inertia beyond the fluid's, int_K m N_i N_j, which resists the change of the velocity over the step:
   * implicit_inertia (inertia_tensor u* - kept u start) beside rho M/dt (u* - u start), and under the pressure
   * u projected = u* - dt W^-1 M grad phi with W = rho M/dt + implicit_inertia inertia_tensor */
  double implicit_inertia[CORACLE_VERTICES][CORACLE_VERTICES];
  /* symmetric, positive semidefinite: what of the velocity moves with that inertia: all of it, I, but along the surface beside a fluid
   * that is much lighter than the solid, or of a solid that is held */
  double inertia_tensor[CORACLE_DIM][CORACLE_DIM];
  /* what the inertia keeps of u start: its part along the surface; the rest is the solid's velocity, which s has */
  double kept[CORACLE_DIM][CORACLE_DIM];
  /* N: int_K (a u_s)_c N_i, the explicit part of s_c */
  double s[CORACLE_DIM][CORACLE_VERTICES];
  /* m2: int_{K and S} N_i N_j, sub-cell solid mass, where what is to be free of divergence is the solid's velocity: the bulk velocity is
   * u + M^-1 (us - ms u).  So it is where the solid has no mobility, in one fluid; such elements may have implicit_inertia, too */
  double ms[CORACLE_VERTICES][CORACLE_VERTICES];
  /* m3/s: int_{K and S} N_i (u_s)_c, where ms is not 0 */
  double us[CORACLE_DIM][CORACLE_VERTICES];
  /* m/s: mean over what K overlaps, solid and shell, of the solid's velocity at the start of the step.  A run's first step (t = 0)
   * begins with u += alpha (velocity - u): a body that begins with a velocity has its whole momentum */
  double velocity[CORACLE_DIM];
  double alpha; /* |K and S| / |K|, solid volume fraction */
  double shell; /* |K and shell| / |K|, volume fraction of the covered shell */
} CoracleCoupling;

/* The correction of the step just made, on its overlap: u += M^-1 r with the element's mass matrix M and
 * r[c][i] = int_{K and S} N_i (u_s - u projected)_c, u_s the solid's new velocity; in an element that the solid's
 * surface crosses, of the component along its normal alone. */
typedef struct {
  int element;
  double r[CORACLE_DIM][CORACLE_VERTICES]; /* m3/s */
} CoracleCorrection;

/* A point of the solid's surface that a pressure gauge of the case sits on (fluid.probes[].solid_point). */
typedef struct {
  double x[CORACLE_DIM];      /* m, where the point is now */
  double normal[CORACLE_DIM]; /* unit, out of the solid */
} CoracleGauge;

/* The flow of one step on the n elements last given by region. */
typedef struct {
  const double
      *u_start;         /* [n][dim][dim + 1] m/s, at the start of the step; where a body begins, the body's */
  const double *u_star; /* [n][dim][dim + 1] m/s, with the coupling solved, before the projection */
  const double *u_projected; /* [n][dim][dim + 1] m/s, after it */
  const double *p;   /* [n][6] Pa, on the P2 nodes: vertices, then the midpoints opposite to them; may be
                              * NULL unless CoracleNeedsPressure */
  const double *rho; /* [n] kg/m3 */
  const double *mu;  /* [n] Pa s */
  const double *rho_inside, *rho_beside; /* [n] kg/m3, as in CoracleElements; NULL: rho */
  /* [n][dim] N: the part of weight and pressure on the element that the flow has not been given, so that water at rest stays at rest, and
   * that acts on the solid in it instead (among phases, beside a solid at rest); read where the element overlaps a solid.  NULL: 0 */
  const double *remainder;
} CoracleFlow;

/* Between CoracleBegin and CoracleEnd: waits for the coupling of the step, which the coupler computes meanwhile: call it as
 * late as you can.  Borrowed until the next CoracleEnd. */
int CoracleGetCoupling(CoracleClient c, int *n, const CoracleCoupling **coupling);
/* From CoracleReady on: 1 when the coupling mode, the solid (CoracleSetPressureLoad) or what may touch it uses the pressure, else 0.  A fluid
 * without one must end the job then. */
int CoracleNeedsPressure(CoracleClient c);
/* Between CoracleBegin and CoracleEnd, once a step: the flow (copied). */
int CoracleSetFlow(CoracleClient c, const CoracleFlow *flow);
/* After CoracleEnd: 1 when the step just made is accepted, 0 when it will be redone: there is no correction
 * then, and what it did beside its bound state (an adapted mesh, a row it would write) is void.  A solid
 * learns this by the next action. */
int CoracleStepAccepted(CoracleClient c);
/* After CoracleEnd: one entry for every coupling entry of the step just made (same order, and indices into
 * the elements of that step even when region has been called again since). */
int CoracleGetCorrection(CoracleClient c, int *n, const CoracleCorrection **correction);
/* Optional, from CoracleReady on: the gauges at the end of the step just made (at its start after CoracleReady),
 * one for each entry of fluid.probes with a solid_point, in the list's order, the same on all ranks; of a step
 * that is redone without meaning.  Borrowed until the next CoracleEnd. */
int CoracleGetGauges(CoracleClient c, int *n, const CoracleGauge **gauge);

#ifdef __cplusplus
}
#endif
#endif
