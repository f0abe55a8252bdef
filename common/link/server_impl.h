/* Private to the coupler's end of the link. */
#ifndef CORACLE_SERVER_IMPL_H
#define CORACLE_SERVER_IMPL_H
#include "common/link/fields.h"
#include "common/link/report.h"
#include "common/link/server.h"

/* One client rank that this coupler rank owns. */
typedef struct {
  Message in, out;
  int first, n;             /* its nodes (solid) or elements (fluid) in the concatenated lists */
  int first_start, n_start; /* solid: the same when the step began, which is where a redone step begins */
  FieldLists nodes, facets, elements; /* solid: its mesh as it numbers it */
  bool saved;                         /* the checkpoint that was asked for last */
  Buffer coupled; /* fluid: int [], its own index of the element of each coupling entry last sent */
} ClientRank;

typedef struct {
  int n;
  ClientRank *client; /* [n] in order of client rank */
  int step;           /* the step these clients are in */
  bool stopped;
} ClientList;

struct Server_s {
  Participant *p;
  ClientList fluid, solid;
  bool received_solid, asked, elements_changed, owes_step, owes_coupling, needs_pressure, pressure_load;
  double proposed;
  Buffer rejection; /* why a client cannot make the step that has been received last, or empty */
  Buffer save;      /* path of the checkpoint that is due, or empty */
  /* solid's lists */
  FieldLists motion;
  Buffer gid, facet, element;
  bool kept_start;                              /* the solid's mesh has changed on this rank in the step */
  Buffer start_gid, start_facet, start_element; /* what it was when the step began */
  /* fluid's lists */
  FieldLists elements, flow;
  int nelements;
  FieldsDomain domain;
  Buffer owner;     /* int []: the fluid client of each coupling entry last sent, in the coupler's order */
  Buffer gauge;     /* CoracleGauge [] */
  FieldsForce film; /* of the next force, borrowed; NULL: none */
  Buffer reports[NROLES];
  Buffer spans; /* TraceSpan [], of the clients and this rank; at the end on rank 0 of all */
};

/* The client whose list holds index i. */
int ClientListFind(const ClientList *clients, int i);
/* Sends every client's message and waits until all have gone. */
void ClientListSend(Server s, ClientList *clients);
/* Asks a client for a checkpoint with a message that begins a step: to be called last. */
void ClientListAskSave(Server s, ClientRank *client, CoracleAction action);
/* Takes note of what the flags of a client's message say. */
void ClientListFlags(Server s, Role role, ClientRank *client, const MessageHeader *h);
/* The reason of a client that cannot make its step, if its message, received last, has one; whether it has. */
bool ClientListRejects(Server s, Role role, ClientRank *client);
/* Collective: *changed is or-ed over the coupler's ranks, which all have the reason of one that has one. */
void ServerAgree(Server s, int *changed);
/* Counts a new step when it is one; fails when a client is asked to go on after STOP. */
void ClientListStep(Server s, ClientList *clients, CoracleAction action);
#endif
