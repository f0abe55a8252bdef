/* Private to the client's end of the link. */
#ifndef CORACLE_CLIENT_IMPL_H
#define CORACLE_CLIENT_IMPL_H
#include "common/link/fields.h"
#include "common/link/report.h"

enum { DIM = CORACLE_DIM };

/* Where a client is in the run; every function says when it may be called. */
typedef enum {
  STAGE_SETUP,   /* before CoracleReady */
  STAGE_BETWEEN, /* before CoracleBegin */
  STAGE_STEP,    /* between CoracleBegin and CoracleEnd */
  STAGE_STOPPED  /* CORACLE_STOP was received */
} Stage;

typedef struct {
  int n, nfacets, nelements;
  Buffer gid, x, u;      /* long long [n], double [n][2], double [n][2]: velocity given with the nodes, m/s */
  Buffer start;          /* double [n][2]: positions when the step began, m */
  Buffer sums;           /* double [n][2][2] over the substeps so far: of h u, m, and of h tau u, m s */
  Buffer facet, element; /* int [nfacets][2], int [nelements][3] */
} SolidMesh;

typedef struct {
  SolidMesh mesh, before; /* before: as it was when the step began, if it has changed since */
  bool has_nodes, has_before;
  bool changed; /* the coupler has not seen this mesh yet */
  /* substeps of the step so far, each h long with its middle at tau after the step's start, s */
  double elapsed, first, second, last; /* sums of h, h tau, h tau^2; tau of the last one */
  Buffer velocity;                     /* double [2][n][2]: fitted or given, mean, m/s */
  Buffer given;                        /* double [n][2], of CoracleSetVelocity; m/s */
  bool has_given;
  Buffer inertia; /* double [3][n], of CoracleSetInertia: mobility, 1/kg; acceleration [n][2], m/s2 */
  bool has_inertia;
  bool pressure_load;
  bool has_film;    /* of the step */
  FieldLists force; /* force, film load, film resistance */
} ClientSolid;

typedef struct {
  FieldsDomain domain;
  double proposed; /* s */
  CoracleRegionFunction region;
  void *context;
  int nbox; /* boxes of CoracleGetRegion that have not been answered; they are in the message received last */
  const double *box;
  int n; /* elements last given by region */
  bool asked, needs_pressure, changed, flow_set;
  bool awaits_coupling; /* of the step that the coupler has announced */
  int ncoupling, ncorrection;
  int ngauges;
  Buffer coupling, correction, gauge, zeros;
} ClientFluid;

typedef struct {
  void *state;  /* the solver's memory ... */
  Buffer saved; /* ... and its copy */
  int (*f)(void *context, int save);
  void *context;
} BoundState;

struct CoracleClient_s {
  Participant *p;
  Message in, out; /* from and to the coupler rank that owns this one */
  Stage stage;
  Buffer save;      /* path of the checkpoint due in this step, or empty */
  Buffer rejection; /* why the step cannot be made, or empty */
  bool asked_save, asked_resume;
  double t, dt; /* of the step, s */
  CoracleAction action;
  ClientSolid solid;
  ClientFluid fluid;
  Buffer states;  /* BoundState[] */
  Buffer reports; /* Report[] */
};

static inline double *Doubles(const Buffer *b)
{
  return (double *)(void *)b->data;
}
static inline int *Ints(const Buffer *b)
{
  return (int *)(void *)b->data;
}
static inline long long *Ids(const Buffer *b)
{
  return (long long *)(void *)b->data;
}

/* Fails if the client is NULL. */
void ClientMustBe(CoracleClient c, const char *function);
/* Fails unless the client has this role, or ROLE_ANY is meant, and the stage is one of two. */
void ClientExpect(CoracleClient c, const char *function, Role role, Stage stage, Stage other);
/* Fails if an array of n > 0 entries is NULL. */
void ClientGiven(CoracleClient c, const char *function, const char *name, const void *array, int n);
_Noreturn void ClientMisuse(CoracleClient c, const char *function, const char *why);

/* Sends c->out and waits until it has gone. */
void ClientSend(CoracleClient c);
/* Writes a message that has, in place of its blocks, why the step cannot be made; returns its header. */
MessageHeader *ClientReject(CoracleClient c, MessageKind kind);
/* Takes t, dt and action of the coming step from the coupler; checks that they make sense. */
void ClientTakeStep(CoracleClient c, const MessageHeader *h);

/* Takes the folder of a checkpoint, the next block, if there is one. */
void ClientTakePath(CoracleClient c, const MessageHeader *h);
/* FLAG_SAVED and FLAG_RESUMES as they are now. */
int ClientFlags(CoracleClient c);

void StateSave(CoracleClient c); /* and into the checkpoint that is due */
/* Whether all state is in bound buffers: then the library saves it and puts it back without being asked. */
bool StateIsBuffers(CoracleClient c);
void StateRestore(CoracleClient c);
void StateFree(CoracleClient c);

/* client_check.c.  Local: node indices, unique ids, positive areas; x[n][2]: present positions. */
void CheckMesh(CoracleClient c, const double x[]);
/* Collective over the solid: no element or facet twice, and the surface is the volume's boundary, as it
 * is before there are cracks. */
void CheckSurface(CoracleClient c);

void SolidReady(CoracleClient c);
void SolidBegin(CoracleClient c); /* waits for the force */
void SolidEnd(CoracleClient c, const double x[]);
void SolidMeshFree(SolidMesh *mesh);
/* [n] pointers to the ids, in the ids' order; the caller frees them. */
const long long **SolidMeshSortIds(const SolidMesh *mesh);
void SolidFree(CoracleClient c);

void FluidReady(CoracleClient c);
void FluidEnd(CoracleClient c); /* waits for the coming step */
void FluidFree(CoracleClient c);
#endif
