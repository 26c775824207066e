// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// One block of memory per node, written by one process and read by all of them.
#pragma once

#include "base/error_text.h"
#include "base/large_memory.h"
#include "backend/owned_array.h"

#include <cstddef>
#include <mpi.h>
#include <string>

namespace lsdcd {

// All calls are collective over the communicator given at construction.
class MpiShared {
 public:
  explicit MpiShared(MPI_Comm world);
  ~MpiShared();
  MpiShared(const MpiShared &) = delete;
  MpiShared &operator=(const MpiShared &) = delete;

  MPI_Comm world() const { return world_; }
  MPI_Comm node() const { return node_; }
  MPI_Comm writers() const { return writers_; }    // null where writes() is false
  bool writes() const { return node_rank_ == 0; }
  int node_rank() const { return node_rank_; }
  int node_size() const { return node_size_; }

  // Gives up the last block and makes one of `bytes` (the writer's number counts),
  // 64-byte aligned. Only the writer may write, before publish().
  char *allocate(std::size_t bytes);
  void publish();
  const char *block() const { return block_; }
  bool is_shared() const { return window_ != MPI_WIN_NULL; }
  std::size_t bytes() const { return bytes_; }

 private:
  void release();

  MPI_Comm world_, node_, writers_;
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

// A broadcast of more bytes than an int can count.
void broadcast_bytes(void *data, std::size_t bytes, int root, MPI_Comm comm);
void broadcast_text(std::string &text, int root, MPI_Comm comm);

}    // namespace lsdcd
