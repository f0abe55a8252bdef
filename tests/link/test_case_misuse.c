/* Wrong use of each function of case_file.h is refused with a message that names the function and what was expected. */
#include "tests/link/catch.h"
#include <math.h>
#include <sys/wait.h>

static const char *const WORDS[] = {"a", "b", NULL}, *const NONE[] = {NULL};
static const CoracleCaseKey KEYS[] = {{NULL, NULL, NULL}};

static void Ignore(void *context, const char *name) {}
static void Read(CoracleCase c, void *context) {}

/* --- with an open case: its own function is called ------------------------------------------------------- */

#define WRONG(name, call)                                                                                    \
  static void name(CoracleCase c)                                                                            \
  {                                                                                                          \
    double v[2] = {0.0};                                                                                     \
    (void)v;                                                                                                 \
    (void)(call);                                                                                            \
  }
WRONG(HasNull, CoracleCaseHas(c, NULL))
WRONG(CountDots, CoracleCaseCount(c, "fluid..list"))
WRONG(KeysIndex, (CoracleCaseKeys(c, "fluid.list[x]", Ignore, NULL)))
WRONG(KeysNobody, (CoracleCaseKeys(c, "fluid", NULL, NULL)))
WRONG(NumberEmpty, (CoracleCaseNumber(c, "", 0.0, 1.0)))
WRONG(NumberRange, (CoracleCaseNumber(c, "fluid.x", 1.0, 0.0)))
WRONG(NumberNan, (CoracleCaseNumber(c, "fluid.x", NAN, 1.0)))
WRONG(PositiveDot, (CoracleCasePositive(c, "fluid.x.")))
WRONG(NumberOrDefault, (CoracleCaseNumberOr(c, "fluid.x", 2.0, 0.0, 1.0)))
WRONG(NumberOrNan, (CoracleCaseNumberOr(c, "fluid.x", NAN, 0.0, 1.0)))
WRONG(IntegerDefault, (CoracleCaseIntegerOr(c, "fluid.x", -1, 0, 1)))
WRONG(IntegerNull, (CoracleCaseIntegerOr(c, NULL, 0, 0, 1)))
WRONG(BoolBracket, (CoracleCaseBoolOr(c, "fluid]", true)))
WRONG(VectorNone, (CoracleCaseVector(c, "fluid.list", 0, v), 0))
WRONG(VectorNull, (CoracleCaseVector(c, "fluid.list", 2, NULL), 0))
WRONG(OptionalNull, (CoracleCaseVectorOptional(c, "fluid.list", 2, NULL)))
WRONG(TableNone, (CoracleCaseTable(c, "fluid.list", 0, &(int){0})))
WRONG(TableNull, (CoracleCaseTable(c, "fluid.list", 2, NULL)))
WRONG(StringNull, (CoracleCaseString(c, NULL)))
WRONG(StringOrNull, (CoracleCaseStringOr(c, "fluid.x", NULL)))
WRONG(FileStart, (CoracleCaseFile(c, ".file")))
WRONG(WordDefault, (CoracleCaseWord(c, "fluid.x", 2, WORDS)))
WRONG(WordNone, (CoracleCaseWord(c, "fluid.x", -1, NONE)))
WRONG(WordNull, (CoracleCaseWord(c, "fluid.x", 0, NULL)))
WRONG(RefuseNull, (CoracleCaseRefuse(c, NULL, "wrong"), 0))
WRONG(RenamedNull, (CoracleCaseRenamed(c, "fluid.x", NULL), 0))
WRONG(BesideNull, (CoracleCaseNotBeside(c, NULL, "x", WORDS), 0))
WRONG(FinishNull, CoracleCaseFinish(c, NULL))
WRONG(DescribeNull, (CoracleCaseDescribe(c, NULL), 0))
static void DescribeMany(CoracleCase c)
{
  for (int k = 0; k < 9; k++) CoracleCaseDescribe(c, KEYS);
}

static void Open(void)
{
  static const struct {
    void (*call)(CoracleCase c);
    const char *message;
  } WRONG_CALLS[] = {
      {HasNull, "CoracleCaseHas: the key is NULL"},
      {CountDots, "CoracleCaseCount: the key 'fluid..list' is malformed (expected name.name[0].name)"},
      {KeysIndex, "CoracleCaseKeys: the key 'fluid.list[x]' is malformed (expected name.name[0].name)"},
      {KeysNobody, "CoracleCaseKeys: there must be a function for the keys of 'fluid'"},
      {NumberEmpty, "CoracleCaseNumber: the key '' is malformed (expected name.name[0].name)"},
      {NumberRange, "CoracleCaseNumber: key 'fluid.x': no number is from 1 to 0"},
      {NumberNan, "CoracleCaseNumber: key 'fluid.x': no number is from nan to 1"},
      {PositiveDot, "CoracleCasePositive: the key 'fluid.x.' is malformed (expected name.name[0].name)"},
      {NumberOrDefault, "CoracleCaseNumberOr: key 'fluid.x': the default 2 is not from 0 to 1"},
      {NumberOrNan, "CoracleCaseNumberOr: key 'fluid.x': the default nan is not from 0 to 1"},
      {IntegerDefault, "CoracleCaseIntegerOr: key 'fluid.x': the default -1 is not from 0 to 1"},
      {IntegerNull, "CoracleCaseIntegerOr: the key is NULL"},
      {BoolBracket, "CoracleCaseBoolOr: the key 'fluid]' is malformed (expected name.name[0].name)"},
      {VectorNone, "CoracleCaseVector: key 'fluid.list': there must be room for 1 number or more"},
      {VectorNull, "CoracleCaseVector: key 'fluid.list': there must be room for 1 number or more"},
      {TableNone,
       "CoracleCaseTable: key 'fluid.list': rows have 1 number or more, and their number needs a place"},
      {TableNull,
       "CoracleCaseTable: key 'fluid.list': rows have 1 number or more, and their number needs a place"},
      {OptionalNull, "CoracleCaseVector: key 'fluid.list': there must be room for 1 number or more"},
      {StringNull, "CoracleCaseString: the key is NULL"},
      {StringOrNull, "CoracleCaseStringOr: key 'fluid.x': the default is NULL"},
      {FileStart, "CoracleCaseFile: the key '.file' is malformed (expected name.name[0].name)"},
      {WordDefault, "CoracleCaseWord: key 'fluid.x': the default is word 2 of 2"},
      {WordNone, "CoracleCaseWord: key 'fluid.x': there must be words"},
      {WordNull, "CoracleCaseWord: key 'fluid.x': there must be words"},
      {RefuseNull, "CoracleCaseRefuse: the key is NULL"},
      {RenamedNull, "CoracleCaseRenamed: the key is NULL"},
      {BesideNull, "CoracleCaseNotBeside: the key is NULL"},
      {FinishNull, "CoracleCaseFinish: there must be a list of sections"},
      {DescribeNull, "CoracleCaseDescribe: there must be a table"},
      {DescribeMany, "CoracleCaseDescribe: more than 8 tables"}};
  for (size_t k = 0; k < sizeof WRONG_CALLS / sizeof *WRONG_CALLS; k++)
    CheckCase("fluid: {list: [1, 2]}\n", NULL, WRONG_CALLS[k].call, WRONG_CALLS[k].message);
}

/* --- without one: the process aborts --------------------------------------------------------------------- */

/* What a child process that calls f says on stderr before it aborts. */
static void Aborts(void (*f)(void), const char *expected)
{
  char text[512] = "";
  int ends[2], status;
  if (pipe(ends)) exit(2);
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDERR_FILENO);
    f();
    _exit(0);
  }
  close(ends[1]);
  FILE *said = fdopen(ends[0], "r");
  if (!fgets(text, sizeof text, said)) text[0] = 0;
  fclose(said);
  waitpid(child, &status, 0);
  text[strcspn(text, "\n")] = 0;
  if (strcmp(text, expected) || !WIFSIGNALED(status)) {
    fprintf(stderr, "expected '%s'\n     got '%s', status %d\n", expected, text, status);
    exit(1);
  }
}

static char *ARGV[] = {(char *)"test", (char *)"case.yaml", NULL};
static void OpenNobody(void)
{
  CoracleCase c;
  CoracleCaseOpen(2, ARGV, NULL, NULL, &c);
}
static void OpenNowhere(void)
{
  CoracleCaseOpen(2, ARGV, CatchFail, NULL, NULL);
}
static void HasClosed(void)
{
  CoracleCaseHas(NULL, "fluid.x");
}
static void PathClosed(void)
{
  CoracleCasePath(NULL);
}
static void HashClosed(void)
{
  CoracleCaseHash(NULL);
}
static void FinishClosed(void)
{
  CoracleCaseFinish(NULL, WORDS);
}
static void FaultlessClosed(void)
{
  CoracleCaseFaultless(NULL);
}
static void CheckNobody(void)
{
  CoracleCaseCheck(2, ARGV, Read, NULL, NULL);
}
static void CheckNothing(void)
{
  CoracleCaseCheck(2, ARGV, NULL, NULL, Ignore);
}
static void KeysOfNowhere(void)
{
  CoracleCaseKeysOf(2, ARGV, Read, NULL, Ignore, NULL);
}

int main(void)
{
  CoracleCase none = NULL;
  Open();
  Aborts(OpenNobody, "coracle: error: CoracleCaseOpen: there must be a function that ends the program, and "
                     "room for the case");
  Aborts(OpenNowhere, "coracle: error: CoracleCaseOpen: there must be a function that ends the program, and "
                      "room for the case");
  Aborts(HasClosed, "coracle: error: CoracleCaseHas: the case is not open");
  Aborts(PathClosed, "coracle: error: CoracleCasePath: the case is not open");
  Aborts(HashClosed, "coracle: error: CoracleCaseHash: the case is not open");
  Aborts(FinishClosed, "coracle: error: CoracleCaseFinish: the case is not open");
  Aborts(FaultlessClosed, "coracle: error: CoracleCaseFaultless: the case is not open");
  Aborts(CheckNobody,
         "coracle: error: CoracleCaseCheck: there must be a function that reads and one that is told");
  Aborts(CheckNothing,
         "coracle: error: CoracleCaseCheck: there must be a function that reads and one that is told");
  Aborts(KeysOfNowhere,
         "coracle: error: CoracleCaseKeysOf: there must be a function that reads and a file to print to");
  CHECK(CoracleCaseClose(&none) == 0); /* what is closed may be closed again */
  return 0;
}
