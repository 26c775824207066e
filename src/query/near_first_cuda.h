// A query in kernels that each have one kind of work. The first is light: many threads, several
// spheres in flight in each thread, tables that stay in L1 and L2; it answers every sphere as if
// the wall were far and lists those near to it, with all that their answers begin from. The
// second has full warps of those, whatever their order in memory. What one thread would read for
// too long is left to a warp each in a third.
#pragma once

#include "engine/backend_cuda.h"
#include "grid/brick_words.h"
#include "query/sphere.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

// A sphere near the wall and the list of its cell, so that the second kernel waits for neither.
template <class S>
struct alignas(16) NearSphere {
  S s;
  Cell cell;
  std::uint32_t sphere;
};

constexpr unsigned kNearBlock = 256, kNearEach = 4,    // threads, and spheres of each
    kAnswerBlocks = 3,    // of the second kernel, at once on a processor: 80 registers a thread
    kNearTile = kNearBlock * kNearEach, kTileBits = 10;
static_assert(kNearTile == 1u << kTileBits, "a place in a tile takes these bits");
static_assert(kBrickCells <= 1 << (32 - kTileBits), "a cell of a brick fits above them");

// Of a block's tile: a sphere in a brick, by its place in the tile and its cell in the brick.
struct alignas(8) TileSphere {
  std::uint32_t brick, place_and_cell;
};

// Room at `end` for what each lane of a warp adds: where this lane's begin.
__device__ inline unsigned room_for(unsigned n, unsigned *end)
{
  const unsigned lane = threadIdx.x % 32, all = 0xffffffffu;
  unsigned sum = n;
  for (unsigned d = 1; d < 32; d *= 2) {
    const unsigned below = __shfl_up_sync(all, sum, d);
    if (lane >= d) sum += below;
  }
  unsigned at = 0;
  if (lane == 31 && sum > 0) at = atomicAdd(end, sum);
  return __shfl_sync(all, at, 31) + sum - n;
}

// Answers the n spheres from `from` on, a multiple of 4, as if all were far, and appends those
// that are not to `list`.
template <class Work>
__global__ void __launch_bounds__(kNearBlock)
    list_near(std::size_t from, unsigned n, const __grid_constant__ Work work,
              NearSphere<typename Work::Item> *list, std::uint32_t *listed)
{
  __shared__ TileSphere in_bricks[kNearTile];
  __shared__ unsigned n_in_bricks, n_near, place_in_list;
  if (threadIdx.x == 0) n_in_bricks = n_near = 0;
  __syncthreads();

  const std::size_t tile = from + std::size_t(blockIdx.x) * kNearTile;
  const unsigned left = n - blockIdx.x * kNearTile, n_tile = left < kNearTile ? left : kNearTile;
  typename Work::Item sphere[kNearEach] = {};
#pragma unroll
  for (unsigned k = 0; k < kNearEach; k++) {
    const unsigned i = threadIdx.x + k * kNearBlock;
    if (i < n_tile) sphere[k] = work.sphere(tile + i);
  }
  BrickPlace at[kNearEach];
  BrickWord word[kNearEach];
#pragma unroll
  for (unsigned k = 0; k < kNearEach; k++) {
    at[k] = work.place(sphere[k]);
    if (threadIdx.x + k * kNearBlock >= n_tile) at[k].place = kNoBrick;
    word[k] = work.word(at[k]);
  }
  std::uint32_t brick[kNearEach];
  unsigned mine = 0;
#pragma unroll
  for (unsigned k = 0; k < kNearEach; k++) {
    brick[k] = brick_in(word[k], at[k]);
    mine += brick[k] != kNoBrick;
  }
  unsigned to = room_for(mine, &n_in_bricks);
#pragma unroll
  for (unsigned k = 0; k < kNearEach; k++)
    if (brick[k] != kNoBrick)
      in_bricks[to++] = {brick[k], (threadIdx.x + k * kNearBlock) |
                                       static_cast<std::uint32_t>(at[k].cell) << kTileBits};

  const unsigned four = 4 * threadIdx.x;
  if (four + 4 <= n_tile)
    work.four_far(tile + four);
  else
    for (unsigned i = four; i < n_tile; i++) work.far(tile + i);
  __syncthreads();

  // Few are in a brick, and those in full warps, nearly always in one turn.
  const unsigned n_in = n_in_bricks;
  if (n_in == 0) return;
  Cell cell[kNearEach];
  bool near[kNearEach];
  mine = 0;
#pragma unroll
  for (unsigned k = 0; k < kNearEach; k++) {
    const unsigned i = threadIdx.x + k * kNearBlock;
    std::uint32_t index = kNoCell;
    if (i < n_in)
      index = work.cell_of(in_bricks[i].brick,
                           static_cast<std::int32_t>(in_bricks[i].place_and_cell >> kTileBits));
    near[k] = index != kNoCell;
    mine += near[k];
    if (near[k]) cell[k] = work.list(index);
  }
  to = room_for(mine, &n_near);
  __syncthreads();
  if (threadIdx.x == 0 && n_near > 0) place_in_list = atomicAdd(listed, n_near);
  __syncthreads();
  to += place_in_list;
#pragma unroll
  for (unsigned k = 0; k < kNearEach; k++)
    if (near[k]) {
      const unsigned i = in_bricks[threadIdx.x + k * kNearBlock].place_and_cell & (kNearTile - 1);
      list[to++] = {work.sphere(tile + i), cell[k], blockIdx.x * kNearTile + i};
    }
}

// A warp, for what its threads do together.
struct WarpLanes {
  static constexpr unsigned kCount = 32;

  __device__ unsigned lane() const { return threadIdx.x % 32; }
  __device__ unsigned vote(bool yes) const { return __ballot_sync(kAll, yes); }
  template <class T>
  __device__ T from(T value, unsigned lane) const
  {
    return __shfl_sync(kAll, value, lane);
  }
  template <class T>
  __device__ T from_below(T value, unsigned step) const
  {
    return __shfl_up_sync(kAll, value, step);
  }

 private:
  static constexpr unsigned kAll = 0xffffffffu;
};

// How many spheres are listed, and how many of them have lists that are long.
struct NearCounts {
  std::uint32_t listed, with_long;
};

// Answers the listed spheres but those with long lists, which it lists in turn as far as
// `most_long` go, and clears the counts that the next run begins with.
template <class Work>
__global__ void __launch_bounds__(kNearBlock, kAnswerBlocks)
    answer_listed(std::size_t from, const __grid_constant__ Work work,
                  const NearSphere<typename Work::Item> *list, NearCounts *counts,
                  NearCounts *next_counts, NearSphere<typename Work::Item> *long_list,
                  std::uint32_t most_long)
{
  const unsigned n = counts->listed, first = blockIdx.x * blockDim.x + threadIdx.x;
  if (first == 0) *next_counts = {0, 0};
  for (unsigned k = first; k < n; k += gridDim.x * blockDim.x) {
    const NearSphere<typename Work::Item> one = list[k];
    if (work.is_long(one.cell)) {
      const std::uint32_t at = atomicAdd(&counts->with_long, 1u);
      if (at < most_long) {
        long_list[at] = one;
        continue;
      }
    }
    work.answer(from + one.sphere, one.s, one.cell);
  }
}

// A warp for each sphere with a long list.
template <class Work>
__global__ void __launch_bounds__(kNearBlock)
    answer_long(std::size_t from, const __grid_constant__ Work work,
                const NearSphere<typename Work::Item> *long_list, const NearCounts *counts,
                std::uint32_t most_long)
{
  const unsigned n = counts->with_long < most_long ? counts->with_long : most_long;
  for (unsigned k = (blockIdx.x * kNearBlock + threadIdx.x) / 32; k < n;
       k += gridDim.x * (kNearBlock / 32)) {
    const NearSphere<typename Work::Item> one = long_list[k];
    work.answer_together(from + one.sphere, one.s, one.cell, WarpLanes());
  }
}

class NearFirst {
 public:
  // Room for the worst case, all spheres of a run near: 32 bytes for each in float, 48 in double.
  template <class S>
  void reserve(std::size_t n)
  {
    const std::size_t most = (n < kRun ? n : kRun) * sizeof(NearSphere<S>);
    if (list_.size() < most) list_ = CudaBackend::Array<char>(most);
    if (counts_.size() > 0) return;
    long_list_ = CudaBackend::Array<char>(kMostLong * sizeof(NearSphere<Sphere>));
    counts_ = CudaBackend::Array<NearCounts>(2);
    cuda_check(cudaMemset(counts_.data(), 0, 2 * sizeof(NearCounts)), "clearing memory");
    int device = 0;
    cuda_check(cudaGetDevice(&device), "asking for the device");
    cuda_check(cudaDeviceGetAttribute(&processors_, cudaDevAttrMultiProcessorCount, device),
               "asking for its processors");
  }

  template <class Work>
  void run(CudaBackend &b, std::size_t n, const Work &work)
  {
    auto *list = reinterpret_cast<NearSphere<typename Work::Item> *>(list_.data());
    auto *long_list = reinterpret_cast<NearSphere<typename Work::Item> *>(long_list_.data());
    for (std::size_t from = 0; from < n; from += kRun) {
      const unsigned m = static_cast<unsigned>(n - from < kRun ? n - from : kRun);
      NearCounts *mine = counts_.data() + turn_, *next = counts_.data() + (1 - turn_);
      turn_ = 1 - turn_;
      list_near<<<(m + kNearTile - 1) / kNearTile, kNearBlock, 0, b.stream>>>(from, m, work, list,
                                                                              &mine->listed);
      cuda_check(cudaGetLastError(), "starting a kernel");
      const unsigned most = (m + kNearBlock - 1) / kNearBlock,
                     some = processors_ * kTurns * kAnswerBlocks,
                     blocks = most < some ? most : some;
      answer_listed<<<blocks, kNearBlock, 0, b.stream>>>(from, work, list, mine, next, long_list,
                                                         kMostLong);
      cuda_check(cudaGetLastError(), "starting a kernel");
      if constexpr (Work::kTogether) {
        answer_long<<<processors_, kNearBlock, 0, b.stream>>>(from, work, long_list, mine,
                                                              kMostLong);
        cuda_check(cudaGetLastError(), "starting a kernel");
      }
    }
  }

 private:
  static constexpr std::size_t kRun = std::size_t(1) << 24;    // spheres per pair of kernels
  static constexpr unsigned kTurns = 3;                        // to even out what blocks take

  // Where there are more, their threads read them.
  static constexpr std::uint32_t kMostLong = 1 << 16;

  CudaBackend::Array<char> list_, long_list_;    // of NearSphere
  CudaBackend::Array<NearCounts> counts_;        // of this run and of the next
  int processors_ = 0, turn_ = 0;
};

}    // namespace lsdcd
