/* Private to the Gmsh reader: what a file says, before it is judged.  Functions return 0 or a PETSc error
 * code, without a trace-back: GmshRefuse has written why. */
#ifndef CORACLE_MESH_GMSH_IMPL_H
#define CORACLE_MESH_GMSH_IMPL_H
#include "common/mesh/mesh.h"

typedef struct {
  int tag;
  double x[3];
} GmshNode;

/* A line (node[0], node[1]) or a triangle; as it is read, one of second order, too. */
typedef struct {
  long number;
  int node[6];  /* node tags */
  int physical; /* tag of its physical group, 0: none */
} GmshElement;

typedef struct {
  int dim, tag;
  char name[64];
} GmshName;

/* A curve or surface of the geometry that is in a physical group. */
typedef struct {
  int dim, tag, physical;
} GmshEntity;

typedef struct {
  const char *path;
  char *data; /* the whole file, ended by a 0 */
  size_t size, at;
  int binary, version; /* version: 22 or 41 */
  int order;           /* of its triangles; 0: none yet */
  size_t nnode, nline, ntriangle, nname, nentity;
  size_t line_capacity, triangle_capacity, entity_capacity;
  GmshNode *node;
  GmshElement *line, *triangle;
  GmshName *name;
  GmshEntity *entity;
} GmshFile;

/* Writes "<path>: <message>" where MeshReadGmsh's *error points to. */
PetscErrorCode GmshRefuse(const GmshFile *file, const char *format, ...) PETSC_ATTRIBUTE_FORMAT(2, 3);
/* Reads file->path into the lists above. */
PetscErrorCode GmshParse(GmshFile *file);

/* mesh_gmsh_formats.c: the sections of these names, of the format of this number. */
PetscErrorCode GmshNodes22(GmshFile *f);
PetscErrorCode GmshElements22(GmshFile *f);
PetscErrorCode GmshEntities41(GmshFile *f);
PetscErrorCode GmshNodes41(GmshFile *f);
PetscErrorCode GmshElements41(GmshFile *f);

/* mesh_gmsh_scan.c: the number at file->at, and behind it. */
PetscErrorCode GmshInteger(GmshFile *f, int *value);
PetscErrorCode GmshDoubles(GmshFile *f, int n, double *value);
/* Unsigned: size_t in binary files of 4.1. */
PetscErrorCode GmshSize(GmshFile *f, size_t *value);
PetscErrorCode GmshTag(GmshFile *f, int *tag);
/* A count of things that take at least `bytes` each, which must fit into the rest of the file. */
PetscErrorCode GmshCount(GmshFile *f, size_t bytes, size_t *count);
/* A count at the head of a section, text in binary files of 2.2 too. */
PetscErrorCode GmshTextCount(GmshFile *f, size_t *count);

#define GMSH_TRY(call)                                                                                       \
  do {                                                                                                       \
    const PetscErrorCode code_ = (call);                                                                     \
    if (code_) return code_;                                                                                 \
  } while (0)
#endif
