/* Removes a folder that a test has made, with all that is in it: RemoveFolder("/tmp/coracle_test_x").  Local. */
#ifndef TESTS_REMOVE_FOLDER_H
#define TESTS_REMOVE_FOLDER_H
#include "tests/check.h"
#include <ftw.h>

static inline int RemoveEntry(const char *path, const struct stat *status, int type, struct FTW *place)
{
  (void)status, (void)type, (void)place;
  return remove(path);
}

static inline void RemoveFolder(const char *folder)
{
  CHECK(!nftw(folder, RemoveEntry, 8, FTW_DEPTH | FTW_PHYS), "cannot remove %s", folder);
}
#endif
