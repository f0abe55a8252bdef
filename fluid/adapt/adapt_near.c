#include "fluid/adapt/adapt_near.h"
#include <string.h>

/* Another pass is worth its while below this share of unit edges at frozen vertices, or beyond these bounds.
 */
#define UNIT_SHARE 0.95
#define LONGEST 1.6
#define SHORTEST 0.4
#define WORST 0.3

/* Of faces at frozen vertices, and at those where a triangle is poor or an edge is not unit. */
enum { WEIGHT = 64, WEIGHT_POOR = 4096 };
#define POOR 0.4

/* Distances from 0 on. */
static void Spread(const MeshSerial *m, int distance[])
{
  for (int d = 0; d < NEAR_FAR - 1; d++) {
    for (int e = 0; e < m->ne; e++) {
      const int *v = &m->vertex[3 * e];
      if (distance[v[0]] != d && distance[v[1]] != d && distance[v[2]] != d) continue;
      for (int i = 0; i < 3; i++) distance[v[i]] = PetscMin(distance[v[i]], d + 1);
    }
  }
}

void NearDistances(const AdaptResult *r, const char frozen[], int distance[])
{
  for (int v = 0; v < r->mesh.nv; v++) distance[v] = r->origin[v] >= 0 && frozen[r->origin[v]] ? 0 : NEAR_FAR;
  Spread(&r->mesh, distance);
}

/* Halved with every edge away, from `most` on. */
static void AddWeights(const MeshSerial *m, const int distance[], int most, int weight[])
{
  for (int c = 0; c < 3 * m->ne; c++)
    weight[c] += most >> PetscMin(distance[m->vertex[Next(c)]], distance[m->vertex[Prev(c)]]);
}

PetscErrorCode NearWeights(const AdaptResult *r, const int distance[], int weight[])
{
  const MeshSerial *m = &r->mesh;
  int *poor; /* distance from frozen vertices where something does not fit */
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(m->nv, &poor));
  for (int v = 0; v < m->nv; v++) poor[v] = NEAR_FAR;
  for (int c = 0; c < 3 * m->ne; c++) {
    const int p = m->vertex[Next(c)], q = m->vertex[Prev(c)];
    if ((distance[p] && distance[q]) ||
        (AdaptIsUnit(AdaptMeshLength(m, r->metric, p, q)) && AdaptMeshQuality(m, r->metric, c / 3) > POOR))
      continue;
    if (!distance[p]) poor[p] = 0;
    if (!distance[q]) poor[q] = 0;
  }
  Spread(m, poor);
  for (int c = 0; c < 3 * m->ne; c++) weight[c] = 1;
  AddWeights(m, distance, WEIGHT, weight);
  AddWeights(m, poor, WEIGHT_POOR, weight);
  PetscCall(PetscFree(poor));
  PetscFunctionReturn(0);
}

/* Edges at frozen vertices of a triangle that has some. */
static void MeasureTriangle(const AdaptResult *r, int e, const int distance[], Near *near)
{
  const int *v = &r->mesh.vertex[3 * e];
  for (int i = 0; i < 3; i++) {
    const int p = v[(i + 1) % 3], q = v[(i + 2) % 3];
    if (distance[p] && distance[q]) continue;
    const double length = AdaptMeshLength(&r->mesh, r->metric, p, q);
    near->edges++;
    near->unit += AdaptIsUnit(length);
    near->shortest = fmin(near->shortest, length);
    near->longest = fmax(near->longest, length);
  }
  near->quality_worst = fmin(near->quality_worst, AdaptMeshQuality(&r->mesh, r->metric, e));
}

void NearMeasure(const AdaptResult *r, const int distance[], int cut, Near *near)
{
  *near = (Near){.triangles = r->mesh.ne, .shortest = INFINITY, .quality_worst = INFINITY};
  for (int e = 0; e < r->mesh.ne; e++) {
    const int *v = &r->mesh.vertex[3 * e];
    if (!distance[v[0]] || !distance[v[1]] || !distance[v[2]]) MeasureTriangle(r, e, distance, near);
  }
  for (int k = 0; k < r->mesh.nb; k++) {
    if (r->mesh.facet_tag[k] != cut) continue;
    near->cut++;
    near->cut_unit +=
        AdaptIsUnit(AdaptMeshLength(&r->mesh, r->metric, r->mesh.facet[2 * k], r->mesh.facet[2 * k + 1]));
  }
}

/* An edge between ranks counts on both. */
static void Sum(const long long sum[], AdaptReport *all)
{
  all->edges = (int)(sum[0] - sum[2] / 2);
  all->edges_unit = (int)(sum[1] - sum[3] / 2);
  all->splits += (int)sum[6];
  all->collapses += (int)sum[7];
  all->swaps += (int)sum[8];
  all->moves += (int)sum[9];
}

PetscErrorCode NearReduce(MPI_Comm comm, const Near *near, const AdaptReport *own, AdaptReport *all,
                          bool *fits)
{
  const bool some = near->triangles > 0;
  long long sum[] = {own->edges, own->edges_unit, near->cut,      near->cut_unit, near->edges,
                     near->unit, own->splits,     own->collapses, own->swaps,     own->moves};
  double worst[] = {some ? own->shortest : INFINITY,
                    some ? -own->longest : INFINITY,
                    some ? own->quality_worst : INFINITY,
                    near->shortest,
                    -near->longest,
                    near->quality_worst,
                    -own->rounds};
  double mean[] = {near->triangles * own->quality_mean, near->triangles};
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 10, MPI_LONG_LONG, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, worst, 7, MPI_DOUBLE, MPI_MIN, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, mean, 2, MPI_DOUBLE, MPI_SUM, comm));
  Sum(sum, all);
  all->rounds += (int)-worst[6];
  all->shortest = worst[0];
  all->longest = -worst[1];
  all->quality_worst = worst[2];
  all->quality_mean = mean[0] / mean[1];
  *fits = (double)sum[5] >= UNIT_SHARE * (double)sum[4] && worst[3] >= SHORTEST && -worst[4] <= LONGEST &&
          worst[5] >= WORST;
  PetscFunctionReturn(0);
}
