/* A part of the job that never joins: it sleeps, or leaves at once (`absent CASE leaves`). */
#include <mpi.h>
#include <unistd.h>

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  if (argc < 3) sleep(60);
  MPI_Finalize();
  return 0;
}
