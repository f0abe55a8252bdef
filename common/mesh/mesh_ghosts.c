#include "common/mesh/mesh_build.h"
#include "common/mesh/mesh_table.h"
#include <string.h>

static int ByNumber(const void *p, const void *q)
{
  const Ghost *a = p, *b = q;
  if (a->egid != b->egid) return a->egid < b->egid ? -1 : 1;
  return (a->face > b->face) - (a->face < b->face);
}

/* What this rank tells about its element at open face k; the target is numbered as the receiver's part. */
static Ghost Tell(const Build *b, const Mesh *m, int k)
{
  const PartFaces *f = &b->faces;
  const int ef = f->open[k], v = b->part->vertex[ef];
  Ghost g = {.target = f->across[k] - 3 * f->start[f->across_rank[k]],
             .egid = m->estart + b->number[ef / 3],
             .vgid = b->vgid[v],
             .face = ef % 3};
  memcpy(g.x, &b->part->x[2 * v], sizeof g.x);
  return g;
}

/* The ghosts' local numbers follow those of the owned elements; one may lie behind several faces. */
static void Number(Ghosts *g, Mesh *m)
{
  m->ng = 0;
  for (int k = 0; k < g->n; k++) {
    if (k == 0 || g->ghost[k].egid != g->ghost[k - 1].egid) m->ng++;
    g->ghost[k].element = m->ne + m->ng - 1;
  }
}

PetscErrorCode GhostsCreate(const Build *b, Mesh *m, Ghosts *g)
{
  const PartFaces *f = &b->faces;
  int *to, n = 0;
  Scatter scatter;
  Ghost *told;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(f->nopen, &to, f->nopen, &told));
  for (int k = 0; k < f->nopen; k++) {
    if (f->across[k] < 0) continue;
    to[n] = f->across_rank[k];
    told[n++] = Tell(b, m, k);
  }
  PetscCall(ScatterCreate(m->comm, n, to, NULL, &scatter));
  g->n = ScatterArriving(scatter);
  PetscCall(PetscMalloc1(g->n, &g->ghost));
  PetscCall(ScatterForward(scatter, sizeof *told, told, g->ghost));
  PetscCall(ScatterDestroy(&scatter));
  PetscCall(PetscFree2(to, told));
  if (g->n) qsort(g->ghost, (size_t)g->n, sizeof *g->ghost, ByNumber);
  Number(g, m);
  PetscFunctionReturn(0);
}

PetscErrorCode GhostsDestroy(Ghosts *g)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(g->ghost));
  PetscFunctionReturn(0);
}

static int *Find(MeshTable *vertices, long long vgid)
{
  return MeshTableAt(vertices, (int)(vgid >> 32), (int)vgid);
}

/* Faces lead to the ghosts; two corners of a ghost are those of the face, turned round, the third comes with
 * it. */
static void Attach(const Build *b, const Ghost *g, MeshTable *vertices, Mesh *m)
{
  const int e = b->number[g->target / 3], i = (int)(g->target % 3), face = g->face;
  int *opposite = Find(vertices, g->vgid), *corner = &m->vertex[3 * g->element];
  m->neighbor[3 * e + i] = g->element;
  m->neighbor_face[3 * e + i] = face;
  m->egid[g->element] = (PetscInt)g->egid;
  corner[(face + 1) % 3] = m->vertex[3 * e + (i + 2) % 3];
  corner[(face + 2) % 3] = m->vertex[3 * e + (i + 1) % 3];
  if (*opposite < 0) {
    *opposite = m->nv;
    m->vgid[m->nv] = (PetscInt)g->vgid;
    memcpy(&m->x[2 * m->nv++], g->x, sizeof g->x);
  }
  corner[face] = *opposite;
}

PetscErrorCode GhostsFill(const Build *b, const Ghosts *g, Mesh *m)
{
  const PartFaces *f = &b->faces;
  MeshTable vertices; /* an owned vertex of a ghost is open */
  PetscFunctionBeginUser;
  PetscCall(MeshTableCreate(&vertices, (size_t)(f->nopen_vertices + g->n)));
  for (int k = 0; k < f->nopen_vertices; k++)
    *Find(&vertices, b->vgid[f->open_vertex[k]]) = b->vertex[f->open_vertex[k]];
  for (int k = 0; k < g->n; k++) Attach(b, &g->ghost[k], &vertices, m);
  PetscCall(MeshTableDestroy(&vertices));
  PetscFunctionReturn(0);
}
