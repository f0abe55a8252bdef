/* The coupler's end of the link (coracle.h is the other end).
 *
 *     fluid rank    0   1   2   3           0 1       solid rank
 *                   |   |   |   |           | |
 *     coupler rank  0   1   0   1           0 1       owner of client rank r: r % size
 *
 * A client rank exchanges messages with its owner and with nobody else.  What a coupler rank receives from its
 * clients is handed out as one concatenated list in order of client rank, with indices already shifted.
 * Everything is collective over the coupler.  Errors end the job.  All arrays handed out are borrowed until
 * the next call of the same function. */
#ifndef CORACLE_SERVER_H
#define CORACLE_SERVER_H
#include "common/link/coracle.h"

typedef struct Server_s *Server;

typedef struct {
  int changed; /* nodes, facets or elements were given anew (in this call) */
  int lost;    /* within a step, and so that it cannot be said what has become of the nodes of its start */
  /* changed on this rank within a step and not lost: the elements in the nodes that this rank had when the step began,
   * [nelements][3]; else NULL */
  const int *before;
  int pressure_load;              /* CoracleSetPressureLoad was called, the same on all coupler ranks */
  int nnodes, nfacets, nelements; /* on this coupler rank */
  const long long *gid;           /* [nnodes] */
  const double *x;                /* [nnodes][2] position, m */
  const double *u, *mean; /* [nnodes][2] velocity, m/s, over the last step: fitted to its end, and the mean;
                             both initial at first */
  const double *mobility, *acceleration; /* [nnodes] 1/kg, [nnodes][2] m/s2: of CoracleSetInertia, else 0 */
  const int *facet, *element; /* [nfacets][2], [nelements][3] indices into the nodes of this rank */
} ServerSolid;

typedef struct {
  int n;                                 /* the elements of this coupler rank's clients */
  const double *x;                       /* [n][3][2] vertices, m */
  const double *rho, *mu;                /* [n] kg/m3, Pa s: at the start of the coming step */
  const double *rho_inside, *rho_beside; /* [n] kg/m3, as in CoracleElements, never NULL */
  double lower[2], upper[2];             /* the fluid's whole domain, m */
} ServerElements;

/* Joins as "coupler"; as CoracleOpen. */
int ServerOpen(int argc, char **argv, MPI_Comm *app_comm, Server *s);
/* As CoracleOpenComm. */
int ServerOpenComm(MPI_Comm job, int argc, char **argv, MPI_Comm *app_comm, Server *s);
CORACLE_NORETURN void ServerFail(Server s, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The solid's mesh (first call, matches CoracleReady) or its motion (matches CoracleEnd). */
int ServerReceiveSolid(Server s, ServerSolid *solid);
/* Before the first ServerAskElements: the coupling mode or the solid's load uses the fluid's pressure (the same on all coupler
 * ranks); without this call it does not travel. */
int ServerNeedPressure(Server s);
/* Asks the fluid for its elements in the boxes: box[nbox][2][2], the same on all coupler ranks (matches the
 * region callback within CoracleReady or CoracleEnd; may be asked only there). */
int ServerAskElements(Server s, int nbox, const double box[], ServerElements *elements);
/* True when a fluid rank said CoracleElementsChanged with its last flow: the elements must be asked for
 * again. */
int ServerElementsChanged(Server s);
/* The smallest step that the fluid's ranks proposed last, s; the same on all coupler ranks. */
double ServerProposedStep(Server s);
/* Ends the fluid's CoracleReady or CoracleEnd.  correction[ncorrection] has one entry per coupling entry
 * of the step just made, in its order (0 at the first call or when stopping is not after a step, and as you
 * like at CORACLE_REDO). */
int ServerSendStep(Server s, double t, double dt, CoracleAction action, int ncorrection,
                   const CoracleCorrection correction[]);
/* After that, unless the action was CORACLE_STOP: the coupling of the step; matches CoracleGetCoupling.  `element` indexes
 * ServerElements. */
int ServerSendCoupling(Server s, int n, const CoracleCoupling coupling[]);
/* The gauges on the solid that the next steps carry, the same on all coupler ranks (copied); none before the
 * first call. */
int ServerSetGauges(Server s, int n, const CoracleGauge gauge[]);
/* Matches the first half of the fluid's CoracleEnd. */
int ServerReceiveFlow(Server s, CoracleFlow *flow);
/* After ServerReceiveFlow and ServerReceiveSolid of a step: NULL, or, the same on all coupler ranks, which client cannot make it, and why
 * (CoracleRejectStep): what was received is nothing then, and the step is to be redone by those who have begun it.  Borrowed until the
 * next of these two. */
const char *ServerRejection(Server s);
/* The films of the next ServerSendForce (CoracleGetFilm): load[nnodes][2], N, resistance[nnodes][2][2], N s/m, on its nodes, borrowed until then;
 * all coupler ranks call it or none does. */
int ServerSetFilm(Server s, const double load[], const double resistance[]);
/* Ends the solid's CoracleBegin: force[nnodes][2], N, on the nodes last received; at CORACLE_REDO on those of
 * the step's start, which differ when the solid has changed its mesh in the step. */
int ServerSendForce(Server s, double t, double dt, CoracleAction action, const double force[]);

/* The folder of the checkpoint that the run resumes from, or NULL; a client that does not is refused. */
const char *ServerResumePath(Server s);
/* Has all clients save into the folder (the same on all coupler ranks; copied) as the coming step begins,
 * before that is sent. */
int ServerSave(Server s, const char *folder);
/* After that step: NULL when all have saved, else a role that has not. */
const char *ServerUnsaved(Server s);

/* Waits for every client to close; then the reports.  ServerReports calls f(context, role, key, value) on
 * coupler rank 0. */
int ServerFinish(Server s);
int ServerReports(Server s, void (*f)(void *context, const char *role, const char *key, double value),
                  void *context);
/* After ServerFinish: what all ranks of the job did when, if the case asks for it (output.trace; trace.h). */
int ServerWriteTrace(Server s, const char *path);
/* Local: as CoraclePhase. */
int ServerPhase(Server s, const char *name);
/* Number of ranks of a role in the job. */
int ServerRanks(Server s, const char *role);
/* Seconds this rank has spent waiting for messages. */
double ServerWaited(Server s);
/* Of it for messages of a role: "fluid", "solid". */
double ServerWaitedFor(Server s, const char *role);
/* Local: seconds since this rank has joined. */
double ServerWall(Server s);
/* Local: 1 when this rank has no processor of its own, else 0. */
int ServerSharesProcessors(Server s);
int ServerClose(Server *s);
#endif
