#include "fluid/phases/flux.h"
#include <math.h>

enum { STAR_MAX = 256 };

typedef struct {
  const Stars *s;
  const FluxBoundary *boundary;
  double (*u)[6];         /* [nl] */
  double (*moment)[3][2]; /* [nl] prescribed on boundary faces, or NULL */
  double (*part)[3][2];   /* [ne] outward flux of face i by its first and second vertex */
  double defect;
  const double *weight; /* [nl] or NULL */
} Balance;

/* A chain of elements around a vertex, counter-clockwise; edge k lies before element k. */
typedef struct {
  int n, closed;
  int corner[STAR_MAX]; /* 3 element + corner at the vertex */
  double r[STAR_MAX], phi[STAR_MAX + 1];
} Chain;

/* Face from which the element begins, seen counter-clockwise from its corner; the one at which it ends. */
static int FirstFace(int corner)
{
  return (corner % 3 + 2) % 3;
}

static int LastFace(int corner)
{
  return (corner % 3 + 1) % 3;
}

static void Ends(const StarElement *element, int face, double *length, double normal[2])
{
  const double *a = element->x[(face + 1) % 3], *b = element->x[(face + 2) % 3];
  *length = sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]));
  normal[0] = (b[1] - a[1]) / *length;
  normal[1] = (a[0] - b[0]) / *length;
}

/* u.n of element e at its corner i. */
static double Normal(const Balance *w, int e, int i, const double n[2])
{
  return w->u[e][i] * n[0] + w->u[e][3 + i] * n[1];
}

static int CornerOf(const Stars *s, int e, int v)
{
  return s->vertex[e][0] == v ? 0 : s->vertex[e][1] == v ? 1 : 2;
}

/* {u}.n, outward, at the face's vertex that is corner i of e. */
static double MeanNormal(const Balance *w, int e, int face, int i, const double n[2])
{
  const int o = w->s->neighbor[e][face];
  const double own = Normal(w, e, i, n);
  return o < 0 ? own : 0.5 * (own + Normal(w, o, CornerOf(w->s, o, w->s->vertex[e][i]), n));
}

/* int_f lambda {u}.n outward of e, lambda the hat function of corner i. */
static double Guess(const Balance *w, int e, int face, int i, double *length)
{
  const int other = 3 - face - i;
  double n[2];
  Ends(&w->s->element[e], face, length, n);
  return *length / 6.0 * (2.0 * MeanNormal(w, e, face, i, n) + MeanNormal(w, e, face, other, n));
}

static int IsOpen(const Balance *w, int e, int face)
{
  const int tag = w->s->element[e].tag[face];
  return w->boundary && w->boundary->open && w->boundary->open[tag];
}

/* The prescribed flux out of a boundary face by its vertex at corner i. */
static double Prescribed(const Balance *w, int e, int face, int i)
{
  return w->moment ? w->moment[e][face][i == (face + 1) % 3 ? 0 : 1] : 0.0;
}

/* int_K u . grad(lambda_i) */
static double Residual(const Balance *w, int e, int i)
{
  const double(*x)[2] = (const double(*)[2])w->s->element[e].x, *u = w->u[e];
  const double *a = x[(i + 1) % 3], *b = x[(i + 2) % 3];
  /* |K| grad(lambda_i) = half of the edge opposite, turned inward */
  return ((a[1] - b[1]) * (u[0] + u[1] + u[2]) + (b[0] - a[0]) * (u[3] + u[4] + u[5])) / 6.0;
}

/* The chain that resumes from an element until a boundary or around. */
static void Follow(const Balance *w, int v, int first, Chain *c)
{
  int at = first;
  c->n = c->closed = 0;
  while (c->n < STAR_MAX) {
    c->corner[c->n] = at;
    c->r[c->n++] = Residual(w, at / 3, at % 3);
    const int next = w->s->neighbor[at / 3][LastFace(at)];
    if (next < 0) return;
    at = 3 * next + CornerOf(w->s, next, v);
    if (at == first) {
      c->closed = 1;
      return;
    }
  }
}

/* Spreads what does not close. */
static void Spread(Balance *w, double defect, Chain *c)
{
  w->defect = fmax(w->defect, fabs(defect));
  double sum = 0.0;
  for (int k = 0; k < c->n && w->weight; k++) sum += w->weight[c->corner[k] / 3];
  for (int k = 0; k < c->n; k++)
    c->r[k] -= sum > 0.0 ? defect * w->weight[c->corner[k] / 3] / sum : defect / c->n;
}

static void Walk(Chain *c)
{
  for (int k = 0; k < c->n; k++) c->phi[k + 1] = c->phi[k] + c->r[k];
}

/* The constant that brings phi closest to the mean of both sides. */
static void Shift(const Balance *w, Chain *c)
{
  double top = 0.0, bottom = 0.0, length;
  for (int k = 0; k < c->n + !c->closed; k++) {
    const int last = k == c->n, at = c->corner[last ? k - 1 : k];
    const double guess = Guess(w, at / 3, last ? LastFace(at) : FirstFace(at), at % 3, &length);
    top += ((last ? guess : -guess) - c->phi[k]) / length;
    bottom += 1.0 / length;
  }
  for (int k = 0; k <= c->n; k++) c->phi[k] += top / bottom;
}

static void Solve(Balance *w, Chain *c)
{
  const int first = c->corner[0], last = c->corner[c->n - 1];
  double sum = 0.0;
  for (int k = 0; k < c->n; k++) sum += c->r[k];
  c->phi[0] = 0.0;
  if (c->closed) {
    Spread(w, sum, c);
    Walk(c);
    Shift(w, c);
    return;
  }
  const int open[2] = {IsOpen(w, first / 3, FirstFace(first)), IsOpen(w, last / 3, LastFace(last))};
  const double begin = open[0] ? 0.0 : -Prescribed(w, first / 3, FirstFace(first), first % 3);
  const double end = open[1] ? 0.0 : Prescribed(w, last / 3, LastFace(last), last % 3);
  c->phi[0] = open[0] ? end - sum : begin;
  if (!open[0] && !open[1]) Spread(w, sum - (end - begin), c);
  Walk(c);
  if (open[0] && open[1]) Shift(w, c);
  if (!open[1]) c->phi[c->n] = end;
}

/* Where the chains of a vertex begin: on the boundary, or at its first element. */
static void AroundVertex(Balance *w, int v, Chain *c)
{
  const Stars *s = w->s;
  int begins = 0;
  for (int k = s->start[v]; k <= s->start[v + 1]; k++) {
    const int whole = k == s->start[v + 1], at = s->around[whole ? s->start[v] : k];
    if (whole ? begins > 0 : s->neighbor[at / 3][FirstFace(at)] >= 0) continue;
    begins++;
    Follow(w, v, at, c);
    Solve(w, c);
    for (int j = 0; j < c->n; j++) {
      const int e = c->corner[j] / 3, next = c->closed && j + 1 == c->n ? 0 : j + 1;
      if (e >= s->ne) continue;
      w->part[e][FirstFace(c->corner[j])][0] = -c->phi[j];
      w->part[e][LastFace(c->corner[j])][1] = c->phi[next];
    }
  }
}

void FluxLinearField(const StarElement *element, const double normal[3][2], double beta[6])
{
  double length, n[3][2];
  for (int i = 0; i < 3; i++) Ends(element, i, &length, n[i]);
  for (int i = 0; i < 3; i++) {
    const int p = FirstFace(i), q = LastFace(i);
    const double a = normal[p][0], b = normal[q][1], det = n[p][0] * n[q][1] - n[p][1] * n[q][0];
    beta[i] = (a * n[q][1] - b * n[p][1]) / det;
    beta[3 + i] = (n[p][0] * b - n[q][0] * a) / det;
  }
}

void FluxNormalParts(const StarElement *element, const double u[6], int i, double normal[2], double *length)
{
  double n[2];
  Ends(element, i, length, n);
  for (int k = 0; k < 2; k++) {
    const int v = (i + 1 + k) % 3;
    normal[k] = u[v] * n[0] + u[3 + v] * n[1];
  }
}

static void Field(const Balance *w, int e, const double flux[3], double beta[6])
{
  const StarElement *element = &w->s->element[e];
  double normal[3][2];
  for (int i = 0; i < 3; i++) {
    double length, n[2];
    Ends(element, i, &length, n);
    double half = 0.5 * (MeanNormal(w, e, i, (i + 2) % 3, n) - MeanNormal(w, e, i, (i + 1) % 3, n));
    if (element->tag[i] >= 0 && !IsOpen(w, e, i))
      half = 3.0 / length * (Prescribed(w, e, i, (i + 2) % 3) - Prescribed(w, e, i, (i + 1) % 3));
    normal[i][0] = flux[i] / length - half;
    normal[i][1] = flux[i] / length + half;
  }
  FluxLinearField(element, (const double(*)[2])normal, beta);
}

static PetscErrorCode Report(const Balance *w, const double flux[], FluxReport *report)
{
  double top[3] = {w->defect, 0.0, 0.0}, square[2] = {0.0, 0.0}, length;
  PetscFunctionBeginUser;
  for (int e = 0; e < w->s->ne; e++) {
    const double *f = &flux[3 * e];
    top[1] = fmax(top[1], fabs(f[0] + f[1] + f[2]));
    for (int i = 0; i < 3; i++) {
      top[2] = fmax(top[2], fabs(f[i]));
      if (w->s->element[e].tag[i] >= 0) continue;
      const double mean = Guess(w, e, i, (i + 1) % 3, &length) + Guess(w, e, i, (i + 2) % 3, &length);
      square[0] += (f[i] - mean) * (f[i] - mean);
      square[1] += mean * mean;
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, top, 3, MPI_DOUBLE, MPI_MAX, w->s->mesh->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, square, 2, MPI_DOUBLE, MPI_SUM, w->s->mesh->comm));
  *report = (FluxReport){top[0], top[1], top[2], square[1] > 0.0 ? sqrt(square[0] / square[1]) : 0.0};
  PetscFunctionReturn(0);
}

static PetscErrorCode Begin(const Stars *s, const double u[], const FluxBoundary *boundary, Balance *w)
{
  PetscFunctionBeginUser;
  *w = (Balance){.s = s, .boundary = boundary, .weight = boundary ? boundary->weight : NULL};
  PetscCall(PetscMalloc2(s->nl, &w->u, s->ne, &w->part));
  if (s->ne) PetscCall(PetscArraycpy(&w->u[0][0], u, 6 * s->ne));
  PetscCall(StarsExchange(s, sizeof *w->u, w->u));
  if (boundary && boundary->moment) {
    PetscCall(PetscMalloc1(s->nl, &w->moment));
    if (s->ne) PetscCall(PetscArraycpy(&w->moment[0][0][0], boundary->moment, 6 * s->ne));
    PetscCall(StarsExchange(s, sizeof *w->moment, w->moment));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode FluxEquilibrate(const Stars *s, const double u[], const FluxBoundary *boundary, double flux[],
                               double beta[], FluxReport *report)
{
  Balance w;
  Chain *chain;
  PetscFunctionBeginUser;
  PetscCall(Begin(s, u, boundary, &w));
  PetscCall(PetscNew(&chain));
  for (int v = 0; v < s->nowned; v++) {
    PetscCheck(s->start[v + 1] - s->start[v] <= STAR_MAX, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
               "%d elements around the vertex at (%g, %g): at most %d are possible",
               s->start[v + 1] - s->start[v], s->point[v][0], s->point[v][1], STAR_MAX);
    AroundVertex(&w, v, chain);
  }
  for (int e = 0; e < s->ne; e++) {
    for (int i = 0; i < 3; i++) flux[3 * e + i] = w.part[e][i][0] + w.part[e][i][1];
    if (beta) Field(&w, e, &flux[3 * e], &beta[6 * e]);
  }
  if (report) PetscCall(Report(&w, flux, report));
  PetscCall(PetscFree(chain));
  PetscCall(PetscFree2(w.u, w.part));
  PetscCall(PetscFree(w.moment));
  PetscFunctionReturn(0);
}

PetscErrorCode FluxVertexVelocity(const Stars *s, const double beta[], double velocity[])
{
  double(*all)[6], (*mean)[2];
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(s->nl, &all, s->nowned, &mean));
  if (s->ne) PetscCall(PetscArraycpy(&all[0][0], beta, 6 * s->ne));
  PetscCall(StarsExchange(s, sizeof *all, all));
  for (int v = 0; v < s->nowned; v++) {
    double sum[2] = {0.0, 0.0}, weight = 0.0;
    for (int k = s->start[v]; k < s->start[v + 1]; k++) {
      const int e = s->around[k] / 3, i = s->around[k] % 3;
      const double area = StarsTwiceArea(s, e);
      for (int c = 0; c < 2; c++) sum[c] += area * all[e][3 * c + i];
      weight += area;
    }
    for (int c = 0; c < 2; c++) mean[v][c] = sum[c] / weight;
  }
  for (int k = 0; k < 6 * s->ne; k++) velocity[k] = mean[s->vertex[k / 6][k / 2 % 3]][k % 2];
  PetscCall(PetscFree2(all, mean));
  PetscFunctionReturn(0);
}
