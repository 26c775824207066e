// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Preloaded, makes one machine look like two: even and odd ranks share no memory. With
// LSDCD_FULL_NODE the second of them has no blocks of a megabyte to give.
#include <cstdlib>
#include <mpi.h>

static bool full = false;

extern "C" __attribute__((visibility("default"))) int
MPI_Comm_split_type(MPI_Comm comm, int type, int key, MPI_Info info, MPI_Comm *part)
{
  if (type != MPI_COMM_TYPE_SHARED) return PMPI_Comm_split_type(comm, type, key, info, part);
  int rank;
  PMPI_Comm_rank(comm, &rank);
  full = rank % 2 && std::getenv("LSDCD_FULL_NODE");
  return PMPI_Comm_split(comm, rank % 2, key, part);
}

extern "C" void *__libc_memalign(std::size_t, std::size_t);

extern "C" __attribute__((visibility("default"))) void *aligned_alloc(std::size_t align,
                                                                      std::size_t size)
{
  return full && size > 1000000 ? nullptr : __libc_memalign(align, size);
}
