/* Bodies, one after the other, into the model. */
#include "solid/bodies/element_edges.h"
#include "solid/bodies/model_impl.h"
#include <stdlib.h>

#define ALL_SIDES 7

/* --- materials ---------------------------------------------------------------------------------------- */

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

static void RestNodes(Model *a, const MeshSerial *m, const int renumber[])
{
  for (int v = 0; v < m->nv; v++)
    for (int c = 0; c < 2 && renumber[v] >= 0; c++) a->rest[2 * renumber[v] + c] = m->x[2 * v + c];
}

/* Stretched positions, and the velocity of a rigid motion. */
static void PlaceNodes(Model *a, const MeshSerial *m, const BodySetup *setup, const double centre[2],
                       const int renumber[])
{
  for (int v = 0; v < m->nv; v++) {
    const int n = renumber[v];
    if (n < 0) continue;
    for (int c = 0; c < 2; c++) {
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

/* Node n moves as the last of the motions, unless it is fixed. */
static void PrescribeNode(Model *a, int n)
{
  if (a->fixed[n]) return;
  const PrescribedMotion *motion = &a->motion[a->nmotions];
  a->prescribed[a->nprescribed++] = (PrescribedNode){n, a->nmotions};
  double v[2];
  const PrescribedSubstep first = PrescribedSubstepOf(motion, 0.0, 1e-12);
  PrescribedNodeVelocity(&first, a->x + 2 * n, v);
  for (int c = 0; c < 2; c++)
    if (motion->prescribed[c]) a->u[2 * n + c] = v[c];
}

static PetscErrorCode PrescribeNodes(Model *a, const MeshSerial *m, const BodySetup *setup,
                                     const int renumber[])
{
  PetscFunctionBeginUser;
  for (int k = 0; k < setup->nprescribed; k++) {
    PrescribedMotion motion = setup->prescribed[k].motion;
    PetscCall(ModelCopyRows(3 * motion.nrows, &motion.row));
    PetscCall(ModelCopyRows(2 * motion.spin.nrows, &motion.spin.row));
    PetscCall(PetscRealloc((size_t)(a->nmotions + 1) * sizeof *a->motion, &a->motion));
    a->motion[a->nmotions] = motion;
    const char *boundary = setup->prescribed[k].boundary;
    const size_t most = boundary ? 2 * (size_t)m->nb : (size_t)m->nv;
    PetscCall(PetscRealloc(((size_t)a->nprescribed + most) * sizeof *a->prescribed, &a->prescribed));
    for (int v = 0; !boundary && v < m->nv; v++)
      if (renumber[v] >= 0) PrescribeNode(a, renumber[v]);
    for (int i = 0; boundary && i < 2 * m->nb; i++)
      if (!strcmp(m->tag_name[m->facet_tag[i / 2]], boundary)) PrescribeNode(a, renumber[m->facet[i]]);
    a->nmotions++;
  }
  PetscFunctionReturn(0);
}

/* Of the elements from `first` on. */
static void MassCentre(const Model *a, int first, double centre[2])
{
  double mass = 0.0, sum[2] = {0.0, 0.0};
  for (int k = 3 * first; k < 3 * a->nelements; k++) {
    const double m = ModelElementMass(a, k / 3) / 3.0;
    mass += m;
    for (int c = 0; c < 2; c++) sum[c] += m * a->rest[2 * a->element[k] + c];
  }
  for (int c = 0; c < 2; c++) centre[c] = sum[c] / mass;
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
    return ModelRefuse("an edge has more than two triangles");
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

static PetscErrorCode AddElements(Model *a, const MeshSerial *m, const BodySetup *setup, const int renumber[])
{
  const int first = a->nelements, n = first + m->ne;
  PetscFunctionBeginUser;
  PetscCall(PetscRealloc(3 * (size_t)n * sizeof *a->element, &a->element));
  PetscCall(PetscRealloc((size_t)n * sizeof *a->element_body, &a->element_body));
  PetscCall(PetscRealloc((size_t)n * sizeof *a->jointed, &a->jointed));
  PetscCall(PetscRealloc(3 * (size_t)n * sizeof *a->joint_material, &a->joint_material));
  PetscCall(PetscRealloc((size_t)n * sizeof *a->element_material, &a->element_material));
  PetscCall(PetscRealloc((size_t)n * sizeof *a->six_node, &a->six_node));
  for (int k = 0; k < 3 * m->ne; k++) a->element[3 * first + k] = renumber[m->vertex[k]];
  for (int e = first; e < n; e++) {
    a->element_body[e] = a->nbodies;
    a->six_node[e] = setup->six_node ? SIX_NODE_A + (e - first) % 4 : NOT_SIX_NODE;
  }
  a->nelements = n;
  PetscFunctionReturn(0);
}

static int Named(int place, char (*list)[64], const char *name)
{
  return place >= 0 && !strcmp(list[place], name);
}

/* The sides of an element that may part, a bit each. */
static int SidesWithJoints(const MeshSerial *m, int e, const JointSetup *j)
{
  int inside = j->all, sides = 0;
  for (int k = 0; k < j->nboxes; k++) inside |= ModelInBox(m, e, j->box[k]);
  for (int k = 0; k < j->nnames; k++) {
    inside |= m->region && !j->named[k].has_material && Named(m->region[e], m->region_name, j->named[k].name);
    for (int i = 0; i < 3 && m->curve; i++)
      sides |= Named(m->curve[3 * e + i], m->curve_name, j->named[k].name) << i;
  }
  return inside ? ALL_SIDES : sides;
}

/* place[nnames]: of the materials of named joints in the model, or -1. */
static PetscErrorCode AddJointMaterials(Model *a, const JointSetup *joints, int place[])
{
  PetscFunctionBeginUser;
  for (int k = 0; k < joints->nnames; k++) {
    place[k] = -1;
    if (joints->named[k].has_material) PetscCall(AddMaterial(a, &joints->named[k].material, &place[k]));
  }
  PetscFunctionReturn(0);
}

/* Whether joints across sides of an element may have its material's strengths. */
static int CheckStrengths(const Material *m)
{
  for (int k = 0; k < 2; k++)
    if (!(m->strength[k] > 0.0 && m->fracture_energy[k] > 0.0)) return 0;
  return 1;
}

static PetscErrorCode GiveJoints(Model *a, const MeshSerial *m, const JointSetup *joints, int first)
{
  int *place;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)joints->nnames, &place));
  PetscCall(AddJointMaterials(a, joints, place));
  for (int e = 0; e < m->ne; e++) {
    int *own = a->joint_material + 3 * (first + e);
    a->jointed[first + e] = SidesWithJoints(m, e, joints);
    for (int i = 0; i < 3; i++) {
      own[i] = -1;
      for (int k = 0; k < joints->nnames && m->curve; k++)
        if (place[k] >= 0 && Named(m->curve[3 * e + i], m->curve_name, joints->named[k].name))
          own[i] = place[k];
    }
  }
  PetscCall(PetscFree(place));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckJoints(const Model *a, int first)
{
  for (int e = first; e < a->nelements; e++) {
    if (a->jointed[e] && a->six_node[e])
      return ModelRefuse("six-node triangles (order 2) have no joints: they do not crack");
    for (int i = 0; i < 3; i++) {
      const int own = a->joint_material[3 * e + i];
      const Material *of = &a->material[own >= 0 ? own : a->element_material[e]];
      if ((a->jointed[e] >> i & 1) && !CheckStrengths(of))
        return ModelRefuse(
            "joints need tensile_strength, shear_strength and fracture_energy, which material '%s' has "
            "not",
            of->name);
    }
  }
  return 0;
}

PetscErrorCode ModelAdd(Model *a, const MeshSerial *mesh, const BodySetup *setup, const char **error)
{
  int *renumber;
  Body body = {.material = setup->material, .first_element = a->nelements, .entry = setup->entry};
  PetscErrorCode code;
  PetscFunctionBeginUser;
  *error = ModelReason();
  if ((code = ModelCheck(mesh, setup))) PetscFunctionReturn(code);
  PetscCall(PetscMalloc1((size_t)mesh->nv, &renumber));
  NumberNodes(a, mesh, renumber);
  PetscCall(GrowNodes(a, a->nnodes + CountNodes(mesh, renumber)));
  RestNodes(a, mesh, renumber);
  PetscCall(AddElements(a, mesh, setup, renumber));
  PetscCall(GiveMaterials(a, mesh, setup, body.first_element));
  MassCentre(a, body.first_element, body.centre);
  PlaceNodes(a, mesh, setup, body.centre, renumber);
  FixNodes(a, mesh, setup, renumber);
  PetscCall(PrescribeNodes(a, mesh, setup, renumber));
  PetscCall(ModelAddLoads(a, mesh, setup, body.first_element, renumber));
  PetscCall(GiveJoints(a, mesh, &setup->joints, body.first_element));
  if ((code = CheckJoints(a, body.first_element))) PetscFunctionReturn(code);
  PetscCall(PetscFree(renumber));
  PetscCall(PetscRealloc((size_t)(a->nbodies + 1) * sizeof *a->body, &a->body));
  a->body[a->nbodies++] = body;
  code = AddSurface(a, body.first_element); /* a refusal carries no trace-back */
  if (!code) code = ModelMeasureRigid(a, setup, body.first_element, &a->body[a->nbodies - 1]);
  PetscFunctionReturn(code);
}
