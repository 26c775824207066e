// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The processes of an MPI communicator as a host. In a plugin for a LAMMPS without MPI (LSDCD_HOST_MPI is OFF) it is
// compiled with LAMMPS's stand-in for mpi.h, and there is one process.
#pragma once

#include "host/host.h"

#include <mpi.h>

#include <cstddef>
#include <vector>

namespace lsdcd {

#ifdef MPI_STUBS

struct MpiHost : Host {    // a host is a process on its own
  explicit MpiHost(MPI_Comm /*world*/) {}
};
struct MpiNodeHost : MpiHost {
  using MpiHost::MpiHost;
};

#else

class MpiHost : public Host {
 public:
  explicit MpiHost(MPI_Comm world);

  void sum(double *numbers, int n) override;
  void max(double *numbers, int n) override;
  void sum_and_max(double *sums, int n, double *largest, int m) override;
  void broadcast(void *data, std::size_t bytes, int from, Receivers to = Receivers::all) override;
  std::vector<double> gather(const std::vector<double> &mine) override;

 protected:
  MPI_Comm world_;
};

// A host whose processes share memory if they are on one node. Making and ending it is collective.
class MpiNodeHost : public MpiHost {
 public:
  explicit MpiNodeHost(MPI_Comm world);
  ~MpiNodeHost() override;
  MpiNodeHost(const MpiNodeHost &) = delete;
  MpiNodeHost &operator=(const MpiNodeHost &) = delete;

  void broadcast(void *data, std::size_t bytes, int from, Receivers to = Receivers::all) override;
  NodeMemory node_memory(std::size_t bytes) override;
  void publish(const NodeMemory &memory) override;

 private:
  MPI_Comm node_;
  MPI_Comm fillers_;    // processes that fill memory, by their rank in the world; null on others
};

#endif

}    // namespace lsdcd
