// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/mpi_shared.h"

#include "base/input_error.h"

#include <algorithm>
#include <cstdint>
#include <new>

namespace lsdcd {

namespace {

constexpr std::size_t kAlign = 64;

char *aligned(void *memory)
{
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  return reinterpret_cast<char *>((address + kAlign - 1) / kAlign * kAlign);
}

}    // namespace

MpiShared::MpiShared(MPI_Comm world) : world_(world)
{
  int rank;
  MPI_Comm_rank(world, &rank);
  MPI_Comm_split_type(world, MPI_COMM_TYPE_SHARED, rank, MPI_INFO_NULL, &node_);
  MPI_Comm_rank(node_, &node_rank_);
  MPI_Comm_size(node_, &node_size_);
  MPI_Comm_split(world, writes() ? 0 : MPI_UNDEFINED, rank, &writers_);
  // A failed window is answered by private copies.
  MPI_Comm_set_errhandler(node_, MPI_ERRORS_RETURN);
}

MpiShared::~MpiShared()
{
  int finalized;
  MPI_Finalized(&finalized);
  if (finalized) return;
  release();
  MPI_Comm_free(&node_);
  if (writers_ != MPI_COMM_NULL) MPI_Comm_free(&writers_);
}

void MpiShared::release()
{
  if (window_ != MPI_WIN_NULL) {
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
  }
  window_ = MPI_WIN_NULL;
  own_ = {};
  block_ = nullptr;
  bytes_ = 0;
}

char *MpiShared::allocate(std::size_t bytes)
{
  release();
  std::uint64_t wanted = bytes;
  MPI_Bcast(&wanted, 1, MPI_UINT64_T, 0, node_);
  bytes_ = wanted;

  void *base = nullptr;
  int failed = node_size_ == 1;    // one process needs no window
  if (!failed) {
    const MPI_Aint mine = writes() ? static_cast<MPI_Aint>(bytes_ + kAlign) : 0;
    failed = MPI_Win_allocate_shared(mine, 1, MPI_INFO_NULL, node_, &base, &window_) != MPI_SUCCESS;
    if (failed) window_ = MPI_WIN_NULL;
    MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, node_);
  }
  std::string error;
  if (!failed) {
    MPI_Aint size;
    int unit;
    MPI_Win_lock_all(MPI_MODE_NOCHECK, window_);
    MPI_Win_shared_query(window_, 0, &size, &unit, &base);
  } else {
    if (window_ != MPI_WIN_NULL) MPI_Win_free(&window_);
    try {
      own_ = OwnedArray<char, LargeMemory>(bytes_);
    } catch (const std::bad_alloc &) {
      error = "out of memory for the wall grid";
    }
    base = own_.data();
  }
  throw_together(world_, error);    // other nodes may have had room
  return block_ = aligned(base);
}

void MpiShared::publish()
{
  if (!is_shared()) {
    broadcast_bytes(block_, bytes_, 0, node_);
    return;
  }
  MPI_Win_sync(window_);
  MPI_Barrier(node_);
  MPI_Win_sync(window_);
}

void MpiShared::broadcast_to_writers(void *data, std::size_t bytes)
{
  broadcast_bytes(data, bytes, 0, writers_);
}

void throw_together(MPI_Comm comm, const std::string &error)
{
  int rank, size;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  int first = error.empty() ? size : rank;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm);
  if (first == size) return;
  std::string text = error;
  broadcast_text(text, first, comm);
  throw InputError(text);
}

std::vector<double> gather_numbers(const std::vector<double> &mine, MPI_Comm comm)
{
  int rank, size;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  const int n = static_cast<int>(mine.size());
  std::vector<int> count(size), first(size);
  MPI_Gather(&n, 1, MPI_INT, count.data(), 1, MPI_INT, 0, comm);
  for (int p = 1; p < size; p++) first[p] = first[p - 1] + count[p - 1];
  std::vector<double> all(rank == 0 ? first.back() + count.back() : 0);
  MPI_Gatherv(mine.data(), n, MPI_DOUBLE, all.data(), count.data(), first.data(), MPI_DOUBLE, 0,
              comm);
  return all;
}

void broadcast_bytes(void *data, std::size_t bytes, int root, MPI_Comm comm)
{
  constexpr std::size_t kChunk = std::size_t(1) << 30;
  for (std::size_t at = 0; at < bytes; at += kChunk)
    MPI_Bcast(static_cast<char *>(data) + at, static_cast<int>(std::min(kChunk, bytes - at)),
              MPI_BYTE, root, comm);
}

void broadcast_text(std::string &text, int root, MPI_Comm comm)
{
  std::uint64_t size = text.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, root, comm);
  text.resize(size);
  broadcast_bytes(&text[0], size, root, comm);
}

}    // namespace lsdcd
