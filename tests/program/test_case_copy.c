/* case.yaml: a copy of the case led by comments that have the settings as a shell takes them, wherever they stand and whatever they hold. */
#include "common/program/case_copy.h"
#include "tests/check.h"
#include "tests/remove_folder.h"
#include <string.h>
#include <unistd.h>

static void Write(const char *path, const char *text)
{
  FILE *f = fopen(path, "w");
  CHECK(f && fputs(text, f) >= 0 && !fclose(f), "%s", path);
}

int main(int argc, char **argv)
{
  static const char CASE[] = "case: a\ntime: {end: 1}\n", *const SETTINGS[] = {
                                                              "#   --set 'note=it'\\''s' ",
                                                              "#   --set $'note=two\\012lines \\\\ it\\'s' "};
  char folder[] = "/tmp/coracle_case_copy_XXXXXX", path[64], made[64], text[4096], expected[128];
  char *arguments[] = {"coracle", "--set", "note=it's", path, "--set", "note=two\nlines \\ it's"};
  CaseCopy copy;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(mkdtemp(folder), "no folder");
  snprintf(path, sizeof path, "%s/own.yaml", folder);
  snprintf(made, sizeof made, "%s/case.yaml", folder);
  Write(path, CASE);
  PetscCall(CaseCopyTake(path, &copy));
  PetscCall(CaseCopyWrite(folder, "ranks 1", 6, arguments, &copy));
  FILE *f = fopen(made, "r");
  CHECK(f, "no copy");
  text[fread(text, 1, sizeof text - 1, f)] = 0;
  fclose(f);
  for (int k = 0; k < 2; k++) {
    snprintf(expected, sizeof expected, "%.*s\n", (int)strlen(SETTINGS[k]) - 1, SETTINGS[k]);
    CHECK(strstr(text, expected), "there is no %s in %s", expected, text);
  }
  const char *line = text;
  for (; *line == '#'; line = strchr(line, '\n') + 1) continue;
  CHECK(!strcmp(line, CASE), "the case is: %s", line);
  RemoveFolder(folder);
  return PetscFinalize();
}
