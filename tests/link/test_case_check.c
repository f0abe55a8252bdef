/* A check finds all faults of a case at once, and the list of keys says what their readers said. */
#include "tests/link/catch.h"
#include <math.h>

static const char *const SECTIONS[] = {"fluid", "solid", NULL};
static const char *const WORDS[] = {"no_slip", "free_slip", NULL};
static const CaseKey KEYS[] = {{"fluid.density", "kg/m3", "density of the fluid"},
                               {"solid.bodies[].radius", "m", "radius of a disc"},
                               {"solid.materials.*.damping", "", "part of the critical damping"},
                               {NULL, NULL, NULL}};

static void Material(void *c, const char *name)
{
  char key[256];
  snprintf(key, sizeof key, "solid.materials.%s.damping", name);
  CaseNumberOr(c, key, 0.0, 0.0, 1.0);
}

static void Read(Case c, void *context)
{
  double v[2];
  char key[64];
  CaseDescribe(c, KEYS);
  CaseRenamed(c, "fluid.rho", "fluid.density");
  CasePositive(c, "fluid.density");
  CaseNumberOr(c, "fluid.theta", 0.5, 0.5, 1.0);
  CaseIntegerOr(c, "fluid.steps", 1, 1, 10);
  CaseBoolOr(c, "fluid.adapt", false);
  CaseWord(c, "fluid.left", -1, WORDS);
  CaseVector(c, "fluid.upper", 2, v);
  CaseString(c, "fluid.name");
  for (int k = 0; k < CaseCount(c, "solid.bodies"); k++) {
    snprintf(key, sizeof key, "solid.bodies[%d].radius", k);
    if (CasePositive(c, key) > 10.0) CaseRefuse(c, key, "too large");
  }
  CaseKeys(c, "solid.materials", Material, c);
  CaseFinish(c, SECTIONS);
}

typedef struct {
  int n;
  char message[32][512];
} Told;

static void Tell(void *context, const char *message)
{
  Told *told = context;
  const char *colon = strchr(message, ':'); /* without the file's name */
  snprintf(told->message[told->n++], 512, "%s", colon ? colon : message);
}

static void Faults(int argc, char **argv)
{
  static const char *const EXPECTED[] = {
      ":2: key 'fluid.rho' is now called 'fluid.density'",
      ":3: key 'fluid.density': expected a number > 0, found '-3'",
      ":4: key 'fluid.theta': expected a number from 0.5 to 1, found '2'",
      ":5: key 'fluid.steps': expected an integer from 1 to 10, found '0'",
      ":6: key 'fluid.adapt': expected true or false, found 'maybe'",
      ":7: key 'fluid.left': expected one of no_slip, free_slip, found 'slip'",
      ":8: key 'fluid.upper' is missing (is it 'uper' here?)",
      ":9: key 'fluid.name': expected a string, found 'null'",
      ":12: key 'solid.bodies[0].radius': too large",
      ":14: key 'solid.bodies[2].radius': expected a number > 0, found '0'",
      ":16: key 'solid.materials.stone.damping': expected a number from 0 to 1, found '7'",
      ":17: unknown section 'fluidd' (did you mean 'fluid'?)",
      ":8: unknown key 'fluid.uper' (did you mean 'upper'?)",
      ":10: unknown key 'fluid.colour'",
      ":14: unknown key 'solid.bodies[2].size'"};
  enum { N = sizeof EXPECTED / sizeof *EXPECTED };
  static Told told;
  const int n = CaseCheck(argc, argv, Read, &told, Tell);
  for (int k = 0; k < N || k < n; k++) {
    if (k < N && k < n && !strcmp(told.message[k], EXPECTED[k])) continue;
    fprintf(stderr, "expected '%s'\n     got '%s'\n", k < N ? EXPECTED[k] : "(no more)",
            k < n ? told.message[k] : "(no more)");
    exit(1);
  }
}

static void Failed(void *context, const char *message)
{
  fprintf(stderr, "%s\n", message);
  exit(1);
}

static void List(int argc, char **argv)
{
  static const char EXPECTED[] =
      "fluid.density\trequired\tnumber\t> 0\t\tkg/m3\tdensity of the fluid\n"
      "fluid.theta\toptional\tnumber\tfrom 0.5 to 1\t0.5\t\t\n"
      "fluid.steps\toptional\tinteger\tfrom 1 to 10\t1\t\t\n"
      "fluid.adapt\toptional\ttrue or false\t\tfalse\t\t\n"
      "fluid.left\trequired\tword\tno_slip, free_slip\t\t\t\n"
      "fluid.upper\trequired\tlist of 2 numbers\t\t\t\t\n"
      "fluid.name\trequired\tstring\t\t\t\t\n"
      "solid.bodies\toptional\tlist\t\t\t\t\n"
      "solid.bodies[].radius\trequired\tnumber\t> 0\t\tm\tradius of a disc\n"
      "solid.materials.*.damping\toptional\tnumber\tfrom 0 to 1\t0\t\tpart of the critical damping\n";
  char *text;
  size_t size;
  FILE *out = open_memstream(&text, &size);
  CaseKeysOf(argc, argv, Read, NULL, Failed, out);
  fclose(out);
  if (strcmp(text, EXPECTED)) {
    fprintf(stderr, "expected\n%s\ngot\n%s\n", EXPECTED, text);
    exit(1);
  }
  free(text);
}

static void OnFile(const char *text, void (*f)(int argc, char **argv))
{
  char path[] = "/tmp/coracle-case-XXXXXX", *argv[] = {(char *)"test", path};
  const int file = mkstemp(path);
  if (file < 0 || write(file, text, strlen(text)) < 0) exit(2);
  close(file);
  f(2, argv);
  unlink(path);
}

int main(void)
{
  OnFile("fluid:\n  rho: 3\n  density: -3\n  theta: 2\n  steps: 0\n  adapt: maybe\n  left: slip\n  uper: [1, "
         "2]\n"
         "  name: null\n  colour: red\nsolid:\n  bodies: [{radius: 11},\n    {radius: 1},\n    {radius: 0, "
         "size: 3}]\n"
         "  materials:\n    stone: {damping: 7}\nfluidd: {}\n",
         Faults);
  OnFile("fluid: {density: 1, left: no_slip, upper: [1, 2], name: a}\n"
         "solid: {bodies: [{radius: 1}], materials: {stone: {damping: 0.5}}}\n",
         List);
  return 0;
}
