/* What a bad case file is told: the exact message, with file, line and key. */
#include "tests/link/catch.h"
#include <math.h>

static const char *const FLUID[] = {"fluid", NULL};
static const char *const WORDS[] = {"no_slip", "free_slip", NULL};

static void Nothing(CoracleCase c)
{
  (void)c;
}
static void Finish(CoracleCase c)
{
  CoracleCaseFinish(c, FLUID);
}
static void Density(CoracleCase c)
{
  CoracleCasePositive(c, "fluid.density");
}
static void DensityFinish(CoracleCase c)
{
  CoracleCasePositive(c, "fluid.density");
  CoracleCaseFinish(c, FLUID);
}
static void OptionalFinish(CoracleCase c)
{
  CoracleCaseNumberOr(c, "fluid.viscosity", 1.0, 0.0, HUGE_VAL);
  CoracleCaseCount(c, "fluid.refine");
  DensityFinish(c);
}
static void Theta(CoracleCase c)
{
  CoracleCaseNumberOr(c, "fluid.theta", 0.5, 0.5, 1.0);
}
static void Steps(CoracleCase c)
{
  CoracleCaseIntegerOr(c, "fluid.steps", 1, 1, 10);
}
static void Adapt(CoracleCase c)
{
  CoracleCaseBoolOr(c, "fluid.adapt", false);
}
static void Left(CoracleCase c)
{
  CoracleCaseWord(c, "fluid.left", -1, WORDS);
}
static void Refuse(CoracleCase c)
{
  CoracleCaseRefuse(c, "fluid.left", "no such boundary as %s", "left");
}
static void Vector(CoracleCase c)
{
  double v[2];
  CoracleCaseVector(c, "fluid.v", 2, v);
}
static void Ignore(void *context, const char *name) {}
static void Keys(CoracleCase c)
{
  CoracleCaseKeys(c, "fluid.v", Ignore, NULL);
}
static void Bodies(CoracleCase c)
{
  CoracleCaseNumber(c, "fluid.bodies[1].radius", 0.0, HUGE_VAL);
}

static void Folder(CoracleCase c)
{
  CoracleCaseString(c, "output.folder");
}
static void Renamed(CoracleCase c)
{
  CoracleCaseRenamed(c, "fluid.tries", "fluid.max_iterations");
}

static void NotBoth(CoracleCase c)
{
  static const char *const OTHERS[] = {"density", "viscosity", NULL};
  CoracleCaseNotBeside(c, "fluid", "phases", OTHERS);
}

/* Large files are read or refused in a time that grows with their size, not with its square. */
static void Large(void)
{
  enum { N = 200000 };
  static char text[32 * N];
  size_t n = (size_t)sprintf(text, "fluid:\n");
  for (int k = 0; k < N; k++) n += (size_t)sprintf(text + n, "  key_%d: %d\n", k, k);
  alarm(60);
  CheckCase(text, NULL, Nothing, NULL);
  CheckCase(text, NULL, DensityFinish, ":1: key 'fluid.density' is missing");
  n = (size_t)sprintf(text, "fluid: ");
  memset(text + n, '[', N);
  memset(text + n + N, ']', N);
  strcpy(text + n + 2 * (size_t)N, "\n");
  CheckCase(text, NULL, Nothing, ":1: nested more than 32 deep");
  memset(text + n, '{', N);
  strcpy(text + n + (size_t)N, "\n");
  CheckCase(text, NULL, Nothing, ":1: nested more than 32 deep");
  alarm(0);
}

static void Syntax(void)
{
  CheckCase("solid:\n  a.b: 1\n", NULL, Nothing,
            ":2: key 'a.b' cannot be told in a path: expected 1 to 127 characters without '.', '[' and ']'");
  CheckCase("solid:\n  'a[0]': 1\n", NULL, Nothing,
            ":2: key 'a[0]' cannot be told in a path: expected 1 to 127 characters without '.', '[' and ']'");
  CheckCase("output:\n  folder: null\n", NULL, Folder,
            ":2: key 'output.folder': expected a string, found 'null'");
  CheckCase("output: {folder: ~}\n", NULL, Folder, ":1: key 'output.folder': expected a string, found '~'");
  CheckCase("output: {folder: 'null'}\n", NULL, Folder, NULL);
  CheckCase("fluid:\n  tries: 3\n", NULL, Renamed,
            ":2: key 'fluid.tries' is now called 'fluid.max_iterations'");
  CheckCase("fluid:\n  max_iterations: 3\n", NULL, Renamed, NULL);
  CheckCase("fluid:\n  viscosity: 3\n  phases: []\n", NULL, NotBoth,
            ":2: key 'fluid.viscosity': expected phases or viscosity, not both");
  CheckCase("fluid:\n  density: 3\n", NULL, NotBoth, NULL);
  CheckCase("", NULL, Nothing, ": is empty");
  CheckCase("- a\n- b\n", NULL, Nothing, ":1: expected sections (key: ...) at the top level");
  CheckCase("fluid:\n  a: 1\n  a: 2\n", NULL, Nothing, ":3: key 'a' is given twice (first in line 2)");
  CheckCase("fluid:\n  ? [x]\n  : 1\n", NULL, Nothing, ":2: a key must be a word");
  CheckCase("fluid: 1\n---\nsolid: 2\n", NULL, Nothing, ": holds more than one YAML document");
  CheckCase("fluid:\n  a: [1, 2\nsolid: 3\n", NULL, Nothing,
            ":3: not valid YAML: did not find expected ',' or ']' while parsing a flow sequence");
  CheckCase("a: &x\n  b: *x\n", NULL, Nothing, ":1: nested too deeply (an alias within itself?)");
}

static void Values(void)
{
  CheckCase("fluid:\n  density: -3\n", NULL, Density,
            ":2: key 'fluid.density': expected a number > 0, found '-3'");
  CheckCase("fluid:\n  density: 0\n", NULL, Density,
            ":2: key 'fluid.density': expected a number > 0, found '0'");
  CheckCase("fluid:\n  density: nan\n", NULL, Density,
            ":2: key 'fluid.density': expected a number > 0, found 'nan'");
  CheckCase("fluid:\n  density: 0x10\n", NULL, Density,
            ":2: key 'fluid.density': expected a number > 0, found '0x10'");
  CheckCase("fluid:\n  density: 1e999\n", NULL, Density,
            ":2: key 'fluid.density': expected a number > 0, found '1e999'");
  CheckCase("fluid:\n  density: '3'\n", NULL, Density,
            ":2: key 'fluid.density': expected a number > 0, found the string '3'");
  CheckCase("fluid:\n  density:\n", NULL, Density,
            ":2: key 'fluid.density': expected a number > 0, found nothing");
  CheckCase("fluid:\n  density: [1]\n", NULL, Density,
            ":2: key 'fluid.density': expected a number > 0, found a list of 1");
  CheckCase("fluid:\n  theta: 0.4\n", NULL, Theta,
            ":2: key 'fluid.theta': expected a number from 0.5 to 1, found '0.4'");
  CheckCase("fluid:\n  steps: 2.5\n", NULL, Steps,
            ":2: key 'fluid.steps': expected an integer from 1 to 10, found '2.5'");
  CheckCase("fluid:\n  steps: 11\n", NULL, Steps,
            ":2: key 'fluid.steps': expected an integer from 1 to 10, found '11'");
  CheckCase("fluid:\n  adapt: yes\n", NULL, Adapt,
            ":2: key 'fluid.adapt': expected true or false, found 'yes'");
  CheckCase("fluid:\n\n  left: slip\n", NULL, Left,
            ":3: key 'fluid.left': expected one of no_slip, free_slip, found 'slip'");
  CheckCase("fluid:\n  left: x\n", NULL, Refuse, ":2: key 'fluid.left': no such boundary as left");
  CheckCase("fluid:\n  v: [1, 2, 3]\n", NULL, Vector,
            ":2: key 'fluid.v': expected a list of 2 numbers, found a list of 3");
  CheckCase("fluid:\n  v:\n    - 1\n    - b\n", NULL, Vector,
            ":4: key 'fluid.v': expected a list of 2 numbers, found 'b'");
  CheckCase("fluid:\n  v: 1\n", NULL, Keys, ":2: key 'fluid.v': expected a map (key: ...), found '1'");
}

static void UnknownKeys(void)
{
  CheckCase("fluid:\n  densty: 3\n", NULL, Density,
            ":2: key 'fluid.density' is missing (is it 'densty' here?)");
  CheckCase("fluid:\n  a: 3\n", NULL, Density, ":1: key 'fluid.density' is missing");
  CheckCase("fluid:\n  bodies:\n    - {radius: 1}\n", NULL, Bodies,
            ":2: key 'fluid.bodies[1].radius' is missing");
  CheckCase("fluid:\n  density: 1\n  viscocity: 3\n", NULL, OptionalFinish,
            ":3: unknown key 'fluid.viscocity' (did you mean 'viscosity'?)");
  CheckCase("fluid:\n  density: 1\n  colour: 3\n", NULL, OptionalFinish, ":3: unknown key 'fluid.colour'");
  CheckCase("fluid:\n  density: 1\n  refine:\n    - {size: 3}\n", NULL, OptionalFinish,
            ":4: unknown key 'fluid.refine[0]'");
  CheckCase("fluid:\n  density: 1\n  extra:\n    b: {c: 3}\n", NULL, DensityFinish,
            ":3: unknown key 'fluid.extra'");
  CheckCase("fluid:\n  density: 1\nfluidd:\n  a: 1\n", NULL, DensityFinish,
            ":3: unknown section 'fluidd' (did you mean 'fluid'?)");
  CheckCase("fluid: {}\nzebra:\n  a: 1\n", NULL, Finish, ":2: unknown section 'zebra'");
}

static void Sets(void)
{
  static const char
      *const NEGATIVE[] = {"fluid.density=-1", NULL},
             *const UNKNOWN[] = {"fluid.densiti=1", NULL}, *const NO_VALUE[] = {"fluid.density", NULL},
             *const LONG[] = {"fluid.v[2]=1", NULL}, *const THROUGH[] = {"fluid.density.x=1", NULL},
             *const BROKEN[] = {"fluid.v=[1", NULL}, *const NO_KEY[] = {"=3", NULL},
             *const MALFORMED[] = {"fluid..v=3", NULL}, *const NOT_LIST[] = {"fluid.density[0]=3", NULL},
             *const NO_INDEX[] = {"fluid.v.0=3", NULL};
  static const char TEXT[] = "fluid:\n  density: 1\n  v: [1]\n";
  CheckCase(TEXT, NEGATIVE, Density,
            "--set fluid.density=-1: key 'fluid.density': expected a number > 0, found '-1'");
  CheckCase("fluid:\n  density: 1\n", UNKNOWN, DensityFinish,
            "--set fluid.densiti=1: unknown key 'fluid.densiti'");
  CheckCase(TEXT, NO_VALUE, Nothing, "--set fluid.density: expected --set key=value");
  CheckCase(TEXT, NO_KEY, Nothing, "--set =3: expected --set key=value");
  CheckCase(TEXT, LONG, Nothing, "--set fluid.v[2]=1: the list is shorter than this index");
  CheckCase(TEXT, NOT_LIST, Nothing,
            "--set fluid.density[0]=3: the key has an index on a value that is not a list");
  CheckCase(TEXT, NO_INDEX, Nothing,
            "--set fluid.v.0=3: the key goes through a list without an index (expected name[0].name)");
  CheckCase(TEXT, THROUGH, Nothing,
            "--set fluid.density.x=1: the key goes through a value that is not a map");
  CheckCase(TEXT, MALFORMED, Nothing, "--set fluid..v=3: the key is malformed (expected name.name[0].name)");
  CheckCase(TEXT, BROKEN, Nothing, "--set fluid.v=[1: the value is not valid YAML");
}

static void CheckArguments(int argc, char **argv, const char *expected)
{
  static Catch catcher;
  CoracleCase c;
  if (!setjmp(catcher.jump)) CoracleCaseOpen(argc, argv, CatchFail, &catcher, &c);
  if (!strcmp(catcher.message, expected)) return;
  fprintf(stderr, "expected '%s'\n     got '%s'\n", expected, catcher.message);
  exit(1);
}

int main(void)
{
  char *argv[] = {(char *)"test", (char *)"/nonexistent.yaml", (char *)"--set", (char *)"-x"};
  char *odd[] = {(char *)"test", (char *)"-x"};
  Syntax();
  Values();
  UnknownKeys();
  Sets();
  Large();
  CheckArguments(1, argv, "no case file: expected case.yaml [--set key=value]...");
  CheckArguments(2, argv, "case file '/nonexistent.yaml': No such file or directory");
  CheckArguments(3, argv, "--set needs key=value behind it");
  CheckArguments(2, odd, "unknown argument '-x': expected case.yaml [--set key=value]...");
  return 0;
}
