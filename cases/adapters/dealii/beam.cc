/* An elastic beam by deal.II in place of coracle-solid, in a case whose first body is a rectangle that is fixed at its bottom.
 *
 *   rho0 u'' = div P + F + rho0 g,   P = F S,  S = lambda tr(E) I + 2 mu E,  E = (F^T F - I)/2     (plane strain)
 *
 *   (v1 - v0)/dt = u''(theta x1 + (1 - theta) x0),   (x1 - x0)/dt = theta v1 + (1 - theta) v0,   theta = 0.55
 *
 * Bilinear quadrilaterals, for the library two triangles each on the same nodes; lumped mass; Newton's method with a direct
 * solver.  Rank 0 holds all, other ranks are empty. */
#include <case_file.h>
#include <cmath>
#include <coracle.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/sparse_direct.h>
#include <numeric>
#include <string>
#include <vector>
using namespace dealii;
constexpr double THETA = 0.55; // damps what a step does not resolve, whose vibrations its constant force feeds: README.md
using Array = std::vector<double>; // [nodes][2]
struct Beam {
  CoracleClient client = nullptr;
  double density, mu, lame, gravity[2], lower[2], upper[2];
  std::vector<unsigned int> cells;
  Triangulation<2> grid;
  FESystem<2> element{FE_Q<2>(1), 2};
  DoFHandler<2> dofs{grid};
  SparsityPattern pattern;
  SparseMatrix<double> matrix;
  Vector<double> residual, mass;
  std::vector<std::vector<types::global_dof_index>> dof; // [nodes][2]
  Array rest, x, v, own, mobility;                       // x, v, own are bound
  std::size_t Nodes() const { return rest.size() / 2; }
  bool Held(std::size_t i) const { return std::abs(rest[2 * i + 1] - lower[1]) < 1e-9; }

  void ReadCase(int argc, char **argv)
  {
    CoracleCase c;
    double centre[2];
    CoracleCaseOpen(argc, argv, CoracleFailMessage, client, &c);
    const std::string material = std::string("solid.materials.") + CoracleCaseString(c, "solid.bodies[0].material") + ".";
    density = CoracleCasePositive(c, (material + "density").c_str());
    const double youngs = CoracleCasePositive(c, (material + "youngs_modulus").c_str());
    const double nu = CoracleCaseNumber(c, (material + "poisson_ratio").c_str(), 0, 0.499);
    mu = youngs / (2 * (1 + nu));
    lame = youngs * nu / ((1 + nu) * (1 - 2 * nu));
    CoracleCaseVector(c, "gravity", 2, gravity);
    CoracleCaseVector(c, "solid.bodies[0].centre", 2, centre);
    const double extent[2] = {CoracleCasePositive(c, "solid.bodies[0].width"), CoracleCasePositive(c, "solid.bodies[0].height")};
    const double size = CoracleCasePositive(c, "solid.bodies[0].size");
    for (int d = 0; d < 2; d++) {
      lower[d] = centre[d] - extent[d] / 2;
      upper[d] = centre[d] + extent[d] / 2;
      cells.push_back(std::max(1u, unsigned(std::lround(extent[d] / size))));
    }
    CoracleCaseClose(&c);
  }
  void Build()
  {
    GridGenerator::subdivided_hyper_rectangle(grid, cells, Point<2>(lower[0], lower[1]), Point<2>(upper[0], upper[1]));
    dofs.distribute_dofs(element);
    DynamicSparsityPattern dynamic(dofs.n_dofs());
    DoFTools::make_sparsity_pattern(dofs, dynamic);
    pattern.copy_from(dynamic);
    matrix.reinit(pattern);
    residual.reinit(dofs.n_dofs());
    mass.reinit(dofs.n_dofs());
    dof.assign(grid.n_vertices(), {0, 0});
    rest.resize(2 * grid.n_vertices());
    for (const auto &cell : dofs.active_cell_iterators())
      for (const unsigned int i : cell->vertex_indices())
        for (unsigned int d = 0; d < 2; d++) {
          dof[cell->vertex_index(i)][d] = cell->vertex_dof_index(i, d);
          rest[2 * cell->vertex_index(i) + d] = std::min(std::max(cell->vertex(i)[d], lower[d]), upper[d]);
          mass(cell->vertex_dof_index(i, d)) += density * cell->measure() / 4;
        }
  }
  void GiveMesh() const
  {
    std::vector<long long> gid(Nodes());
    std::vector<int> facet, triangle;
    std::iota(gid.begin(), gid.end(), 0);
    for (const auto &cell : dofs.active_cell_iterators()) { // deal.II numbers a quadrilateral's vertices 0 1 / 2 3
      const int q[4] = {int(cell->vertex_index(0)), int(cell->vertex_index(1)), int(cell->vertex_index(3)), int(cell->vertex_index(2))};
      triangle.insert(triangle.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
      const unsigned int face[4] = {2, 1, 3, 0}; // of deal.II, the side from q[k] to q[k + 1]
      for (int k = 0; k < 4; k++)
        if (cell->face(face[k])->at_boundary()) facet.insert(facet.end(), {q[k], q[(k + 1) % 4]});
    }
    CoracleSetNodes(client, 2, int(Nodes()), gid.data(), x.data(), v.data());
    CoracleSetSurface(client, int(facet.size() / 2), facet.data());
    CoracleSetVolume(client, int(triangle.size() / 3), triangle.data());
  }

  /* residual = int P : grad N at THETA next + (1 - THETA) x, matrix = its derivative by next. */
  void Assemble(const Array &next)
  {
    const QGauss<2> quadrature(2);
    FEValues<2> values(element, quadrature, update_gradients | update_JxW_values);
    const Tensor<2, 2> one = Tensor<2, 2>(unit_symmetric_tensor<2>());
    std::vector<types::global_dof_index> index(8);
    FullMatrix<double> block(8, 8);
    residual = 0;
    matrix = 0;
    for (const auto &cell : dofs.active_cell_iterators()) {
      values.reinit(cell);
      cell->get_dof_indices(index);
      block = 0;
      for (const unsigned int q : values.quadrature_point_indices()) {
        Tensor<2, 2> F = one, gradient[8], dE;
        for (unsigned int i = 0; i < 8; i++) {
          gradient[i][element.system_to_component_index(i).first] = values.shape_grad(i, q);
          const std::size_t k = 2 * cell->vertex_index(i / 2) + i % 2;
          F += (THETA * next[k] + (1 - THETA) * x[k] - rest[k]) * gradient[i];
        }
        const Tensor<2, 2> E = 0.5 * (transpose(F) * F - one), S = lame * trace(E) * one + 2 * mu * E, P = F * S;
        for (unsigned int j = 0; j < 8; j++) {
          dE = 0.5 * (transpose(F) * gradient[j] + transpose(gradient[j]) * F);
          const Tensor<2, 2> dP = gradient[j] * S + F * (lame * trace(dE) * one + 2 * mu * dE);
          for (unsigned int i = 0; i < 8; i++) block(i, j) += THETA * scalar_product(dP, gradient[i]) * values.JxW(q);
          residual(index[j]) += scalar_product(P, gradient[j]) * values.JxW(q);
        }
      }
      matrix.add(index, block);
    }
  }

  void Advance(double dt, const double force[])
  {
    const double factor = 1 / (THETA * dt * dt);
    Array next = x;
    const auto acceleration = [&](std::size_t k) { return factor * (next[k] - x[k] - dt * v[k]); };
    if (x.empty()) return; // UMFPACK wants a matrix
    for (int iteration = 0;; iteration++) {
      if (iteration == 20 && !CoracleRejectStep(client, "Newton's method has not converged in 20 iterations")) return;
      Assemble(next);
      for (std::size_t k = 0; k < next.size(); k++) {
        const types::global_dof_index row = dof[k / 2][k % 2];
        residual(row) += mass(row) * (acceleration(k) - gravity[k % 2]) - force[k];
        matrix.add(row, row, factor * mass(row));
        if (!Held(k / 2)) continue;
        for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry) entry->value() = entry->column() == row;
        residual(row) = 0;
      }
      SparseDirectUMFPACK solver;
      solver.solve(matrix, residual);
      for (std::size_t k = 0; k < next.size(); k++) next[k] -= residual(dof[k / 2][k % 2]);
      if (residual.linfty_norm() < 1e-10 * (upper[1] - lower[1])) break;
    }
    for (std::size_t k = 0; k < next.size(); k++) {
      own[k] = Held(k / 2) ? 0 : acceleration(k) - mobility[k / 2] * force[k];
      v[k] += dt * acceleration(k);
      x[k] = next[k];
    }
  }
};

int main(int argc, char **argv)
{
  Beam b;
  MPI_Comm comm;
  CoracleAction action;
  const double *force;
  double t, dt, tip = 0;
  int rank;
  CoracleOpen("solid", argc, argv, &comm, &b.client);
  MPI_Comm_rank(comm, &rank);
  b.ReadCase(argc, argv);
  if (rank == 0) b.Build();
  b.x = b.rest;
  b.v = b.own = Array(b.rest.size());
  for (std::size_t i = 0; i < b.Nodes(); i++) b.mobility.push_back(b.Held(i) ? 0 : 1 / b.mass(b.dof[i][0]));
  for (std::size_t k = 0; k < b.x.size(); k++) b.own[k] = b.Held(k / 2) ? 0 : b.gravity[k % 2];
  for (Array *state : {&b.x, &b.v, &b.own}) CoracleBindState(b.client, state->data(), state->size() * sizeof(double));
  b.GiveMesh();
  CoracleSetInertia(b.client, b.mobility.data(), b.own.data());
  CoracleReady(b.client);
  for (;;) {
    CoracleBegin(b.client, &t, &dt, &action);
    if (action == CORACLE_STOP) break;
    CoracleGetForce(b.client, &force);
    Array mean = b.x;
    b.Advance(dt, force);
    for (std::size_t k = 0; k < mean.size(); k++) mean[k] = (b.x[k] - mean[k]) / dt;
    CoracleSubstep(b.client, dt, mean.data());
    CoracleSetVelocity(b.client, b.v.data());
    CoracleSetInertia(b.client, b.mobility.data(), b.own.data());
    CoracleEnd(b.client, b.x.data());
  }
  for (std::size_t i = 0; i < b.Nodes(); i++) tip = std::fmax(tip, b.x[2 * i] - b.rest[2 * i]);
  CoracleReport(b.client, "tip_x", tip, 0);
  return CoracleClose(&b.client);
}
