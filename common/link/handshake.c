#include "common/link/handshake.h"
#include <stdio.h>
#include <string.h>

const char *const ROLE_NAMES[NROLES] = {"fluid", "coupler", "solid"};

int HandshakeRole(const char *role)
{
  for (int k = 0; k < NROLES; k++)
    if (!strcmp(role, ROLE_NAMES[k])) return k;
  return -1;
}

/* "solid rank 1 (on node7)" */
static const char *Who(const HandshakeEntry entry[], int i, char who[160])
{
  int rank = 0;
  for (int k = 0; k < i; k++) rank += !strcmp(entry[k].role, entry[i].role);
  snprintf(who, 160, "%.31s rank %d (on %.63s)", entry[i].role, rank, entry[i].host);
  return who;
}

typedef bool (*SameFunction)(const HandshakeEntry *a, const HandshakeEntry *b);

static bool SameVersion(const HandshakeEntry *a, const HandshakeEntry *b)
{
  return !strcmp(a->version, b->version);
}
static bool SameFile(const HandshakeEntry *a, const HandshakeEntry *b)
{
  return a->file_hash == b->file_hash;
}
static bool SameSets(const HandshakeEntry *a, const HandshakeEntry *b)
{
  return a->set_hash == b->set_hash;
}

/* Finds a rank of the majority (by voting: a candidate gains a vote from its like and loses one to others)
 * and the first rank that differs from it. */
static bool AllSame(int n, const HandshakeEntry entry[], SameFunction same, int *odd, int *most)
{
  int votes = 0;
  *most = 0;
  for (int i = 0; i < n; i++) {
    if (votes == 0) *most = i;
    votes += same(&entry[*most], &entry[i]) ? 1 : -1;
  }
  if (votes <= 0) *most = 0;
  for (int i = *most; i >= 0; i--)
    if (same(&entry[*most], &entry[i])) *most = i;
  for (*odd = 0; *odd < n; ++*odd)
    if (!same(&entry[*most], &entry[*odd])) return false;
  return true;
}

static bool CheckPresent(int n, const HandshakeEntry entry[], char message[])
{
  int count[NROLES] = {0};
  char who[160];
  for (int i = 0; i < n; i++) {
    const int role = HandshakeRole(entry[i].role);
    if (role < 0) {
      snprintf(message, HANDSHAKE_MESSAGE,
               "'%s' is no role: expected fluid, coupler or solid (world rank %d, %s on %s)", entry[i].role,
               i, entry[i].program, entry[i].host);
      return false;
    }
    if (entry[i].problem[0]) {
      snprintf(message, HANDSHAKE_MESSAGE, "%s, says %s", entry[i].problem, Who(entry, i, who));
      return false;
    }
    count[role]++;
  }
  for (int k = 0; k < NROLES; k++) {
    if (count[k]) continue;
    snprintf(message, HANDSHAKE_MESSAGE,
             "there is no %s among the %d ranks of this job: start all three programs in one mpirun, as in "
             "mpirun -n 1 coracle-fluid CASE : -n 1 coracle-coupler CASE : -n 1 coracle-solid CASE",
             ROLE_NAMES[k], n);
    return false;
  }
  return true;
}

static bool CheckSame(int n, const HandshakeEntry entry[], char message[])
{
  char a[160], b[160];
  int odd, most;
  if (!AllSame(n, entry, SameVersion, &odd, &most)) {
    snprintf(
        message, HANDSHAKE_MESSAGE,
        "different versions: %s has %s, %s has %s: build the older one again with the other's client library "
        "(%s, %s)",
        Who(entry, odd, a), entry[odd].version, Who(entry, most, b), entry[most].version, entry[odd].program,
        entry[most].program);
    return false;
  }
  if (!AllSame(n, entry, SameFile, &odd, &most)) {
    snprintf(message, HANDSHAKE_MESSAGE,
             "different case files: %s has '%s', %s has '%s', and their contents differ", Who(entry, odd, a),
             entry[odd].case_path, Who(entry, most, b), entry[most].case_path);
    return false;
  }
  if (!AllSame(n, entry, SameSets, &odd, &most)) {
    snprintf(message, HANDSHAKE_MESSAGE,
             "different settings: the --set arguments of %s differ from those of %s (give the same to all "
             "programs)",
             Who(entry, odd, a), Who(entry, most, b));
    return false;
  }
  return true;
}

/* The same file on one host; on different hosts, where folders may differ, the same name. */
static bool SameProgram(const HandshakeEntry *a, const HandshakeEntry *b)
{
  const char *x = strrchr(a->program, '/'), *y = strrchr(b->program, '/');
  if (!strcmp(a->host, b->host)) return !strcmp(a->program, b->program);
  return !strcmp(x ? x : a->program, y ? y : b->program);
}

static bool CheckPrograms(int n, const HandshakeEntry entry[], char message[])
{
  int first[NROLES] = {-1, -1, -1};
  char a[160], b[160];
  for (int i = 0; i < n; i++) {
    const int role = HandshakeRole(entry[i].role), k = first[role];
    if (k < 0) {
      first[role] = i;
    } else if (!SameProgram(&entry[k], &entry[i])) {
      snprintf(message, HANDSHAKE_MESSAGE, "two programs want to be the %s: %s is %s, %s is %s",
               ROLE_NAMES[role], Who(entry, k, a), entry[k].program, Who(entry, i, b), entry[i].program);
      return false;
    } else if (entry[k].argument_hash != entry[i].argument_hash) {
      snprintf(message, HANDSHAKE_MESSAGE,
               "the %s has been started twice: the arguments of %s differ from those of %s", ROLE_NAMES[role],
               Who(entry, i, a), Who(entry, k, b));
      return false;
    }
  }
  return true;
}

bool HandshakeCheck(int n, const HandshakeEntry entry[], char message[])
{
  return CheckPresent(n, entry, message) && CheckSame(n, entry, message) && CheckPrograms(n, entry, message);
}

bool HandshakeNote(int n, const HandshakeEntry entry[], char message[])
{
  for (int k = 0; k < NROLES; k++) {
    int first = -1, ranks = 0, parts = 0;
    for (int i = 0; i < n; i++) {
      if (HandshakeRole(entry[i].role) != k) continue;
      bool known = false;
      for (int j = 0; j < i && !known; j++)
        known = HandshakeRole(entry[j].role) == k && entry[j].context == entry[i].context;
      if (first < 0) first = i;
      parts += !known;
      ranks++;
    }
    if (parts < 2) continue;
    snprintf(message, HANDSHAKE_MESSAGE,
             "the %s comes from %d parts of the command line; they run as one %s of %d ranks", ROLE_NAMES[k],
             parts, ROLE_NAMES[k], ranks);
    return true;
  }
  return false;
}
