/* Every refusal at the start of a job, from made-up ranks. */
#include "common/link/handshake.h"
#include "tests/link/catch.h"

enum { N = 4 };

static void Good(HandshakeEntry e[N])
{
  static const char *const ROLES[N] = {"fluid", "fluid", "coupler", "solid"};
  memset(e, 0, N * sizeof *e);
  for (int i = 0; i < N; i++) {
    strcpy(e[i].role, ROLES[i]);
    strcpy(e[i].version, "0.1.0");
    strcpy(e[i].host, "node1");
    strcpy(e[i].case_path, "a.yaml");
    snprintf(e[i].program, sizeof e[i].program, "/bin/coracle-%s", ROLES[i]);
  }
}

static void Expect(const HandshakeEntry e[N], const char *expected)
{
  char message[HANDSHAKE_MESSAGE] = "";
  const bool good = HandshakeCheck(N, e, message);
  if (expected ? (!good && !strncmp(message, expected, strlen(expected))) : good) return;
  fprintf(stderr, "expected '%s'\n     got '%s'\n", expected ? expected : "(joined)", message);
  exit(1);
}

int main(void)
{
  HandshakeEntry e[N];
  char message[HANDSHAKE_MESSAGE];
  Good(e);
  Expect(e, NULL);
  CHECK(!HandshakeNote(N, e, message));
  e[1].context = 2; /* the same program in two parts of the command line is one participant */
  Expect(e, NULL);
  CHECK(HandshakeNote(N, e, message));
  e[1].argument_hash = 1; /* ... unless started differently */
  Expect(e, "the fluid has been started twice: the arguments of fluid rank 1 (on node1) differ");
  Good(e);
  strcpy(e[1].program, "/other/coracle-fluid");
  Expect(e, "two programs want to be the fluid: fluid rank 0 (on node1) is /bin/coracle-fluid, fluid rank 1");
  strcpy(e[1].host, "node2"); /* folders may differ between computers */
  Expect(e, NULL);
  strcpy(e[1].program, "/other/my-fluid");
  Expect(e, "two programs want to be the fluid");
  Good(e);
  strcpy(e[3].role, "solids");
  Expect(e,
         "'solids' is no role: expected fluid, coupler or solid (world rank 3, /bin/coracle-solid on node1)");
  Good(e);
  strcpy(e[2].role, "solid");
  Expect(e, "there is no coupler among the 4 ranks of this job");
  Good(e);
  strcpy(e[3].version, "9");
  Expect(e, "different versions: solid rank 0 (on node1) has 9, fluid rank 0 (on node1) has 0.1.0");
  Good(e);
  e[1].file_hash = 5;
  Expect(e,
         "different case files: fluid rank 1 (on node1) has 'a.yaml', fluid rank 0 (on node1) has 'a.yaml'");
  Good(e);
  for (int i = 1; i < N; i++) e[i].file_hash = 5; /* the odd one is the first */
  Expect(e, "different case files: fluid rank 0 (on node1) has");
  Good(e);
  e[2].set_hash = 5;
  Expect(e, "different settings: the --set arguments of coupler rank 0 (on node1) differ from those of fluid "
            "rank 0");
  Good(e);
  strcpy(e[1].problem, "case file 'a.yaml': No such file");
  Expect(e, "case file 'a.yaml': No such file, says fluid rank 1 (on node1)");
  return 0;
}
