/* The bytes that the phases of a step must move between memory and processor, if each array is read or written once in each
 * pass over the elements: what bench_fluid holds their times against.  Counted from the data structures, per element; a
 * triangle mesh has 1/2 vertex and 2 P2 nodes an element, of 11.5 entries a row.
 *
 *   assembly      geometry 136, mesh 60, material 32, mass flux, u, p 120, blocks 288 + 72 written, load 48;
 *                 copies in single precision: blocks 288 read, 288 written; sum in linear functions 72 + 40;
 *                 the product with u^n: 288 + 136 + 48 x 4
 *   iteration     product: blocks 144, geometry 32, mesh 24, x 48 + 64, stress 32, y 48; relaxation: blocks 252, r, z 48 + 48,
 *   (momentum)    start and z 32 x 5, mesh 12 x 2; linear functions: r, z 48 + 64, nodes 24 x 2, factor 42 x 2;
 *                 Krylov vectors 48 (2 k + 4) in iteration k
 *   iteration     the matrix 3.5 times (product, forward and half of the residual, backward), 2 x 11.5 x 12;
 *   (pressure)    vectors 16 x 12, extension 40 x 2, its factor 2 x 100
 *   pressure      divergence and update: geometry 136 x 2, u 48 x 4, nodes 24 x 2, vectors 16 x 4 */
#ifndef TESTS_FLUID_STEP_BYTES_H
#define TESTS_FLUID_STEP_BYTES_H

static inline double AssemblyBytes(double elements)
{
  return elements * (136 + 60 + 32 + 120 + 360 + 48 + 288 + 288 + 112 + 288 + 136 + 192);
}

/* n iterations of GMRES and the preconditioned residual before them */
static inline double MomentumBytes(double elements, double n)
{
  const double product = 144 + 32 + 24 + 112 + 32 + 48, relaxation = 252 + 96 + 160 + 24,
               linear = 112 + 48 + 84, krylov = 48 * (n + 5);
  return elements * (n * (product + krylov) + (n + 1) * (relaxation + linear));
}

static inline double PressureBytes(double elements, double n)
{
  const double matrix = 2 * 11.5 * 12, iteration = 3.5 * matrix + 192 + 80 + 200;
  return elements * (n * iteration + 272 + 192 + 48 + 64);
}
#endif
