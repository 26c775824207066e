// A query in two kernels that each have one kind of work. The first is light: its warps stay
// and take one tile of spheres after the other, answer every sphere as if the wall were far, and
// list those near to it with all that their answers begin from. The second has full warps of
// those, whatever their order in memory. What one lane would read for too long is left to a warp
// each in a third.
#pragma once

#include "engine/backend_cuda.h"
#include "engine/cuda_bricks.h"
#include "engine/cuda_early.h"
#include "engine/cuda_limits.h"
#include "engine/cuda_warp.h"
#include "grid/brick_filter.h"
#include "query/sphere.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace lsdcd {

// A warp, for what its threads do together.
struct WarpLanes {
  static constexpr unsigned kCount = 32;

  __device__ unsigned lane() const { return threadIdx.x % 32; }
  __device__ unsigned vote(bool yes) const { return __ballot_sync(kAllLanes, yes); }
  template <class T>
  __device__ T from(T value, unsigned lane) const
  {
    return __shfl_sync(kAllLanes, value, lane);
  }
  template <class T>
  __device__ T from_below(T value, unsigned step) const
  {
    return __shfl_up_sync(kAllLanes, value, step);
  }
};

// A sphere near the wall and the list of its cell, so that the second kernel waits for neither.
template <class S>
struct alignas(16) NearSphere {
  S s;
  Cell cell;
  std::uint32_t sphere, pad;
};

// Warps of the first kernel's blocks at most, and blocks at once on a processor: 64 registers a thread.
constexpr unsigned kNearWarps = 32, kNearBlocks = 1, kNearBlock = 32 * kNearWarps;
constexpr unsigned kNearBytes = 64;    // of spheres in flight for each thread
template <class S>
constexpr unsigned kNearEach = kNearBytes / sizeof(S);
template <class S>
constexpr unsigned kNearTile = 32 * kNearEach<S>;    // spheres that a warp takes at a time

// A warp's tile in shared memory, the next one, which is on its way, and which of the spheres the
// warp looks at more closely.
template <class S>
struct NearTiles {
  S sphere[2][kNearTile<S>];
  std::uint8_t waiting[kNearTile<S>];
};
// Each block of the first kernel has a list of its own: its warps count in the block's memory,
// not all in one place.
constexpr unsigned kMostNearLists = 1024;
struct NearCounts {
  unsigned listed[kMostNearLists];
  unsigned with_long;    // of the listed, how many have lists that are long
};

// Blocks of the second kernel: of a processor, 80 registers a thread, and of a list.
constexpr unsigned kAnswerBlock = 256, kAnswerBlocks = 3, kAnswerShare = 3;

// Read once and in order: other things stay in the cache.
template <class T>
__device__ T read_once(const T &from)
{
  static_assert(sizeof(T) % sizeof(uint4) == 0 && alignof(T) % sizeof(uint4) == 0, "in pieces");
  constexpr unsigned kPieces = sizeof(T) / sizeof(uint4);
  uint4 piece[kPieces];
#pragma unroll
  for (unsigned k = 0; k < kPieces; k++)
    piece[k] = __ldcs(reinterpret_cast<const uint4 *>(&from) + k);
  T out;
  std::memcpy(&out, piece, sizeof out);
  return out;
}

// Appends those of a tile's waiting spheres that are near to the wall to `list`, kTurns for each
// lane.
template <unsigned kTurns, class Work, class Table, class S>
__device__ void list_waiting(const Work &work, const Table &table, unsigned first, const S *sphere,
                             const std::uint8_t *waiting, unsigned n_waiting, NearSphere<S> *list,
                             unsigned *listed)
{
  const unsigned lane = threadIdx.x % 32;
  Vec3 centre[kTurns];
  bool counts[kTurns];
  std::uint32_t cell[kTurns];
#pragma unroll
  for (unsigned k = 0; k < kTurns; k++) {
    const unsigned w = k * 32 + lane;
    counts[k] = w < n_waiting;
    centre[k] = sphere[waiting[counts[k] ? w : 0]].centre();
  }
  occupied_cells(work.grid, table, centre, counts, cell);
  Cell record[kTurns];
  unsigned votes[kTurns], all = 0;
#pragma unroll
  for (unsigned k = 0; k < kTurns; k++) {
    if (cell[k] != kNoCell) record[k] = *work.list(cell[k]);
    votes[k] = __ballot_sync(kAllLanes, cell[k] != kNoCell);
    all += __popc(votes[k]);
  }
  unsigned at = room_at(listed, all);
#pragma unroll
  for (unsigned k = 0; k < kTurns; k++) {
    if (cell[k] != kNoCell) {
      const unsigned i = waiting[k * 32 + lane];
      list[at + votes_below(votes[k])] = {sphere[i], record[k], first + i, 0};
    }
    at += __popc(votes[k]);
  }
}

// Answers n of the work's spheres as if all were far, and appends those that are not to the
// block's list, which has room for `room`.
template <bool kTableNear, class Work>
__global__ void __launch_bounds__(kNearBlock, kNearBlocks)
    list_near(unsigned n, const __grid_constant__ Work work, NearSphere<typename Work::Item> *lists,
              unsigned room, NearCounts *counts)
{
  using S = typename Work::Item;
  constexpr unsigned kEach = kNearEach<S>, kTile = kNearTile<S>;
  extern __shared__ uint4 shared[];
  __shared__ unsigned turns, listed;
  const unsigned lane = threadIdx.x % 32, n_warps = blockDim.x / 32;
  NearTiles<S> *const tiles = reinterpret_cast<NearTiles<S> *>(shared),
                      &mine = tiles[threadIdx.x / 32];
  NearSphere<S> *const list = lists + std::size_t(blockIdx.x) * room;
  let_next_begin();
  if (threadIdx.x == 0) {
    turns = 2 * n_warps;
    listed = 0;
  }
  // A block has every gridDim.x-th tile. Its warps take them as they come: where all of a tile
  // is in bricks it takes several times as long.
  const auto first_of = [&](unsigned turn) { return (turn * gridDim.x + blockIdx.x) * kTile; };
  const auto bring = [&](unsigned from, S *to) {
#pragma unroll
    for (unsigned k = 0; k < kEach; k++) {
      const unsigned i = k * 32 + lane;
      const uint4 *source = reinterpret_cast<const uint4 *>(&work.spheres[min(from + i, n - 1)]);
      uint4 *there = reinterpret_cast<uint4 *>(to + i);
#pragma unroll
      for (unsigned piece = 0; piece < sizeof(S) / sizeof(uint4); piece++)
        __pipeline_memcpy_async(there + piece, source + piece, sizeof(uint4));
    }
  };
  unsigned first = first_of(threadIdx.x / 32), next = first_of(n_warps + threadIdx.x / 32);
  bring(first, mine.sphere[0]);
  __pipeline_commit();
  const auto table = [&] {
    if constexpr (kTableNear)
      return BrickTableNear(work.table, tiles + n_warps);
    else
      return work.table;
  }();
  __syncthreads();

  for (unsigned side = 0; first < n; side = 1 - side) {
    const S *const sphere = mine.sphere[side];
    if (next < n) bring(next, mine.sphere[1 - side]);
    __pipeline_commit();
    if (first + kTile <= n) {
      if (4 * lane < kTile) work.four_far(first + 4 * lane);
    } else {
      for (unsigned i = first + lane; i < n; i += 32) work.far(i);
    }
    const unsigned after = first_of(room_at(&turns, 1));
    __pipeline_wait_prior(1);
    unsigned n_waiting = 0;
#pragma unroll
    for (unsigned k = 0; k < kEach; k++) {
      const unsigned i = k * 32 + lane;
      const BrickGuess guess = work.guess(sphere[i]);
      bool maybe = guess.unsure;
      if (guess.inside & !guess.unsure) maybe = table.at(guess.place);
      const unsigned votes = __ballot_sync(kAllLanes, maybe & (first + i < n));
      if (votes >> lane & 1u)
        mine.waiting[n_waiting + votes_below(votes)] = static_cast<std::uint8_t>(i);
      n_waiting += __popc(votes);
    }
    __syncwarp();
    if (n_waiting > 32)
      list_waiting<kEach>(work, table, first, sphere, mine.waiting, n_waiting, list, &listed);
    else if (n_waiting > 0)
      list_waiting<1>(work, table, first, sphere, mine.waiting, n_waiting, list, &listed);
    __syncwarp();
    first = next;
    next = after;
  }
  __syncthreads();
  if (threadIdx.x == 0) counts->listed[blockIdx.x] = listed;
}

// Answers the listed spheres but those with long lists, which it lists in turn as far as
// `most_long` go, and clears what the next run counts from. Some blocks share each list.
template <class Work>
__global__ void __launch_bounds__(kAnswerBlock, kAnswerBlocks)
    answer_listed(const __grid_constant__ Work work, const NearSphere<typename Work::Item> *lists,
                  unsigned n_lists, unsigned room, NearCounts *counts, NearCounts *next_counts,
                  NearSphere<typename Work::Item> *long_list, unsigned most_long)
{
  wait_for_last_kernel();
  if (blockIdx.x == 0 && threadIdx.x == 0) next_counts->with_long = 0;
  const unsigned mine = blockIdx.x % n_lists, n = counts->listed[mine];
  const NearSphere<typename Work::Item> *const list = lists + std::size_t(mine) * room;
  for (unsigned k = blockIdx.x / n_lists * kAnswerBlock + threadIdx.x; k < n;
       k += gridDim.x / n_lists * kAnswerBlock) {
    const NearSphere<typename Work::Item> one = read_once(list[k]);
    if (work.is_long(one.cell)) {
      const unsigned at = atomicAdd(&counts->with_long, 1u);
      if (at < most_long) {
        long_list[at] = one;
        continue;
      }
    }
    work.answer(one.sphere, one.s, one.cell);
  }
}

// A warp for each sphere with a long list.
template <class Work>
__global__ void __launch_bounds__(kAnswerBlock)
    answer_long(const __grid_constant__ Work work, const NearSphere<typename Work::Item> *long_list,
                const NearCounts *counts, unsigned most_long)
{
  const unsigned n = min(counts->with_long, most_long);
  for (unsigned k = (blockIdx.x * kAnswerBlock + threadIdx.x) / 32; k < n;
       k += gridDim.x * (kAnswerBlock / 32)) {
    const NearSphere<typename Work::Item> one = long_list[k];
    work.answer_together(one.sphere, one.s, one.cell, WarpLanes());
  }
}

class NearFirst {
 public:
  // Room for the worst case, all spheres of a run near: 32 bytes for each in float, 48 in double.
  template <class S>
  void reserve(std::size_t n, const BrickTable &table)
  {
    if (counts_.size() == 0) {
      long_list_ = CudaBackend::Array<char>(kMostLong * sizeof(NearSphere<Sphere>));
      counts_ = CudaBackend::Array<NearCounts>(2);
      cuda_check(cudaMemset(counts_.data(), 0, 2 * sizeof(NearCounts)), "clearing memory");
    }
    shape_ =
        limits_.shape(kNearWarps, kNearBlocks, sizeof(NearTiles<S>), BrickTableNear::bytes(table));
    const Lists lists = lists_for<S>(static_cast<unsigned>(std::min(n, kRun)));
    const std::size_t most = std::size_t(lists.n) * lists.room * sizeof(NearSphere<S>);
    if (list_.size() < most) list_ = CudaBackend::Array<char>(most);
  }

  template <class Work>
  void run(CudaBackend &b, std::size_t n, const Work &work)
  {
    for (std::size_t from = 0; from < n; from += kRun) {
      const unsigned m = static_cast<unsigned>(std::min(n - from, kRun));
      run_part(b, m, work.after(from),
               shape_.has_table ? list_near<true, Work> : list_near<false, Work>);
    }
  }

 private:
  static constexpr std::size_t kRun = std::size_t(1) << 24;    // spheres of a pair of kernels

  // Where there are more, their lanes read them.
  static constexpr unsigned kMostLong = 1 << 16;

  template <class Work, class Kernel>
  void run_part(CudaBackend &b, unsigned n, const Work &work, Kernel *kernel)
  {
    using S = typename Work::Item;
    NearSphere<S> *list = reinterpret_cast<NearSphere<S> *>(list_.data());
    NearSphere<S> *long_list = reinterpret_cast<NearSphere<S> *>(long_list_.data());
    NearCounts *counts = counts_.data() + turn_, *next = counts_.data() + (1 - turn_);
    turn_ = 1 - turn_;
    const Lists lists = lists_for<S>(n);
    limits_.allow(kernel, shape_.shared);
    kernel<<<lists.n, 32 * shape_.warps, shape_.shared, b.stream>>>(n, work, list, lists.room,
                                                                    counts);
    cuda_check(cudaGetLastError(), "starting a kernel");
    static const bool can = can_begin_early(answer_listed<Work>);
    start_beside(can, b.stream, lists.n * kAnswerShare, kAnswerBlock, answer_listed<Work>, work,
                 list, lists.n, lists.room, counts, next, long_list, kMostLong);
    if constexpr (Work::kTogether) {
      answer_long<<<limits_.processors(), kAnswerBlock, 0, b.stream>>>(work, long_list, counts,
                                                                       kMostLong);
      cuda_check(cudaGetLastError(), "starting a kernel");
    }
  }

  // One for each block of the first kernel, with room for all that the block reads.
  struct Lists {
    unsigned n, room;
  };
  template <class S>
  Lists lists_for(unsigned n)
  {
    const unsigned of_block = shape_.warps * kNearTile<S>,
                   most = std::min(limits_.processors() * kNearBlocks, kMostNearLists),
                   lists = std::clamp((n + of_block - 1) / of_block, 1u, most),
                   tiles = (n + kNearTile<S> - 1) / kNearTile<S>;
    return {lists, (tiles + lists - 1) / lists * kNearTile<S>};
  }

  CudaBackend::Array<char> list_, long_list_;    // of NearSphere
  CudaBackend::Array<NearCounts> counts_;        // of this run and of the next
  CudaLimits limits_;
  CudaLimits::Shape shape_ = {};
  int turn_ = 0;
};

}    // namespace lsdcd
