#include "solid/bodies/model.h"
#include "solid/bodies/element_edges.h"
#include "solid/contact/cell_grid.h"
#include "solid/contact/contact_kernel.h"
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#define FLAT 1e-6  /* area over squared longest edge below which an element is degenerate */
#define TOUCH 1e-9 /* phi up to which bodies that touch are not yet said to overlap */

static char why[256];

static PetscErrorCode Refuse(const char *format, ...) __attribute__((format(printf, 1, 2)));
static PetscErrorCode Refuse(const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(why, sizeof why, format, arguments);
  va_end(arguments);
  return PETSC_ERR_USER_INPUT;
}

/* --- checks ------------------------------------------------------------------------------------------- */

static Point Vertex(const MeshSerial *m, int e, int i)
{
  return PointAt(m->x, m->vertex[3 * e + i]);
}

static PetscErrorCode CheckElements(const MeshSerial *m)
{
  if (m->ne == 0) return Refuse("the mesh has no triangles");
  for (int e = 0; e < m->ne; e++) {
    double longest = 0.0;
    const double area =
        0.5 * TensorDeterminant(TensorOfEdges(Vertex(m, e, 0), Vertex(m, e, 1), Vertex(m, e, 2)));
    for (int i = 0; i < 3; i++) {
      const Point d = PointMinus(Vertex(m, e, (i + 1) % 3), Vertex(m, e, i));
      longest = fmax(longest, d.x * d.x + d.y * d.y);
    }
    if (!(area > FLAT * longest))
      return Refuse("element %d at (%g, %g) is %s: its area is %g m2", e, Vertex(m, e, 0).x,
                    Vertex(m, e, 0).y, area < -FLAT * longest ? "inverted" : "degenerate", area);
  }
  return 0;
}

/* Where the body starts, if that is given. */
static PetscErrorCode CheckPositions(const MeshSerial *m, const double x[])
{
  for (int e = 0; x && e < m->ne; e++) {
    const int *n = m->vertex + 3 * e;
    const Point a = PointAt(x, n[0]);
    if (!(TensorDeterminant(TensorOfEdges(a, PointAt(x, n[1]), PointAt(x, n[2]))) > 0.0))
      return Refuse("its stretch turns element %d at (%g, %g) inside out", e, a.x, a.y);
  }
  return 0;
}

/* what: "boundary" or "region" */
static PetscErrorCode CheckName(const char *what, const char *name, int n, char (*known)[64])
{
  char all[160] = "";
  for (int t = 0; t < n; t++) {
    const size_t used = strlen(all);
    if (!strcmp(known[t], name)) return 0;
    (void)snprintf(all + used, sizeof all - used, "%s%s", t ? ", " : "", known[t]);
  }
  return Refuse("the body has no %s '%s'; it has %s", what, name, n ? all : "none");
}

static PetscBool IsRegion(const MeshSerial *m, const char *name)
{
  for (int r = 0; r < m->nregions; r++)
    if (!strcmp(m->region_name[r], name)) return PETSC_TRUE;
  return PETSC_FALSE;
}

static PetscErrorCode CheckNames(const MeshSerial *m, const BodySetup *setup)
{
  PetscErrorCode code = 0;
  for (int k = 0; k < setup->nfixed && !code; k++)
    if (!IsRegion(m, setup->fixed_name[k]))
      code = CheckName("boundary", setup->fixed_name[k], m->ntags, m->tag_name);
  for (int k = 0; k < setup->nprescribed && !code; k++)
    code = CheckName("boundary", setup->prescribed[k].boundary, m->ntags, m->tag_name);
  for (int k = 0; k < setup->nregions && !code; k++)
    code = CheckName("region", setup->region[k].region, m->nregions, m->region_name);
  for (int k = 0; k < setup->joints.nregions && !code; k++)
    code = CheckName("region", setup->joints.region[k], m->nregions, m->region_name);
  return code;
}

/* --- materials ---------------------------------------------------------------------------------------- */

ElementLaw MaterialLaw(const Material *m)
{
  ElementLaw law = ElementLawOf(m->youngs_modulus, m->poisson_ratio, 0.0);
  law.plane_stress = m->plane_stress;
  law.corotated = m->corotated;
  return law;
}

/* The place of a material in the model, where it is put if it is not there. */
static PetscErrorCode AddMaterial(Model *a, const Material *m, int *place)
{
  PetscFunctionBeginUser;
  for (*place = m->name[0] ? 0 : a->nmaterials; *place < a->nmaterials; (*place)++)
    if (!strcmp(a->material[*place].name, m->name)) PetscFunctionReturn(0);
  PetscCall(PetscRealloc((size_t)(a->nmaterials + 1) * sizeof *a->material, &a->material));
  a->material[a->nmaterials] = *m;
  if (m->thickness == 0.0) a->material[a->nmaterials].thickness = 1.0;
  a->nmaterials++;
  PetscFunctionReturn(0);
}

static PetscErrorCode GiveMaterials(Model *a, const MeshSerial *m, const BodySetup *setup, int first)
{
  int place;
  PetscFunctionBeginUser;
  PetscCall(AddMaterial(a, &setup->material, &place));
  for (int e = first; e < a->nelements; e++) a->element_material[e] = place;
  for (int k = 0; k < setup->nregions; k++) {
    PetscCall(AddMaterial(a, &setup->region[k].material, &place));
    for (int e = first; e < a->nelements; e++)
      if (!strcmp(m->region_name[m->region[e - first]], setup->region[k].region))
        a->element_material[e] = place;
  }
  PetscFunctionReturn(0);
}

/* --- nodes -------------------------------------------------------------------------------------------- */

/* renumber[mesh->nv]: new numbers, from a->nnodes on, of the vertices that have a triangle; -1 for the
 * others. */
static void NumberNodes(Model *a, const MeshSerial *m, int renumber[])
{
  int n = a->nnodes;
  for (int v = 0; v < m->nv; v++) renumber[v] = -1;
  for (int k = 0; k < 3 * m->ne; k++)
    if (renumber[m->vertex[k]] < 0) renumber[m->vertex[k]] = n++;
}

static int CountNodes(const MeshSerial *m, const int renumber[])
{
  int n = 0;
  for (int v = 0; v < m->nv; v++) n += renumber[v] >= 0;
  return n;
}

static PetscErrorCode GrowNodes(Model *a, int n)
{
  PetscFunctionBeginUser;
  PetscCall(PetscRealloc(2 * (size_t)n * sizeof *a->rest, &a->rest));
  PetscCall(PetscRealloc(2 * (size_t)n * sizeof *a->x, &a->x));
  PetscCall(PetscRealloc(2 * (size_t)n * sizeof *a->u, &a->u));
  PetscCall(PetscRealloc((size_t)n * sizeof *a->fixed, &a->fixed));
  PetscCall(PetscRealloc((size_t)n * sizeof *a->node_body, &a->node_body));
  a->nnodes = n;
  PetscFunctionReturn(0);
}

/* Stretched positions, and the velocity of a rigid motion. */
static void PlaceNodes(Model *a, const MeshSerial *m, const BodySetup *setup, const double centre[2],
                       const int renumber[])
{
  for (int v = 0; v < m->nv; v++) {
    const int n = renumber[v];
    if (n < 0) continue;
    for (int c = 0; c < 2; c++) {
      a->rest[2 * n + c] = m->x[2 * v + c];
      a->x[2 * n + c] = setup->position ? setup->position[2 * v + c]
                                        : centre[c] + setup->stretch[c] * (m->x[2 * v + c] - centre[c]);
    }
    a->u[2 * n] = setup->velocity[0] - setup->angular_velocity * (a->x[2 * n + 1] - centre[1]);
    a->u[2 * n + 1] = setup->velocity[1] + setup->angular_velocity * (a->x[2 * n] - centre[0]);
    a->fixed[n] = setup->fixed;
    a->node_body[n] = a->nbodies;
  }
}

static void FixNodes(Model *a, const MeshSerial *m, const BodySetup *setup, const int renumber[])
{
  for (int b = 0; b < m->nb; b++)
    for (int k = 0; k < setup->nfixed; k++) {
      if (strcmp(m->tag_name[m->facet_tag[b]], setup->fixed_name[k])) continue;
      for (int i = 0; i < 2; i++) a->fixed[renumber[m->facet[2 * b + i]]] = 1;
    }
  for (int e = 0; m->nregions > 0 && e < m->ne; e++)
    for (int k = 0; k < setup->nfixed; k++) {
      if (m->region[e] < 0 || strcmp(m->region_name[m->region[e]], setup->fixed_name[k])) continue;
      for (int i = 0; i < 3; i++) a->fixed[renumber[m->vertex[3 * e + i]]] = 1;
    }
  for (int v = 0; v < m->nv; v++)
    if (renumber[v] >= 0 && a->fixed[renumber[v]]) a->u[2 * renumber[v]] = a->u[2 * renumber[v] + 1] = 0.0;
}

static PetscErrorCode PrescribeNodes(Model *a, const MeshSerial *m, const BodySetup *setup,
                                     const int renumber[])
{
  PetscFunctionBeginUser;
  for (int k = 0; k < setup->nprescribed; k++) {
    PrescribedMotion motion = setup->prescribed[k].motion;
    double *row;
    PetscCall(PetscMalloc1(3 * (size_t)motion.nrows, &row));
    PetscCall(PetscArraycpy(row, motion.row, 3 * (size_t)motion.nrows));
    motion.row = row;
    PetscCall(PetscRealloc((size_t)(a->nmotions + 1) * sizeof *a->motion, &a->motion));
    a->motion[a->nmotions] = motion;
    PetscCall(
        PetscRealloc(((size_t)a->nprescribed + 2 * (size_t)m->nb) * sizeof *a->prescribed, &a->prescribed));
    for (int i = 0; i < 2 * m->nb; i++) {
      if (strcmp(m->tag_name[m->facet_tag[i / 2]], setup->prescribed[k].boundary)) continue;
      const int n = renumber[m->facet[i]];
      a->prescribed[a->nprescribed++] = (PrescribedNode){n, a->nmotions};
      for (int c = 0; c < 2; c++)
        if (motion.prescribed[c]) a->u[2 * n + c] = PrescribedVelocity(&motion, c, 0.0, 1e-12);
    }
    a->nmotions++;
  }
  PetscFunctionReturn(0);
}

static void MassCentre(const MeshSerial *m, double centre[2])
{
  double area = 0.0, sum[2] = {0.0, 0.0};
  for (int e = 0; e < m->ne; e++) {
    const Point a = Vertex(m, e, 0), b = Vertex(m, e, 1), c = Vertex(m, e, 2);
    const double w = 0.5 * TensorDeterminant(TensorOfEdges(a, b, c));
    area += w;
    sum[0] += w * (a.x + b.x + c.x) / 3.0;
    sum[1] += w * (a.y + b.y + c.y) / 3.0;
  }
  for (int c = 0; c < 2; c++) centre[c] = sum[c] / area;
}

/* --- elements and surface ----------------------------------------------------------------------------- */

static int CompareOwners(const void *a, const void *b)
{
  const ElementEdge *p = a, *q = b;
  if (p->element != q->element) return p->element < q->element ? -1 : 1;
  return p->side - q->side;
}

/* Keeps of the sorted edges those that occur once; -1 if one occurs more than twice. */
static int KeepSurface(int n, ElementEdge edge[])
{
  int kept = 0;
  for (int k = 0, next; k < n; k = next) {
    for (next = k + 1; next < n && edge[next].low == edge[k].low && edge[next].high == edge[k].high;) next++;
    if (next - k > 2) return -1;
    if (next - k == 1) edge[kept++] = edge[k];
  }
  return kept;
}

/* The edges with one triangle only, in order of the elements, each with the solid on its left. */
static PetscErrorCode AddSurface(Model *a, int first)
{
  const int n = 3 * (a->nelements - first);
  ElementEdge *edge;
  PetscFunctionBeginUser;
  PetscCall(ElementEdgesSorted(first, a->nelements, a->element, &edge));
  const int kept = KeepSurface(n, edge);
  if (kept < 0) {
    PetscCall(PetscFree(edge));
    return Refuse("an edge has more than two triangles");
  }
  qsort(edge, (size_t)kept, sizeof *edge, CompareOwners);
  PetscCall(PetscRealloc(2 * (size_t)(a->nfacets + kept) * sizeof *a->facet, &a->facet));
  PetscCall(PetscRealloc((size_t)(a->nfacets + kept) * sizeof *a->facet_element, &a->facet_element));
  for (int k = 0; k < kept; k++, a->nfacets++) {
    const int e = edge[k].element, i = edge[k].side;
    a->facet[2 * a->nfacets] = a->element[3 * e + i];
    a->facet[2 * a->nfacets + 1] = a->element[3 * e + (i + 1) % 3];
    a->facet_element[a->nfacets] = e;
  }
  PetscCall(PetscFree(edge));
  PetscFunctionReturn(0);
}

static PetscErrorCode AddElements(Model *a, const MeshSerial *m, const int renumber[])
{
  const int first = a->nelements, n = first + m->ne;
  PetscFunctionBeginUser;
  PetscCall(PetscRealloc(3 * (size_t)n * sizeof *a->element, &a->element));
  PetscCall(PetscRealloc((size_t)n * sizeof *a->element_body, &a->element_body));
  PetscCall(PetscRealloc((size_t)n * sizeof *a->jointed, &a->jointed));
  PetscCall(PetscRealloc((size_t)n * sizeof *a->element_material, &a->element_material));
  for (int k = 0; k < 3 * m->ne; k++) a->element[3 * first + k] = renumber[m->vertex[k]];
  for (int e = first; e < n; e++) a->element_body[e] = a->nbodies;
  a->nelements = n;
  PetscFunctionReturn(0);
}

static int InJoints(const MeshSerial *m, int e, const JointSetup *j)
{
  double centre[2] = {0.0, 0.0};
  int inside = j->all;
  for (int i = 0; i < 3; i++) {
    centre[0] += Vertex(m, e, i).x / 3.0;
    centre[1] += Vertex(m, e, i).y / 3.0;
  }
  for (int k = 0; k < j->nboxes; k++)
    inside |= centre[0] >= j->box[k][0] && centre[1] >= j->box[k][1] && centre[0] <= j->box[k][2] &&
              centre[1] <= j->box[k][3];
  for (int k = 0; k < j->nregions; k++)
    inside |= m->region && m->region[e] >= 0 && !strcmp(m->region_name[m->region[e]], j->region[k]);
  return inside;
}

static PetscErrorCode GiveJoints(Model *a, const MeshSerial *m, const JointSetup *joints, int first)
{
  for (int e = 0; e < m->ne; e++) {
    const Material *of = &a->material[a->element_material[first + e]];
    a->jointed[first + e] = InJoints(m, e, joints);
    for (int k = 0; k < 2 && a->jointed[first + e]; k++)
      if (!(of->strength[k] > 0.0 && of->fracture_energy[k] > 0.0))
        return Refuse("joints need a material with tensile_strength, shear_strength and fracture_energy");
  }
  return 0;
}

PetscErrorCode ModelAdd(Model *a, const MeshSerial *mesh, const BodySetup *setup, const char **error)
{
  int *renumber;
  Body body = {.material = setup->material, .first_element = a->nelements, .entry = setup->entry};
  PetscErrorCode code;
  PetscFunctionBeginUser;
  *error = why;
  if ((code = CheckElements(mesh)) || (code = CheckPositions(mesh, setup->position)) ||
      (code = CheckNames(mesh, setup)))
    PetscFunctionReturn(code);
  MassCentre(mesh, body.centre);
  PetscCall(PetscMalloc1((size_t)mesh->nv, &renumber));
  NumberNodes(a, mesh, renumber);
  PetscCall(GrowNodes(a, a->nnodes + CountNodes(mesh, renumber)));
  PlaceNodes(a, mesh, setup, body.centre, renumber);
  FixNodes(a, mesh, setup, renumber);
  PetscCall(PrescribeNodes(a, mesh, setup, renumber));
  PetscCall(AddElements(a, mesh, renumber));
  PetscCall(GiveMaterials(a, mesh, setup, body.first_element));
  code = GiveJoints(a, mesh, &setup->joints, body.first_element);
  if (code) PetscFunctionReturn(code);
  PetscCall(PetscFree(renumber));
  PetscCall(PetscRealloc((size_t)(a->nbodies + 1) * sizeof *a->body, &a->body));
  a->body[a->nbodies++] = body;
  code = AddSurface(a, body.first_element); /* a refusal carries no trace-back */
  PetscFunctionReturn(code);
}

/* --- overlap ------------------------------------------------------------------------------------------ */

typedef struct {
  const Model *a;
  int first, second;
} OverlapSearch;

/* The facet's edge, or the centre of the triangle behind it (which tells a body laid exactly over another),
 * lies in element e. */
static int Penetrates(const Model *a, int facet, int e)
{
  const int *behind = a->element + 3 * a->facet_element[facet];
  ContactIntegrals f;
  Point t[3], centre = {0.0, 0.0};
  for (int i = 0; i < 3; i++) {
    t[i] = PointAt(a->x, a->element[3 * e + i]);
    centre.x += PointAt(a->x, behind[i]).x / 3.0;
    centre.y += PointAt(a->x, behind[i]).y / 3.0;
  }
  const int centred = ContactEdgeTriangle(centre, centre, t, &f) && f.largest_phi >= TOUCH;
  return centred || (ContactEdgeTriangle(PointAt(a->x, a->facet[2 * facet]),
                                         PointAt(a->x, a->facet[2 * facet + 1]), t, &f) &&
                     f.largest_phi >= TOUCH);
}

static PetscErrorCode OverlapFound(void *context, int facet, int e)
{
  OverlapSearch *s = context;
  const Model *a = s->a;
  const int one = a->element_body[a->facet_element[facet]], other = a->element_body[e];
  if (one == other || s->first >= 0 || !Penetrates(a, facet, e)) return 0;
  s->first = PetscMin(one, other);
  s->second = PetscMax(one, other);
  return 0;
}

static GeometryBox BoxOfNodes(const double x[], int n, const int node[])
{
  GeometryBox box = GeometryBoxEmpty();
  for (int i = 0; i < n; i++) GeometryBoxGrow(&box, x + 2 * node[i]);
  return box;
}

PetscErrorCode ModelOverlap(const Model *a, int *first, int *second)
{
  OverlapSearch s = {a, -1, -1};
  GeometryBox *facet, *element;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2((size_t)a->nfacets, &facet, (size_t)a->nelements, &element));
  for (int k = 0; k < a->nfacets; k++) facet[k] = BoxOfNodes(a->x, 2, a->facet + 2 * k);
  for (int e = 0; e < a->nelements; e++) element[e] = BoxOfNodes(a->x, 3, a->element + 3 * e);
  if (a->nbodies > 1) PetscCall(CellGridPairs(a->nfacets, facet, a->nelements, element, OverlapFound, &s));
  PetscCall(PetscFree2(facet, element));
  *first = s.first;
  *second = s.second;
  PetscFunctionReturn(0);
}

PetscErrorCode ModelDestroy(Model *a)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(a->rest));
  PetscCall(PetscFree(a->x));
  PetscCall(PetscFree(a->u));
  PetscCall(PetscFree(a->fixed));
  PetscCall(PetscFree(a->node_body));
  PetscCall(PetscFree(a->element));
  PetscCall(PetscFree(a->element_body));
  PetscCall(PetscFree(a->jointed));
  for (int k = 0; k < a->nmotions; k++) PetscCall(PetscFree(a->motion[k].row));
  PetscCall(PetscFree(a->motion));
  PetscCall(PetscFree(a->prescribed));
  PetscCall(PetscFree(a->material));
  PetscCall(PetscFree(a->element_material));
  PetscCall(PetscFree(a->facet));
  PetscCall(PetscFree(a->facet_element));
  PetscCall(PetscFree(a->body));
  PetscCall(PetscMemzero(a, sizeof *a));
  PetscFunctionReturn(0);
}
