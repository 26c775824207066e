// Preloaded, makes one machine look like two: even and odd ranks share no memory.
#include <mpi.h>

extern "C" __attribute__((visibility("default"))) int
MPI_Comm_split_type(MPI_Comm comm, int type, int key, MPI_Info info, MPI_Comm *part)
{
  if (type != MPI_COMM_TYPE_SHARED) return PMPI_Comm_split_type(comm, type, key, info, part);
  int rank;
  PMPI_Comm_rank(comm, &rank);
  return PMPI_Comm_split(comm, rank % 2, key, part);
}
