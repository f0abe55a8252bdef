/* A part of the job that never joins: it sleeps, or leaves at once (`absent CASE leaves`), or does not even call MPI_Init
 * (`absent CASE unstarted`). */
#include <mpi.h>
#include <string.h>
#include <unistd.h>

int main(int argc, char **argv)
{
  if (argc > 2 && !strcmp(argv[2], "unstarted")) return (int)sleep(60);
  MPI_Init(&argc, &argv);
  if (argc < 3) sleep(60);
  MPI_Finalize();
  return 0;
}
