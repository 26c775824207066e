// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// One block of memory per node, written by one process and read by all of them.
#pragma once

#include "backend/owned_array.h"
#include "base/error_text.h"
#include "base/large_memory.h"
#include "wall/host.h"

#include <cstddef>
#include <mpi.h>
#include <string>
#include <vector>

namespace lsdcd {

// All calls are collective over the communicator given at construction.
class MpiShared : public NodeMemory {
 public:
  explicit MpiShared(MPI_Comm world);
  ~MpiShared() override;
  MpiShared(const MpiShared &) = delete;
  MpiShared &operator=(const MpiShared &) = delete;

  char *allocate(std::size_t bytes) override;
  void publish() override;
  void broadcast_to_writers(void *data, std::size_t bytes) override;
  bool writes() const override { return node_rank_ == 0; }
  int node_rank() const override { return node_rank_; }
  int node_size() const override { return node_size_; }
  bool is_shared() const override { return window_ != MPI_WIN_NULL; }
  const char *block() const override { return block_; }
  std::size_t bytes() const override { return bytes_; }

 private:
  void release();

  MPI_Comm world_, node_;
  MPI_Comm writers_;    // null where writes() is false
  int node_rank_, node_size_;
  MPI_Win window_ = MPI_WIN_NULL;
  OwnedArray<char, LargeMemory> own_;    // where sharing is not possible, or not needed
  char *block_ = nullptr;
  std::size_t bytes_ = 0;
};

// If `error` is not empty on any process, throws InputError with the text of the
// lowest such rank on all of them.
void throw_together(MPI_Comm comm, const std::string &error);

// Runs `work` where `here`; whatever it throws is thrown on every process of `comm`.
template <class Work>
void run_collectively(MPI_Comm comm, bool here, Work &&work)
{
  throw_together(comm, here ? error_of(work) : "");
}

// All processes' numbers, in their order, on the first process of `comm`; nothing on others.
std::vector<double> gather_numbers(const std::vector<double> &mine, MPI_Comm comm);

// A broadcast of more bytes than an int can count.
void broadcast_bytes(void *data, std::size_t bytes, int root, MPI_Comm comm);
void broadcast_text(std::string &text, int root, MPI_Comm comm);

}    // namespace lsdcd
