// A query in two kernels that each have one kind of work. The first is light: many threads, several
// spheres in flight in each; it answers every sphere as if the wall were far, and lists those near
// to it with all that their answers begin from. The second has full warps of those, whatever
// their order in memory. What one lane would read for too long is left to a warp each in a third.
#pragma once

#include "engine/backend_cuda.h"
#include "engine/cuda_early.h"
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

// Threads of the first kernel's blocks; bytes of spheres in flight for each.
constexpr unsigned kNearBlock = 256, kNearBytes = 64;
template <class S>
constexpr unsigned kNearEach = kNearBytes / sizeof(S);
template <class S>
constexpr unsigned kNearTile = kNearBlock *kNearEach<S>;

constexpr unsigned kAnswerBlock = 256,
                   kAnswerBlocks = 3;    // of a processor: 80 registers a thread

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

// Answers n of the work's spheres as if all were far, and appends those that are not to `list`.
template <class Work>
__global__ void __launch_bounds__(kNearBlock)
    list_near(unsigned n, const __grid_constant__ Work work, NearSphere<typename Work::Item> *list,
              unsigned *listed)
{
  using S = typename Work::Item;
  constexpr unsigned kEach = kNearEach<S>;
  let_next_begin();
  __shared__ std::uint16_t maybe_at[kNearTile<S>];
  __shared__ unsigned n_maybe, n_near, place_in_list;
  if (threadIdx.x == 0) n_maybe = n_near = 0;

  const unsigned tile = blockIdx.x * kNearTile<S>, n_tile = min(n - tile, kNearTile<S>);
  S sphere[kEach] = {};
#pragma unroll
  for (unsigned k = 0; k < kEach; k++) {
    const unsigned i = threadIdx.x + k * kNearBlock;
    if (i < n_tile) sphere[k] = read_once(work.spheres[tile + i]);
  }
  // All bits of a word where it is not known which to ask for.
  std::uint32_t place[kEach], word[kEach];
#pragma unroll
  for (unsigned k = 0; k < kEach; k++) {
    const BrickGuess guess = work.guess(sphere[k]);
    place[k] = guess.place;
    word[k] = guess.unsure ? ~0u : 0;
    if (guess.inside & !guess.unsure) word[k] = work.table.words[place[k] / 32].bits;
  }
  __syncthreads();
  unsigned votes[kEach], all = 0;
#pragma unroll
  for (unsigned k = 0; k < kEach; k++) {
    const bool there = threadIdx.x + k * kNearBlock < n_tile;
    votes[k] = __ballot_sync(kAllLanes, there && (word[k] >> place[k] % 32 & 1u));
    all += __popc(votes[k]);
  }
  unsigned to = room_at(&n_maybe, all);
#pragma unroll
  for (unsigned k = 0; k < kEach; k++) {
    if (votes[k] >> threadIdx.x % 32 & 1u)
      maybe_at[to + votes_below(votes[k])] =
          static_cast<std::uint16_t>(threadIdx.x + k * kNearBlock);
    to += __popc(votes[k]);
  }
  for (unsigned four = 4 * threadIdx.x; four < n_tile; four += 4 * kNearBlock)
    if (four + 4 <= n_tile)
      work.four_far(tile + four);
    else
      for (unsigned i = four; i < n_tile; i++) work.far(tile + i);
  __syncthreads();

  // Few may be in a brick, and those in full warps, nearly always in one turn.
  const unsigned n_turns = n_maybe;
  for (unsigned first = 0; first < n_turns; first += kNearBlock) {
    const unsigned mine = first + threadIdx.x;
    NearSphere<S> near;
    std::uint32_t cell = kNoCell;
    if (mine < n_turns) {
      near.sphere = tile + maybe_at[mine];
      near.s = work.sphere(near.sphere);
      cell = work.cell(near.s);
      if (cell != kNoCell) near.cell = *work.list(cell);
    }
    const unsigned yes = __ballot_sync(kAllLanes, cell != kNoCell);
    const unsigned at = room_at(&n_near, __popc(yes)) + votes_below(yes);
    __syncthreads();
    if (threadIdx.x == 0) {
      if (n_near > 0) place_in_list = atomicAdd(listed, n_near);
      n_near = 0;
    }
    __syncthreads();
    near.pad = 0;
    if (cell != kNoCell) list[place_in_list + at] = near;
  }
}

// How many spheres are listed, and how many of them have lists that are long.
struct NearCounts {
  unsigned listed, with_long;
};

// Answers the listed spheres but those with long lists, which it lists in turn as far as
// `most_long` go, and clears the counts that the next run begins with.
template <class Work>
__global__ void __launch_bounds__(kAnswerBlock, kAnswerBlocks)
    answer_listed(const __grid_constant__ Work work, const NearSphere<typename Work::Item> *list,
                  NearCounts *counts, NearCounts *next_counts,
                  NearSphere<typename Work::Item> *long_list, unsigned most_long)
{
  wait_for_last_kernel();
  const unsigned n = counts->listed, first = blockIdx.x * kAnswerBlock + threadIdx.x;
  if (first == 0) *next_counts = {0, 0};
  for (unsigned k = first; k < n; k += gridDim.x * kAnswerBlock) {
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
  void reserve(std::size_t n)
  {
    const std::size_t most = std::min(n, kRun) * sizeof(NearSphere<S>);
    if (list_.size() < most) list_ = CudaBackend::Array<char>(most);
    if (counts_.size() > 0) return;
    long_list_ = CudaBackend::Array<char>(kMostLong * sizeof(NearSphere<Sphere>));
    counts_ = CudaBackend::Array<NearCounts>(2);
    cuda_check(cudaMemset(counts_.data(), 0, 2 * sizeof(NearCounts)), "clearing memory");
    int device = 0, processors = 0;
    cuda_check(cudaGetDevice(&device), "asking for the device");
    cuda_check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device),
               "asking for its processors");
    processors_ = static_cast<unsigned>(processors);
  }

  template <class Work>
  void run(CudaBackend &b, std::size_t n, const Work &work)
  {
    using Near = NearSphere<typename Work::Item>;
    constexpr unsigned kTile = kNearTile<typename Work::Item>;
    Near *list = reinterpret_cast<Near *>(list_.data());
    Near *long_list = reinterpret_cast<Near *>(long_list_.data());
    for (std::size_t from = 0; from < n; from += kRun) {
      const Work mine = work.after(from);
      const unsigned m = static_cast<unsigned>(std::min(n - from, kRun));
      NearCounts *counts = counts_.data() + turn_, *next = counts_.data() + (1 - turn_);
      turn_ = 1 - turn_;
      list_near<<<(m + kTile - 1) / kTile, kNearBlock, 0, b.stream>>>(m, mine, list,
                                                                      &counts->listed);
      cuda_check(cudaGetLastError(), "starting a kernel");
      const unsigned blocks =
          std::min((m + kAnswerBlock - 1) / kAnswerBlock, processors_ * kAnswerBlocks);
      static const bool can = can_begin_early(answer_listed<Work>);
      start_beside(can, b.stream, blocks, kAnswerBlock, answer_listed<Work>, mine, list, counts,
                   next, long_list, kMostLong);
      if constexpr (Work::kTogether) {
        answer_long<<<processors_, kAnswerBlock, 0, b.stream>>>(mine, long_list, counts, kMostLong);
        cuda_check(cudaGetLastError(), "starting a kernel");
      }
    }
  }

 private:
  static constexpr std::size_t kRun = std::size_t(1) << 24;    // spheres of a pair of kernels

  // Where there are more, their lanes read them.
  static constexpr unsigned kMostLong = 1 << 16;

  CudaBackend::Array<char> list_, long_list_;    // of NearSphere
  CudaBackend::Array<NearCounts> counts_;        // of this run and of the next
  unsigned processors_ = 0;
  int turn_ = 0;
};

}    // namespace lsdcd
