// The rigid disc of cases/adapters/template_c as a client in C++: the same page, but for malloc, whose result C++ does not convert.
#include <cstddef>
#include <cstdlib>

namespace
{
struct Memory {
  void *p;
  template <class T> operator T *() const { return static_cast<T *>(p); }
};
Memory Allocate(std::size_t n) { return Memory{std::malloc(n)}; }
} // namespace

#include <case_file.h>
#include <coracle.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#define malloc Allocate
#include "rigid_disc.c"
