// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/mpi_host.h"

#ifndef MPI_STUBS    // a host without MPI needs none of this

#include "base/countable.h"
#include "base/large_memory.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <new>
#include <string>

namespace lsdcd {

namespace {

constexpr std::size_t kAlign = 64;

char *aligned(void *memory)
{
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  return reinterpret_cast<char *>((address + kAlign - 1) / kAlign * kAlign);
}

// More bytes than an int can count.
void broadcast_bytes(void *data, std::size_t bytes, int root, MPI_Comm comm)
{
  constexpr std::size_t kChunk = std::size_t(1) << 30;
  for (std::size_t at = 0; at < bytes; at += kChunk)
    MPI_Bcast(static_cast<char *>(data) + at, static_cast<int>(std::min(kChunk, bytes - at)),
              MPI_BYTE, root, comm);
}

// Of messages whose first two numbers count what follows: sums, then largest numbers.
void add_or_keep_largest(void *one, void *other, int *messages, MPI_Datatype * /*type*/)
{
  const double *from = static_cast<const double *>(one);
  double *to = static_cast<double *>(other);
  for (int k = 0; k < *messages; k++) {
    const int n = static_cast<int>(from[0]), m = static_cast<int>(from[1]);
    from += 2;
    to += 2;
    for (int i = 0; i < n; i++) *to++ += *from++;
    for (int i = 0; i < m; i++, to++, from++) *to = std::max(*to, *from);
  }
}

bool is_finalized()
{
  int finalized;
  MPI_Finalized(&finalized);
  return finalized;
}

// Owns the window that a block lies in.
struct FreeWindow {
  MPI_Win window;

  void operator()(char * /*block*/)
  {
    if (is_finalized()) return;
    MPI_Win_unlock_all(window);
    MPI_Win_free(&window);
  }
};

}    // namespace

MpiHost::MpiHost(MPI_Comm world) : world_(world)
{
  MPI_Comm_rank(world, &ranks_.rank);
  MPI_Comm_size(world, &ranks_.processes);
}

void MpiHost::sum(double *numbers, int n)
{
  MPI_Allreduce(MPI_IN_PLACE, numbers, n, MPI_DOUBLE, MPI_SUM, world_);
}

void MpiHost::max(double *numbers, int n)
{
  MPI_Allreduce(MPI_IN_PLACE, numbers, n, MPI_DOUBLE, MPI_MAX, world_);
}

void MpiHost::sum_and_max(double *sums, int n, double *largest, int m)
{
  if (processes() == 1) return;
  std::vector<double> all = {static_cast<double>(n), static_cast<double>(m)};
  all.insert(all.end(), sums, sums + n);
  all.insert(all.end(), largest, largest + m);
  MPI_Datatype message;
  MPI_Op join;
  MPI_Type_contiguous(static_cast<int>(all.size()), MPI_DOUBLE, &message);
  MPI_Type_commit(&message);
  MPI_Op_create(add_or_keep_largest, 1, &join);
  MPI_Allreduce(MPI_IN_PLACE, all.data(), 1, message, join, world_);
  MPI_Op_free(&join);
  MPI_Type_free(&message);
  std::copy_n(all.data() + 2, n, sums);
  std::copy_n(all.data() + 2 + n, m, largest);
}

void MpiHost::broadcast(void *data, std::size_t bytes, int from, Receivers /*to*/)
{
  broadcast_bytes(data, bytes, from, world_);
}

std::vector<double> MpiHost::gather(const std::vector<double> &mine)
{
  std::int64_t total = static_cast<std::int64_t>(mine.size());
  MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_INT64_T, MPI_SUM, world_);
  countable(total, "numbers that the first process gathers", "use a coarser mesh");
  const int n = static_cast<int>(mine.size());
  std::vector<int> count(processes()), first(processes());
  MPI_Gather(&n, 1, MPI_INT, count.data(), 1, MPI_INT, 0, world_);
  for (int p = 1; p < processes(); p++) first[p] = first[p - 1] + count[p - 1];
  std::vector<double> all(is_first() ? first.back() + count.back() : 0);
  MPI_Gatherv(mine.data(), n, MPI_DOUBLE, all.data(), count.data(), first.data(), MPI_DOUBLE, 0,
              world_);
  return all;
}

MpiNodeHost::MpiNodeHost(MPI_Comm world) : MpiHost(world)
{
  MPI_Comm_split_type(world, MPI_COMM_TYPE_SHARED, rank(), MPI_INFO_NULL, &node_);
  MPI_Comm_rank(node_, &ranks_.node_rank);
  MPI_Comm_size(node_, &ranks_.node_size);
  ranks_.fills_memory = ranks_.node_rank == 0;
  MPI_Comm_split(world, ranks_.fills_memory ? 0 : MPI_UNDEFINED, rank(), &fillers_);
  // A failed window is answered by private copies.
  MPI_Comm_set_errhandler(node_, MPI_ERRORS_RETURN);
}

MpiNodeHost::~MpiNodeHost()
{
  if (is_finalized()) return;
  MPI_Comm_free(&node_);
  if (fillers_ != MPI_COMM_NULL) MPI_Comm_free(&fillers_);
}

// The first process is the first of those that fill memory, too.
void MpiNodeHost::broadcast(void *data, std::size_t bytes, int from, Receivers to)
{
  if (to == Receivers::all)
    MpiHost::broadcast(data, bytes, from, to);
  else if (ranks_.fills_memory)
    broadcast_bytes(data, bytes, 0, fillers_);
}

NodeMemory MpiNodeHost::node_memory(std::size_t bytes)
{
  NodeMemory memory;
  std::uint64_t wanted = bytes;
  MPI_Bcast(&wanted, 1, MPI_UINT64_T, 0, node_);
  memory.bytes = wanted;

  MPI_Win window = MPI_WIN_NULL;
  void *base = nullptr;
  int failed = ranks_.node_size == 1;    // one process needs no window
  if (!failed) {
    const MPI_Aint mine = ranks_.fills_memory ? static_cast<MPI_Aint>(memory.bytes + kAlign) : 0;
    failed = MPI_Win_allocate_shared(mine, 1, MPI_INFO_NULL, node_, &base, &window) != MPI_SUCCESS;
    if (failed) window = MPI_WIN_NULL;
    MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, node_);
  }
  std::string error;
  memory.is_shared = !failed;
  if (memory.is_shared) {
    MPI_Aint size;
    int unit;
    MPI_Win_lock_all(MPI_MODE_NOCHECK, window);
    MPI_Win_shared_query(window, 0, &size, &unit, &base);
    memory.block = {aligned(base), FreeWindow{window}};
  } else {
    if (window != MPI_WIN_NULL) MPI_Win_free(&window);
    try {
      if (memory.bytes > 0)
        memory.block = {static_cast<char *>(LargeMemory::allocate(memory.bytes)),
                        LargeMemory::free};
    } catch (const std::bad_alloc &) {
      error = "out of memory for the wall grid";
    }
  }
  fail_together(*this, error);    // other nodes may have had room
  return memory;
}

void MpiNodeHost::publish(const NodeMemory &memory)
{
  if (!memory.is_shared) {
    broadcast_bytes(memory.block.get(), memory.bytes, 0, node_);
    return;
  }
  const MPI_Win window = std::get_deleter<FreeWindow>(memory.block)->window;
  MPI_Win_sync(window);
  MPI_Barrier(node_);
  MPI_Win_sync(window);
}

}    // namespace lsdcd

#endif
