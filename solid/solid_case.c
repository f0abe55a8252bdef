#include "solid/solid_case.h"
#include "common/output/options.h"
#include "common/supermesh/geometry.h"
#include "solid/bodies/case_body.h"
#include "solid/point_in_body.h"
#include "solid/probes.h"
#include <float.h>
#include <stdio.h>

/* Friction and damping of walls; absent: those of what touches them. */
static void ReadWallContact(CoracleCase c, SolidSetup *setup)
{
  const bool friction = CoracleCaseHas(c, "solid.walls.friction"),
             damping = CoracleCaseHas(c, "solid.walls.contact_damping");
  setup->rough_walls = PETSC_TRUE;
  setup->wall_friction = friction ? CoracleCaseNumber(c, "solid.walls.friction", 0.0, HUGE_VAL) : -1.0;
  setup->wall_damping = damping ? CoracleCaseNumber(c, "solid.walls.contact_damping", 0.0, 10.0) : -1.0;
}

/* The element of the model that is at the point at the start, or nearly, and the point in it; not of body `except`.  How far the nearest one is, m: 0
 * if there is one. */
static double FindElement(const Model *a, const double point[2], int except, SpringEnd *end)
{
  double nearest = HUGE_VAL, size = 0.0;
  for (int e = 0; e < a->nelements; e++) {
    double corner[3][2], w[3];
    if (a->element_body[e] == except) continue;
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) corner[i][c] = a->x[2 * a->element[3 * e + i] + c];
    GeometryBarycentric((const double(*)[2])corner, point, w);
    const PetscBool inside = (PetscBool)(fmin(w[0], fmin(w[1], w[2])) > -POINT_ON_EDGE);
    const double distance = inside ? 0.0 : GeometrySideDistance((const double(*)[2])corner, point);
    if (distance >= nearest) continue;
    nearest = distance;
    size = sqrt(2.0 * GeometryArea((const double(*)[2])corner));
    end->element = e;
    for (int i = 0; i < 3; i++) end->weight[i] = w[i];
    if (inside) break;
  }
  return nearest <= POINT_NEAR * size ? 0.0 : nearest;
}

/* Both ends; other[2]: where the other one is at the start. */
static void ReadSpringEnds(CoracleCase c, const Model *a, int k, Spring *s, double point[2], double other[2])
{
  char key[CASE_KEY], anchor[CASE_KEY];
  CoracleCaseVector(c, CaseKey(key, "solid.springs[%d].point", k), 2, point);
  double distance = FindElement(a, point, -1, &s->end[0]);
  if (distance > 0.0)
    CoracleCaseRefuse(c, key, "no body is at (%g, %g); the nearest is %.3g m away", point[0], point[1],
                      distance);
  s->anchored = CoracleCaseHas(c, CaseKey(anchor, "solid.springs[%d].anchor", k));
  CaseKey(key, "solid.springs[%d].other_point", k);
  if (s->anchored == CoracleCaseHas(c, key))
    CoracleCaseRefuse(c, s->anchored ? key : anchor, "expected an anchor or an other_point");
  CoracleCaseVector(c, s->anchored ? anchor : key, 2, other);
  for (int i = 0; i < 2; i++) s->anchor[i] = s->anchored ? other[i] : 0.0;
  if (!s->anchored) distance = FindElement(a, other, a->element_body[s->end[0].element], &s->end[1]);
  if (distance == HUGE_VAL) CoracleCaseRefuse(c, key, "there is no other body");
  if (distance > 0.0)
    CoracleCaseRefuse(c, key, "no other body is at (%g, %g); the nearest is %.3g m away", other[0], other[1],
                      distance);
}

static void ReadSpring(CoracleCase c, const Model *a, int k, Spring *s)
{
  static const char *const ACTS[] = {"both", "pull", "push", NULL};
  char key[CASE_KEY];
  double point[2], other[2];
  ReadSpringEnds(c, a, k, s, point, other);
  s->stiffness = CoracleCasePositive(c, CaseKey(key, "solid.springs[%d].stiffness", k));
  s->damping = CoracleCaseNumberOr(c, CaseKey(key, "solid.springs[%d].damping", k), 0.0, 0.0, HUGE_VAL);
  s->length = CoracleCaseHas(c, CaseKey(key, "solid.springs[%d].length", k))
                  ? CoracleCaseNumber(c, key, 0.0, HUGE_VAL)
                  : hypot(other[0] - point[0], other[1] - point[1]);
  s->acts = (SpringActs)CoracleCaseWord(c, CaseKey(key, "solid.springs[%d].acts", k), 0, ACTS);
  if (s->length == 0.0 && s->acts != SPRING_PULLS_AND_PUSHES)
    CoracleCaseRefuse(c, key, "a spring of length 0 acts in all directions");
}

static void ReadSprings(CoracleCase c, const Model *a, SolidSetup *setup)
{
  setup->nsprings = CoracleCaseCount(c, "solid.springs");
  if (setup->nsprings > MAX_SPRINGS)
    CoracleCaseRefuse(c, "solid.springs", "more than %d springs", MAX_SPRINGS);
  for (int k = 0; k < setup->nsprings; k++) ReadSpring(c, a, k, &setup->spring[k]);
}

/* Another body than `body`, or a wall. */
static int ReadOther(CoracleCase c, const char *key, int body, int nbodies, PetscBool walls)
{
  static const char *const WALLS[] = {"left", "right", "bottom", "top"}; /* from WALL_LEFT on */
  const char *other = CoracleCaseString(c, key);
  char *end;
  for (int k = 0; k < 4; k++)
    if (!strcmp(other, WALLS[k])) {
      if (!walls) CoracleCaseRefuse(c, key, "there are no solid.walls");
      return WALL_LEFT + k;
    }
  const long number = strtol(other, &end, 10);
  if (end == other || *end || number < 0 || number >= nbodies || number == body)
    CoracleCaseRefuse(c, key, "expected left, right, bottom, top or the number of another body, less than %d",
                      nbodies);
  return (int)number;
}

static void ReadContactProbes(CoracleCase c, const Model *a, SolidSetup *setup)
{
  const PetscBool walls = (PetscBool)CoracleCaseHas(c, "solid.walls");
  char key[CASE_KEY];
  setup->ncontact_probes = CoracleCaseCount(c, "solid.contact_probes");
  if (setup->ncontact_probes > MAX_CONTACT_PROBES)
    CoracleCaseRefuse(c, "solid.contact_probes", "more than %d probes", MAX_CONTACT_PROBES);
  for (int k = 0; k < setup->ncontact_probes; k++) {
    ContactProbe *p = &setup->contact_probe[k];
    const double body =
        CoracleCaseNumber(c, CaseKey(key, "solid.contact_probes[%d].body", k), 0.0, a->nbodies - 1.0);
    if (body != floor(body)) CoracleCaseRefuse(c, key, "expected a whole number");
    p->body = (int)body;
    p->other = CoracleCaseHas(c, CaseKey(key, "solid.contact_probes[%d].other", k))
                   ? ReadOther(c, key, p->body, a->nbodies, walls)
                   : CONTACT_ANY;
  }
}

static PetscBool IsSamePair(const ContactRule *a, const ContactRule *b)
{
  const int crossed = strcmp(a->between[0], b->between[0]) != 0;
  return (PetscBool)(!strcmp(a->between[0], b->between[crossed]) &&
                     !strcmp(a->between[1], b->between[1 - crossed]));
}

/* The list `contact`: overrides for pairs. */
static void ReadRules(CoracleCase c, SolidSetup *setup)
{
  char key[CASE_KEY];
  setup->nrules = CoracleCaseCount(c, "solid.contact");
  if (setup->nrules > MAX_RULES) CoracleCaseRefuse(c, "solid.contact", "more than %d pairs", MAX_RULES);
  for (int k = 0; k < setup->nrules; k++) {
    ContactRule *r = &setup->rule[k];
    if (CoracleCaseCount(c, CaseKey(key, "solid.contact[%d].between", k)) != 2)
      CoracleCaseRefuse(c, key, "expected two names");
    for (int i = 0; i < 2; i++) {
      const char *name = CoracleCaseString(c, CaseKey(key, "solid.contact[%d].between[%d]", k, i));
      CaseMaterialExists(c, key, name, PETSC_TRUE);
      (void)snprintf(r->between[i], sizeof r->between[i], "%s", name);
    }
    for (int i = 0; i < k; i++)
      if (IsSamePair(r, &setup->rule[i]))
        CoracleCaseRefuse(c, CaseKey(key, "solid.contact[%d].between", k),
                          "an item before this one is of the same pair");
    r->friction = CoracleCaseHas(c, CaseKey(key, "solid.contact[%d].friction", k))
                      ? CoracleCaseNumber(c, key, 0.0, HUGE_VAL)
                      : -1.0;
    r->damping = CoracleCaseHas(c, CaseKey(key, "solid.contact[%d].damping", k))
                     ? CoracleCaseNumber(c, key, 0.0, 10.0)
                     : -1.0;
  }
}

/* By how much x is beyond a wall; a body on a wall is not by the round-off of its coordinates. */
static double Beyond(const SolidSetup *setup, int axis, const double x[2])
{
  return fmax(setup->lower[axis] - x[axis], x[axis] - setup->upper[axis]);
}

static void ReadWalls(CoracleCase c, const Model *a, SolidSetup *setup)
{
  char key[CASE_KEY];
  setup->walls = (PetscBool)CoracleCaseHas(c, "solid.walls");
  if (!setup->walls) return;
  CoracleCaseVector(c, "solid.walls.lower", 2, setup->lower);
  CoracleCaseVector(c, "solid.walls.upper", 2, setup->upper);
  ReadWallContact(c, setup);
  for (int n = 0; n < a->nnodes; n++) {
    const Body *body = &a->body[a->node_body[n]];
    const double *x = body->circle > 0.0 ? body->centre : a->x + 2 * n;
    for (int k = 0; k < 2; k++)
      if (Beyond(setup, k, x) + body->circle > 8.0 * DBL_EPSILON * fmax(fabs(x[0]), fabs(x[1])))
        CoracleCaseRefuse(c, BodyKey(key, body->entry, ""),
                          "the body reaches through solid.walls at (%g, %g)", a->x[2 * n], a->x[2 * n + 1]);
  }
}

PetscBool SolidCasePressureLoad(CoracleCase c)
{
  return (PetscBool)CoracleCaseBoolOr(c, "solid.pressure_load", false);
}

/* The elements keep what they have of the load. */
static void CheckPressureLoad(CoracleCase c, const Model *a)
{
  int jointed = 0;
  for (int k = 0; k < a->nelements; k++) jointed |= a->jointed[k];
  if (SolidCasePressureLoad(c) && jointed)
    CoracleCaseRefuse(
        c, "solid.pressure_load",
        "not possible with joints: the load belongs to elements and to a surface that cracks change");
}

/* Which of the bodies that `repeat` makes of an entry, from 0. */
static int CopyOf(const Model *a, int body)
{
  int copy = 0;
  while (copy < body && a->body[body - copy - 1].entry == a->body[body].entry) copy++;
  return copy;
}

static PetscErrorCode CheckOverlap(CoracleCase c, const Model *a)
{
  ModelPair pair;
  int body[2], own[2];
  char key[CASE_KEY];
  PetscFunctionBeginUser;
  PetscCall(ModelOverlap(a, &pair));
  if (pair.element[0] < 0) PetscFunctionReturn(0);
  for (int i = 0; i < 2; i++) {
    body[i] = a->element_body[pair.element[i]];
    own[i] = pair.element[i] - a->body[body[i]].first_element;
  }
  const Body *one = &a->body[body[0]], *other = &a->body[body[1]];
  const Point at = pair.centre[1];
  BodyKey(key, other->entry, "");
  if (body[0] == body[1])
    CoracleCaseRefuse(
        c, key,
        "its elements %d at (%g, %g) and %d at (%g, %g) overlap and share no node: surfaces of the mesh "
        "that lie over one another must be made one, or apart",
        own[0], pair.centre[0].x, pair.centre[0].y, own[1], at.x, at.y);
  if (one->entry == other->entry)
    CoracleCaseRefuse(c, key, "its copies %d and %d of repeat, counted from 0, overlap at (%g, %g)",
                      CopyOf(a, body[0]), CopyOf(a, body[1]), at.x, at.y);
  CoracleCaseRefuse(c, key, "the body overlaps solid.bodies[%d] at (%g, %g)", one->entry, at.x, at.y);
}

PetscErrorCode SolidCaseRead(CoracleCase c, Model *a, SolidSetup *setup)
{
  const int nbodies = CoracleCaseCount(c, "solid.bodies");
  PetscFunctionBeginUser;
  GravityRead(c, setup->gravity, &setup->gravity_table);
  setup->courant = CoracleCaseNumberOr(c, "solid.courant", 0.8, 0.01, 1.0);
  setup->decay_rate = CoracleCaseNumberOr(c, "solid.decay_rate", 0.0, 0.0, HUGE_VAL);
  setup->rebalance = CoracleCaseNumberOr(c, "solid.rebalance", 200.0, 0.0, HUGE_VAL);
  CoracleCaseKeys(c, "solid.materials", CaseCheckMaterial, c);
  if (!CoracleCaseHas(c, "solid.bodies"))
    CoracleCaseRefuse(c, "solid.bodies", "expected a list of bodies; of a fluid alone an empty one, []");
  for (int b = 0; b < nbodies; b++) PetscCall(CaseReadBody(c, b, a));
  CheckPressureLoad(c, a);
  ReadWalls(c, a, setup);
  ReadRules(c, setup);
  ReadSprings(c, a, setup);
  ReadContactProbes(c, a, setup);
  ProbesCheckCase(c);
  PetscCall(CheckOverlap(c, a));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidFromCase(CoracleCase c, MPI_Comm comm, Solid *solid)
{
  static const char *const SECTIONS[] = {"solid", NULL};
  SolidSetup setup = {0};
  Model model = {0};
  char option[256];
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsInsertString(NULL, CoracleCaseStringOr(c, "solid.petsc", "")));
  PetscCall(SolidCaseRead(c, &model, &setup));
  PetscCall(CoracleCaseFinish(c, SECTIONS));
  PetscCall(SolidCreate(comm, &model, &setup, solid));
  PetscCall(OptionsUnused(CoracleCaseStringOr(c, "solid.petsc", ""), NULL, sizeof option, option));
  if (option[0])
    CoracleCaseRefuse(c, "solid.petsc",
                      "nothing in the solid has the option %s: those of its solver begin with -response_",
                      option);
  PetscCall(ModelDestroy(&model));
  PetscFunctionReturn(0);
}
