/* Numbers and texts beside the datasets of a file. */
#include "common/output/hdf5_impl.h"
#include <string.h>

PetscErrorCode Hdf5Attribute(hid_t file, const char *path, const char *name, double value)
{
  hid_t space, attribute;
  PetscFunctionBeginUser;
  H5(space = H5Screate(H5S_SCALAR), "describe", name);
  H5(attribute =
         H5Acreate_by_name(file, path, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
     "create attribute", name);
  H5(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value), "write attribute", name);
  H5(H5Aclose(attribute), "close attribute", name);
  H5(H5Sclose(space), "close", name);
  PetscFunctionReturn(0);
}

PetscErrorCode Hdf5ReadAttribute(hid_t file, const char *path, const char *name, double *value)
{
  hid_t attribute;
  PetscFunctionBeginUser;
  H5(attribute = H5Aopen_by_name(file, path, name, H5P_DEFAULT, H5P_DEFAULT), "open attribute", name);
  H5(H5Aread(attribute, H5T_NATIVE_DOUBLE, value), "read attribute", name);
  H5(H5Aclose(attribute), "close attribute", name);
  PetscFunctionReturn(0);
}

PetscBool Hdf5HasAttribute(hid_t file, const char *path, const char *name)
{
  return H5Aexists_by_name(file, path, name, H5P_DEFAULT) > 0 ? PETSC_TRUE : PETSC_FALSE;
}

PetscErrorCode Hdf5Text(hid_t file, const char *path, const char *name, const char *text)
{
  hid_t space, type, attribute;
  PetscFunctionBeginUser;
  H5(space = H5Screate(H5S_SCALAR), "describe", name);
  H5(type = H5Tcopy(H5T_C_S1), "describe", name);
  H5(H5Tset_size(type, PetscMax(strlen(text), 1)), "describe", name);
  H5(H5Tset_strpad(type, H5T_STR_NULLPAD), "describe", name);
  H5(attribute = H5Acreate_by_name(file, path, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
     "create attribute", name);
  H5(H5Awrite(attribute, type, text), "write attribute", name);
  H5(H5Aclose(attribute), "close attribute", name);
  H5(H5Tclose(type), "close", name);
  H5(H5Sclose(space), "close", name);
  PetscFunctionReturn(0);
}

PetscErrorCode Hdf5ReadText(hid_t file, const char *path, const char *name, size_t size, char text[])
{
  hid_t type, attribute;
  PetscFunctionBeginUser;
  memset(text, 0, size);
  H5(attribute = H5Aopen_by_name(file, path, name, H5P_DEFAULT, H5P_DEFAULT), "open attribute", name);
  H5(type = H5Aget_type(attribute), "describe", name);
  PetscCheck(H5Tget_class(type) == H5T_STRING && H5Tget_size(type) < size, PETSC_COMM_SELF,
             PETSC_ERR_FILE_UNEXPECTED, "attribute %s is no text of less than %zu characters", name, size);
  H5(H5Aread(attribute, type, text), "read attribute", name);
  H5(H5Tclose(type), "close", name);
  H5(H5Aclose(attribute), "close attribute", name);
  PetscFunctionReturn(0);
}
