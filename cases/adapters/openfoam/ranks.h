// OpenFOAM 1912 takes all ranks of the job for its own.  While Pstream starts, MPI's world is this participant.
#ifndef CORACLE_OPENFOAM_RANKS_H
#define CORACLE_OPENFOAM_RANKS_H
#include <PstreamGlobals.H>
#include <UPstream.H>

static MPI_Comm WORLD = MPI_COMM_NULL;

static MPI_Comm Ranks(MPI_Comm comm)
{
  return comm == MPI_COMM_WORLD && WORLD != MPI_COMM_NULL ? WORLD : comm;
}
extern "C" int MPI_Comm_rank(MPI_Comm comm, int *rank)
{
  return PMPI_Comm_rank(Ranks(comm), rank);
}
extern "C" int MPI_Comm_size(MPI_Comm comm, int *size)
{
  return PMPI_Comm_size(Ranks(comm), size);
}
static void StartPstream(MPI_Comm comm, int argc, char **argv)
{
  int size;
  MPI_Comm_size(comm, &size);
  if (size == 1) return;
  WORLD = comm;
  Foam::UPstream::init(argc, argv, false);
  Foam::PstreamGlobals::MPICommunicators_[Foam::UPstream::worldComm] = comm;
  MPI_Comm_group(comm, &Foam::PstreamGlobals::MPIGroups_[Foam::UPstream::worldComm]);
  WORLD = MPI_COMM_NULL;
}
#endif
