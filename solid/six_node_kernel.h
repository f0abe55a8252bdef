/* The triangle of linear strain, integrated at three points as constant-strain triangles (element.h).  Pointwise.
 *
 *        c              u = sum N_i u_i,   N_a = a (2 a - 1),  N_ab = 4 a b,  ...      (a, b, c: the triangle's coordinates)
 *       / \             points: a = 2/3, b = c = 1/6, and so around; each has a third of the area: exact for products of
 *     ca---bc           strains.  At the first the gradient of u is that of the linear function on abc with the values
 *     / \ / \               U_a = (5 u_a + 2 u_ab + 2 u_ca)/3
 *    a---ab--b              U_b = (8 u_ab + 2 u_bc - u_b)/3,    U_c = (8 u_ca + 2 u_bc - u_c)/3
 *
 * So an element at a corner (bodies/six_node.h) is a constant-strain triangle with nodes that are carried along; what acts on
 * them acts on the six nodes by the same factors (virtual work).  Rest positions are carried along, too, so that sides may be curved.
 * The mass is that of the four triangles, lumped: 1/12 at a vertex, 1/4 between.  With it the largest eigenvalue of M^-1 K of a
 * scalar is 4.4 to 5.12 times that of the constant-strain triangle abc (20 000 triangles; 5.12: equilateral). */
#ifndef SOLID_SIX_NODE_KERNEL_H
#define SOLID_SIX_NODE_KERNEL_H

/* Of the rates of one of the three points' triangles, which have a third of the stiffness: those of the whole. */
#define SIX_NODE_RATE (3.0 * 5.12)

/* Node i of the six of a triangle, vertices first, then the nodes after them, as those of the corner at vertex q have them: its own
 * three, then the next vertex, the last, the node between. */
static inline int SixNodeOf(int q, int i)
{
  const int own[6] = {q, 3 + q, 3 + (q + 2) % 3, (q + 1) % 3, (q + 2) % 3, 3 + (q + 1) % 3};
  return own[i];
}

/* U_v is made of three of these, by these factors. */
static const int SIX_NODE_FROM[3][3] = {{0, 1, 2}, {1, 3, 5}, {2, 4, 5}};
static const double SIX_NODE_FACTOR[3][3] = {{5.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0},
                                             {8.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0},
                                             {8.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0}};

/* corner[0 .. 2], values at the corner's own nodes, become U; with w = 0 they stay. */
static inline void SixNodeCarry(double w, double next, double last, double between, double *a, double *b,
                                double *c)
{
  const double u = *a + w * (2.0 / 3.0) * (*a + *b + *c);
  *b += w * (1.0 / 3.0) * (5.0 * *b + 2.0 * between - next);
  *c += w * (1.0 / 3.0) * (5.0 * *c + 2.0 * between - last);
  *a = u;
}

/* node[6]: what acts on the vertices and the nodes after them; on[q][v]: on U_v of the corner at vertex q. */
static inline void SixNodeReturn(const double on[3][3], double node[6])
{
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    node[i] = (5.0 * on[i][0] - on[k][1] - on[j][2]) * (1.0 / 3.0);
    node[3 + i] =
        (2.0 * (on[i][0] + on[j][0] + on[k][1] + on[k][2]) + 8.0 * (on[i][1] + on[j][2])) * (1.0 / 3.0);
  }
}
#endif
