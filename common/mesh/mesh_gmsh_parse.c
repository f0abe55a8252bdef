/* The sections of a Gmsh file, and those that both formats share (mesh_gmsh_formats.c has the others). */
#include "common/mesh/mesh_gmsh_impl.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static PetscErrorCode PhysicalNames(GmshFile *f)
{
  const int binary = f->binary;
  size_t n = 0;
  f->binary = 0; /* names are text always */
  GMSH_TRY(GmshCount(f, 2, &n));
  GMSH_TRY(PetscRealloc(n * sizeof *f->name, &f->name));
  for (f->nname = 0; f->nname < n; f->nname++) {
    GmshName *name = &f->name[f->nname];
    GMSH_TRY(GmshInteger(f, &name->dim));
    GMSH_TRY(GmshInteger(f, &name->tag));
    const char *from = f->data + f->at + strspn(f->data + f->at, " \t");
    const char *to = *from == '"' ? strpbrk(from + 1, "\"\n") : NULL;
    if (!to || *to != '"')
      return GmshRefuse(f, "the name of physical group %d is not in quotation marks", name->tag);
    const size_t length = (size_t)(to - from - 1);
    if (!length || length >= sizeof name->name) {
      return GmshRefuse(f, "the name of physical group %d has %zu characters: 1 to 63 are allowed", name->tag,
                        length);
    }
    memcpy(name->name, from + 1, length);
    name->name[length] = 0;
    f->at = (size_t)(to + 1 - f->data);
  }
  f->binary = binary;
  return 0;
}

static PetscErrorCode Format(GmshFile *f)
{
  double version;
  int kind, bytes, one;
  GMSH_TRY(GmshDoubles(f, 1, &version));
  GMSH_TRY(GmshInteger(f, &kind));
  GMSH_TRY(GmshInteger(f, &bytes));
  if (version != 2.2 && version != 4.1)
    return GmshRefuse(f, "format %g: 2.2 and 4.1 are understood (gmsh -format msh41)", version);
  if (bytes != 8) return GmshRefuse(f, "numbers of %d bytes: 8 are expected", bytes);
  f->version = version == 2.2 ? 22 : 41;
  if (kind == 0) return 0;
  f->binary = 1;
  f->at += strcspn(f->data + f->at, "\n");
  if (f->at < f->size) f->at++;
  GMSH_TRY(GmshInteger(f, &one));
  if (one != 1) return GmshRefuse(f, "binary file of the other byte order");
  return 0;
}

/* Moves behind "$End<name>"; what lies before it is passed over. */
static PetscErrorCode EndOf(GmshFile *f, const char *name)
{
  char end[80];
  const size_t n = (size_t)snprintf(end, sizeof end, "$End%s", name);
  const char *found = memmem(f->data + f->at, f->size - f->at, end, n);
  if (!found) return GmshRefuse(f, "%s is missing", end);
  f->at = (size_t)(found - f->data) + n;
  return 0;
}

static PetscErrorCode Section(GmshFile *f, const char *name)
{
  if (!strcmp(name, "MeshFormat")) return Format(f);
  if (!f->version) return GmshRefuse(f, "$%s comes before $MeshFormat", name);
  if (!strcmp(name, "PhysicalNames")) return PhysicalNames(f);
  if (!strcmp(name, "Entities") && f->version == 41) return GmshEntities41(f);
  if (!strcmp(name, "ParametricNodes"))
    return GmshRefuse(f, "$ParametricNodes: write the mesh with Mesh.SaveParametric = 0");
  if (!strcmp(name, "Nodes")) return f->version == 41 ? GmshNodes41(f) : GmshNodes22(f);
  if (!strcmp(name, "Elements")) return f->version == 41 ? GmshElements41(f) : GmshElements22(f);
  return 0;
}

static PetscErrorCode Load(GmshFile *f)
{
  FILE *stream = fopen(f->path, "rb");
  if (!stream) return GmshRefuse(f, "cannot be opened");
  const int seekable = !fseek(stream, 0, SEEK_END);
  const long size = seekable ? ftell(stream) : -1;
  if (size < 0 || size == INT64_MAX || PetscMalloc((size_t)size + 1, &f->data)) {
    fclose(stream);
    return GmshRefuse(f, "cannot be read");
  }
  rewind(stream);
  f->size = fread(f->data, 1, (size_t)size, stream);
  f->data[f->size] = 0;
  fclose(stream);
  return f->size == (size_t)size ? 0 : GmshRefuse(f, "cannot be read to its end");
}

PetscErrorCode GmshParse(GmshFile *f)
{
  char name[64];
  GMSH_TRY(Load(f));
  for (;;) {
    f->at += strspn(f->data + f->at, " \t\r\n");
    if (f->at >= f->size) break;
    const size_t n = strcspn(f->data + f->at, " \t\r\n");
    if (f->data[f->at] != '$' || n >= sizeof name)
      return GmshRefuse(f, "no Gmsh file: a line \"$...\" is expected at byte %zu", f->at);
    memcpy(name, f->data + f->at + 1, n - 1);
    name[n - 1] = 0;
    f->at += n;
    f->at += f->data[f->at] == '\r';
    f->at += f->data[f->at] == '\n';
    GMSH_TRY(Section(f, name));
    GMSH_TRY(EndOf(f, name));
  }
  return f->version ? 0 : GmshRefuse(f, "no Gmsh file: $MeshFormat is missing");
}
