/* Metrics on the vertices of a MeshSerial: metric[nv][3] = {xx, xy, yy}, 1/m^2; see metric_tensor.h for one
 * tensor.  A mesh fits its metric when every edge is about 1 long in it.  A usual route:
 *
 *   field -> HessianRecover -> MetricFromHessian -> MetricBound -> MetricIntersect (with another field's, or
 *         sizes near a body) -> MetricGrade -> MeshAdapt (adapt.h)
 *
 * Nothing here is collective.  Errors: PETSC_ERR_ARG_OUTOFRANGE for an argument without sense. */
#ifndef CORACLE_METRIC_H
#define CORACLE_METRIC_H
#include "common/mesh/mesh.h"

/* Isotropic: M = I/h^2, h[nv] in m, positive. */
PetscErrorCode MetricFromSizes(int nv, const double h[], double metric[]);

/* Second derivatives hessian[f][nv][3] of fields field[f][nv] given on the vertices, at most HESSIAN_FIELDS
 * of them, which share the work: the least-squares cubic through two or more rings of neighbours in
 * coordinates in which these are round.  Order 2 on any mesh for a smooth field; with too few vertices for a
 * cubic it is a quadratic's, order 1, and zero if there are not even six. */
enum { HESSIAN_FIELDS = 4 };
PetscErrorCode HessianRecover(const MeshSerial *mesh, int nfields, const double *const field[],
                              double *const hessian[]);

/* Linear interpolation on a triangle errs by at most 2/9 max e^T |H| e over its edges (Frey and Alauzet,
 * Comput. Methods Appl. Mech. Engrg. 194, 2005), so M = 2/(9 error) |H| makes the error equal on unit edges.
 * `error` in the field's unit.  Eigenvalues are at least 1/h_max^2, as a field without curvature asks for
 * nothing. */
PetscErrorCode MetricFromHessian(int nv, const double hessian[], double error, double h_max, double metric[]);

/* Edge sizes into [h_min, h_max], m, and no longer than `anisotropy` times the shorter. */
PetscErrorCode MetricBound(int nv, double h_min, double h_max, double anisotropy, double metric[]);

/* metric becomes its intersection with other: wherever and in every direction at least as fine as both. */
PetscErrorCode MetricIntersect(int nv, const double other[], double metric[]);

/* Sizes grow by at most `growth` > 1 over a unit edge: on every edge pq,
 *   M_q >= M_p / (1 + l_p ln growth)^2,  l_p = sqrt(e^T M_p e),  and the same from q to p (Alauzet, 2010),
 * to a relative 1e-3.  Refines only. */
PetscErrorCode MetricGrade(const MeshSerial *mesh, double growth, double metric[]);

/* Triangles that a mesh of equilateral unit triangles would have: 4/sqrt 3 times the integral of sqrt(det M).
 * MeshAdapt makes 0.9 to 1.25 times as many. */
PetscErrorCode MetricCount(const MeshSerial *mesh, const double metric[], double *triangles);
#endif
