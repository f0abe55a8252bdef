// OpenFOAM's cells as the coupler sees them: triangles that carry the cell's velocity, linear by its gradient.
//
//      3-------2      the cell's polygon in the plane, from its face on an empty patch, is cut from its first corner;
//      | 1  .'/|      what the coupler sends for triangles is summed over the cell, so that a constant test function
//      |  .' / |      tests the momentum equation: both sides of the coupling exchange the same momentum
//      |.'  /  |
//      0-------1
#ifndef CORACLE_OPENFOAM_CELLS_H
#define CORACLE_OPENFOAM_CELLS_H
#include <coracle.h>
#include <fvCFD.H>
#include <vector>

class Cells
{
public:
  Cells(const Foam::fvMesh &mesh, double rho, double mu);

  // CoracleRegionFunction; context: a Cells
  static int region(void *context, int nbox, const double box[], CoracleElements *elements);
  // Takes what the solid does in the coming step.
  void receive(CoracleClient client);
  // In a run's first step: the fluid inside the solid moves with it.
  void begin(Foam::vectorField &U) const;
  // Force on the cells' volume without the implicit part, m/s2: (sum (s - a u) + k U)/(rho V), u linear in the triangles.
  Foam::tmp<Foam::vectorField> force(const Foam::vectorField &U, const Foam::tensorField &grad) const;
  // Hands over u_start, u* and u projected, linear with the gradient of u*, so that they differ by a constant on a cell; p: the whole
  // pressure over rho.
  void give(CoracleClient client, const Foam::vectorField &start, const Foam::vectorField &star,
            const Foam::vectorField &projected, const Foam::tensorField &grad, const Foam::scalarField &p,
            const Foam::vectorField &grad_p);
  // U += M^-1 r of the step that was made.
  void correct(CoracleClient client, Foam::vectorField &U) const;

  Foam::scalarField k;           // 1/s, the implicit coefficient: half the trace of a, over rho V
  Foam::scalarField ms, covered; // parts of the cell: bulk velocity, start are the solid's
  Foam::tensorField inertia_tensor, kept_inertia; // 1/s, of the solid; times what is kept of U
  Foam::vectorField us;                           // m/s, the solid's velocity times ms

private:
  struct Triangle {
    int cell;
    double area, x[3][2]; // m2, m
  };
  Foam::vector from_centre(int t, int i) const; // of the cell to a vertex or the midpoint opposite one
  template <class Field, class Gradient> auto at(int t, int i, const Field &f, const Gradient &grad) const
  {
    return f[triangle_[t].cell] + (from_centre(t, i) & grad[triangle_[t].cell]);
  }

  double rho_, mu_;
  Foam::vectorField centre_;
  std::vector<Triangle> triangle_; // of all cells
  std::vector<int> near_, made_;   // known to the coupler, by its numbers; those of the current step
  std::vector<CoracleCoupling> coupling_;
  Foam::scalarField area_; // m2, of the cells' polygons
  std::vector<double> x_, density_, viscosity_, start_, star_, projected_, pressure_;
};
#endif
