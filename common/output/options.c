#include "common/output/options.h"
#include <stdio.h>
#include <string.h>

/* Whether the option is one of the words of given. */
static PetscBool Gives(const char *given, const char *option)
{
  const size_t n = strlen(option);
  for (const char *at = given; (at = strstr(at, option)); at += n) {
    if ((at == given || strchr(" \t\n", at[-1])) && (!at[n] || strchr(" \t\n", at[n]))) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

static PetscBool IsOfLater(const char *option, const char *const later[])
{
  for (int k = 0; later && later[k]; k++)
    if (!strncmp(option, later[k], strlen(later[k]))) return PETSC_TRUE;
  return PETSC_FALSE;
}

PetscErrorCode OptionsUnused(const char *given, const char *const later[], size_t size, char option[])
{
  PetscInt n;
  char **names, **values, name[256];
  PetscFunctionBeginUser;
  option[0] = 0;
  PetscCall(PetscOptionsLeftGet(NULL, &n, &names, &values));
  for (PetscInt k = 0; k < n && !option[0]; k++) {
    (void)snprintf(name, sizeof name, "-%s", names[k]);
    if (Gives(given, name) && !IsOfLater(name, later)) (void)snprintf(option, size, "%s", name);
  }
  PetscCall(PetscOptionsLeftRestore(NULL, &n, &names, &values));
  PetscFunctionReturn(0);
}
