#include "cells.h"
#include <algorithm>

using namespace Foam;

Cells::Cells(const fvMesh &mesh, double rho, double mu)
    : k(mesh.nCells()), ms(k), covered(k), inertia_tensor(mesh.nCells()), kept_inertia(mesh.nCells()), us(mesh.nCells()), rho_(rho), mu_(mu),
      centre_(mesh.C().primitiveField()), area_(k)
{
  forAll(mesh.boundaryMesh(), patchi)
  {
    const polyPatch &patch = mesh.boundaryMesh()[patchi];
    if (!isA<emptyPolyPatch>(patch)) continue;
    forAll(patch, i)
    {
      if (patch.faceAreas()[i].z() < 0) continue; // each cell by the face towards +z, which is counter-clockwise
      const int cell = patch.faceCells()[i];
      const pointField corner = patch[i].points(mesh.points());
      area_[cell] = patch.faceAreas()[i].z();
      for (int v = 2; v < corner.size(); v++) {
        const point &a = corner[0], &b = corner[v - 1], &c = corner[v];
        triangle_.push_back({cell, 0.5 * ((b - a) ^ (c - a)).z(), {{a.x(), a.y()}, {b.x(), b.y()}, {c.x(), c.y()}}});
      }
    }
  }
}

int Cells::region(void *context, int nbox, const double box[], CoracleElements *elements)
{
  Cells &c = *static_cast<Cells *>(context);
  c.near_.clear(), c.x_.clear();
  for (size_t t = 0; t < c.triangle_.size(); t++) {
    const auto &x = c.triangle_[t].x;
    const auto within = [&](const double b[4], int d) {
      return std::min({x[0][d], x[1][d], x[2][d]}) <= b[2 + d] && std::max({x[0][d], x[1][d], x[2][d]}) >= b[d];
    };
    bool overlaps = false;
    for (int b = 0; b < nbox; b++) overlaps = overlaps || (within(box + 4 * b, 0) && within(box + 4 * b, 1));
    if (!overlaps) continue;
    c.near_.push_back(t);
    c.x_.insert(c.x_.end(), &x[0][0], &x[0][0] + 6);
  }
  c.density_.assign(c.near_.size(), c.rho_), c.viscosity_.assign(c.near_.size(), c.mu_);
  *elements = {int(c.near_.size()), c.x_.data(), c.density_.data(), c.viscosity_.data()};
  return 0;
}

void Cells::receive(CoracleClient client)
{
  const CoracleCoupling *entry;
  int n;
  CoracleGetCoupling(client, &n, &entry);
  coupling_.assign(entry, entry + n);
  made_ = near_;
  for (scalarField *f : {&k, &covered, &ms}) *f = 0.0;
  inertia_tensor = Zero, kept_inertia = Zero, us = Zero;
  for (const CoracleCoupling &c : coupling_) {
    const auto &[cell, area, x] = triangle_[made_[c.element]];
    if (c.flags & CORACLE_IS_COVERED) covered[cell] += area / area_[cell];
    for (int d = 0; d < 2; d++)
      for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
          const double part = c.implicit_inertia[i][j] / (rho_ * area_[cell]);
          k[cell] += 0.5 * c.a[d][i][d][j] / (rho_ * area_[cell]);
          for (int e = 0; e < 2; e++) inertia_tensor[cell](d, e) += c.inertia_tensor[d][e] * part, kept_inertia[cell](d, e) += c.kept[d][e] * part;
          ms[cell] += 0.5 * c.ms[i][j] / area_[cell];
        }
        us[cell][d] += c.us[d][i] / area_[cell];
      }
  }
}

void Cells::begin(vectorField &U) const
{
  const vectorField before(U);
  for (const CoracleCoupling &c : coupling_) {
    const auto &[cell, area, x] = triangle_[made_[c.element]];
    U[cell] += c.alpha * area / area_[cell] * (vector(c.velocity[0], c.velocity[1], 0) - before[cell]);
  }
}

vector Cells::from_centre(int t, int i) const
{
  const auto &[cell, area, x] = triangle_[t];
  const int a = i < 3 ? i : (i + 1) % 3, b = i < 3 ? i : (i + 2) % 3;
  return {0.5 * (x[a][0] + x[b][0]) - centre_[cell].x(), 0.5 * (x[a][1] + x[b][1]) - centre_[cell].y(), 0};
}

tmp<vectorField> Cells::force(const vectorField &U, const tensorField &grad) const
{
  auto f = tmp<vectorField>::New(k * U);
  for (const CoracleCoupling &c : coupling_) {
    const int t = made_[c.element], cell = triangle_[t].cell;
    for (int j = 0; j < 3; j++) {
      const vector u = at(t, j, U, grad);
      for (int d = 0; d < 2; d++) {
        double load = c.s[d][j];
        for (int i = 0; i < 3; i++) load -= c.a[d][i][0][j] * u.x() + c.a[d][i][1][j] * u.y();
        f.ref()[cell][d] += load / (rho_ * area_[cell]);
      }
    }
  }
  return f;
}

void Cells::give(CoracleClient client, const vectorField &start, const vectorField &star, const vectorField &projected, const tensorField &grad,
                 const scalarField &p, const vectorField &grad_p)
{
  const auto fill = [&](std::vector<double> &to, const vectorField &U) {
    to.clear();
    for (const int t : near_)
      for (int d = 0; d < 2; d++)
        for (int i = 0; i < 3; i++) to.push_back(at(t, i, U, grad)[d]);
  };
  fill(start_, start), fill(star_, star), fill(projected_, projected);
  pressure_.clear();
  for (const int t : near_)
    for (int i = 0; i < CORACLE_PRESSURE_NODES; i++) pressure_.push_back(rho_ * at(t, i, p, grad_p));
  const CoracleFlow flow = {start_.data(), star_.data(), projected_.data(), pressure_.data(), density_.data(), viscosity_.data(), nullptr, nullptr, nullptr};
  CoracleSetFlow(client, &flow);
}

void Cells::correct(CoracleClient client, vectorField &U) const
{
  const CoracleCorrection *entry;
  int n;
  CoracleGetCorrection(client, &n, &entry);
  for (int m = 0; m < n; m++) {
    const int cell = triangle_[made_[entry[m].element]].cell;
    for (int d = 0; d < 2; d++)
      for (int i = 0; i < 3; i++) U[cell][d] += entry[m].r[d][i] / area_[cell];
  }
}
