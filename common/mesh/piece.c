#include "piece.h"
#include <string.h>

PetscErrorCode MeshPieceDestroy(MeshPiece *piece)
{
  PetscFunctionBeginUser;
  PetscCall(MeshSerialDestroy(&piece->serial));
  PetscCall(PetscFree(piece->gid));
  PetscFunctionReturn(0);
}

static PetscErrorCode CopyVertices(const Mesh *m, MeshPiece *piece)
{
  MeshSerial *s = &piece->serial;
  PetscFunctionBeginUser;
  for (int k = 0; k < 3 * m->ne; k++) s->nv = PetscMax(s->nv, m->vertex[k] + 1);
  PetscCall(PetscMalloc1(2 * s->nv, &s->x));
  PetscCall(PetscMalloc1(s->nv, &piece->gid));
  PetscCall(PetscArraycpy(s->x, m->x, 2 * s->nv));
  for (int k = 0; k < 3 * m->ne; k++) piece->gid[m->vertex[k]] = m->p2gid[m->p2[6 * (k / 3) + k % 3]];
  PetscFunctionReturn(0);
}

PetscErrorCode MeshPieceOf(const Mesh *m, MeshPiece *piece)
{
  MeshSerial *s = &piece->serial;
  PetscFunctionBeginUser;
  memset(piece, 0, sizeof *piece);
  s->ne = m->ne;
  PetscCall(CopyVertices(m, piece));
  PetscCall(PetscMalloc1(3 * m->ne, &s->vertex));
  PetscCall(PetscArraycpy(s->vertex, m->vertex, 3 * m->ne));
  for (int k = 0; k < 3 * m->ne; k++) s->nb += m->tag[k] >= 0;
  PetscCall(PetscMalloc1(2 * s->nb, &s->facet));
  PetscCall(PetscMalloc1(s->nb, &s->facet_tag));
  for (int k = 0, b = 0; k < 3 * m->ne; k++) {
    if (m->tag[k] < 0) continue;
    s->facet[2 * b] = m->vertex[k - k % 3 + (k + 1) % 3];
    s->facet[2 * b + 1] = m->vertex[k - k % 3 + (k + 2) % 3];
    s->facet_tag[b++] = m->tag[k];
  }
  s->ntags = m->ntags;
  PetscCall(PetscMalloc1(m->ntags, &s->tag_name));
  if (m->ntags) memcpy(s->tag_name, m->tag_name, (size_t)m->ntags * sizeof *m->tag_name);
  PetscFunctionReturn(0);
}
