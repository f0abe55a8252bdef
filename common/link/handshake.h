/* Who has come to the job, and whether they can run together.  Pure: no MPI, so that every refusal can be
 * tested. */
#ifndef CORACLE_HANDSHAKE_H
#define CORACLE_HANDSHAKE_H
#include "common/link/case_impl.h"

typedef enum { ROLE_FLUID, ROLE_COUPLER, ROLE_SOLID, NROLES, ROLE_ANY = NROLES } Role;
extern const char *const ROLE_NAMES[NROLES];

enum { HANDSHAKE_MESSAGE = 2048 };

/* What each rank of MPI_COMM_WORLD says of itself. */
typedef struct {
  char role[32], version[32], host[64]; /* are first in every version, so that any two can compare them */
  char program[256], case_path[256];    /* /proc/self/exe, the case file as given */
  char problem[CASE_MESSAGE];           /* why this rank cannot join at all, or "" */
  unsigned long long file_hash, set_hash, argument_hash;
  int context; /* MPI_APPNUM, -1 when the launcher does not say: a hint for messages alone */
} HandshakeEntry;

/* Index of the role, or -1. */
int HandshakeRole(const char *role);
/* entry[n] in order of world rank.  False: message[HANDSHAKE_MESSAGE] names the odd one out.
 * Two programs of one role are refused when they are different executables or have different arguments. */
bool HandshakeCheck(int n, const HandshakeEntry entry[], char message[]);
/* "the fluid's 2 ranks come from 2 parts of the command line" when the contexts hint at it; else false. */
bool HandshakeNote(int n, const HandshakeEntry entry[], char message[]);
#endif
