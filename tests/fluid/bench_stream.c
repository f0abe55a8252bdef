/* The machine's memory bandwidth: STREAM's triad a = b + s c (McCalpin), one core, 3 x 8 bytes an entry, best of ten passes
 * over arrays far larger than the caches.  Prints GB/s; what scripts/bench.sh holds the phases of a step against. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { N = 1 << 25, PASSES = 10 };

static double Seconds(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double Triad(double a[restrict], const double b[restrict], const double c[restrict], double s)
{
  const double start = Seconds();
  for (int i = 0; i < N; i++) a[i] = b[i] + s * c[i];
  return Seconds() - start;
}

int main(void)
{
  double *a = malloc(N * sizeof *a), *b = malloc(N * sizeof *b), *c = malloc(N * sizeof *c), best = 1e30;
  if (!a || !b || !c) return 1;
  for (int i = 0; i < N; i++) a[i] = 0.0, b[i] = 1.0, c[i] = 2.0;
  for (int pass = 0; pass < PASSES; pass++) {
    const double seconds = Triad(a, b, c, 3.0 + pass);
    best = seconds < best ? seconds : best;
  }
  if (a[N / 2] != 1.0 + (2.0 + PASSES) * 2.0) return 1;
  printf("%.2f\n", 3.0 * sizeof *a * N / best * 1e-9);
  free(a), free(b), free(c);
  return 0;
}
