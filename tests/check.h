/* Stops the whole test with what was expected and where: CHECK(x > 0, "x is %g", x).  Exit code 1 ends all
 * ranks. */
#ifndef TESTS_CHECK_H
#define TESTS_CHECK_H
#include <stdio.h>
#include <stdlib.h>

#define CHECK(condition, ...)                                                                                \
  do {                                                                                                       \
    if (!(condition)) {                                                                                      \
      fprintf(stderr, "%s:%d: %s: ", __FILE__, __LINE__, #condition);                                        \
      fprintf(stderr, __VA_ARGS__);                                                                          \
      fprintf(stderr, "\n");                                                                                 \
      exit(1);                                                                                               \
    }                                                                                                        \
  } while (0)
#endif
