/* The line on ranks names the participant that took most of the time, where more ranks of it would help, and who has too many. */
#include "coupler/output/advice.h"
#include "tests/check.h"
#include <string.h>

static void Expect(AdviceInput input, const char *expected)
{
  char line[256];
  AdviceWrite(&input, sizeof line, line);
  CHECK(!strcmp(line, expected), "'%s' instead of '%s'", line, expected);
}

int main(void)
{
  Expect((AdviceInput){{1, 1, 1}, {80.0, 5.0, 15.0}, 0},
         "ranks 1:1:1: fluid 80 %, coupler 5 %, solid 15 % of 100 s; more ranks of the fluid: at most 5 "
         "times as fast");
  Expect((AdviceInput){{2, 1, 1}, {2.0, 1.0, 7.0}, 0},
         "ranks 2:1:1: fluid 20 %, coupler 10 %, solid 70 % of 10 s; more ranks of the solid: at most 3.3 "
         "times as fast");
  Expect((AdviceInput){{4, 4, 2}, {45.0, 1.0, 54.0}, 1},
         "ranks 4:4:2: fluid 45 %, coupler 1 %, solid 54 % of 100 s; ranks share processors here, fewer may "
         "be as fast; the coupler needs fewer");
  Expect((AdviceInput){{2, 1, 2}, {40.0, 20.0, 40.0}, 0},
         "ranks 2:1:2: fluid 40 %, coupler 20 %, solid 40 % of 100 s");
  Expect((AdviceInput){{1, 1, 1}, {0.0, 0.0, 0.0}, 0},
         "ranks 1:1:1: fluid 0 %, coupler 0 %, solid 0 % of 0 s");
  return 0;
}
