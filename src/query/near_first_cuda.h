// A query in kernels that each have one kind of work. The first is light: many threads, several spheres in flight in
// each thread, tables that stay in L1 and L2; it answers every sphere far from the wall and
// lists the others. The second has full warps of those, whatever their order in memory. What
// one thread would read for too long is left to a warp each in a third.
#pragma once

#include "engine/backend_cuda.h"
#include "grid/brick_words.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

// A sphere near the wall and its cell.
struct alignas(8) NearSphere {
  std::uint32_t sphere, cell;
};

constexpr unsigned kNearBlock = 256, kNearEach = 4;    // threads, and spheres of each

// Appends those of the n spheres from `from` on that are near to `list`.
template <class Work>
__global__ void __launch_bounds__(kNearBlock)
    list_near(std::size_t from, unsigned n, const __grid_constant__ Work work, NearSphere *list,
              std::uint32_t *listed)
{
  __shared__ unsigned of_block, place_of_block;
  if (threadIdx.x == 0) of_block = 0;
  __syncthreads();

  const unsigned first = blockIdx.x * (kNearBlock * kNearEach) + threadIdx.x;
  typename Work::Item sphere[kNearEach];
#pragma unroll
  for (unsigned k = 0; k < kNearEach; k++)
    if (first + k * kNearBlock < n) sphere[k] = work.sphere(from + first + k * kNearBlock);
  const unsigned lane = threadIdx.x % 32;
  unsigned cell[kNearEach], vote[kNearEach], of_warp = 0;
#pragma unroll
  for (unsigned k = 0; k < kNearEach; k++) {
    const unsigned i = first + k * kNearBlock;
    cell[k] = i < n ? work.cell_of(sphere[k]) : kNoCell;
    if (i < n && cell[k] == kNoCell) work.far(from + i);
    vote[k] = __ballot_sync(0xffffffffu, cell[k] != kNoCell);
    of_warp += __popc(vote[k]);
  }
  unsigned at = 0;
  if (lane == 0 && of_warp > 0) at = atomicAdd(&of_block, of_warp);
  at = __shfl_sync(0xffffffffu, at, 0);
  __syncthreads();
  if (threadIdx.x == 0 && of_block > 0) place_of_block = atomicAdd(listed, of_block);
  __syncthreads();
  if (of_warp == 0) return;
  at += place_of_block;
#pragma unroll
  for (unsigned k = 0; k < kNearEach; k++) {
    if (vote[k] >> lane & 1)
      list[at + __popc(vote[k] & ((1u << lane) - 1))] = {first + k * kNearBlock, cell[k]};
    at += __popc(vote[k]);
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
template <int kBlocks, class Work>
__global__ void __launch_bounds__(kNearBlock, kBlocks)
    answer_listed(std::size_t from, const __grid_constant__ Work work, const NearSphere *list,
                  NearCounts *counts, NearCounts *next_counts, NearSphere *long_list,
                  std::uint32_t most_long)
{
  const unsigned n = counts->listed, first = blockIdx.x * blockDim.x + threadIdx.x;
  if (first == 0) *next_counts = {0, 0};
  for (unsigned k = first; k < n; k += gridDim.x * blockDim.x) {
    const NearSphere one = list[k];
    if (work.is_long(one.cell)) {
      const std::uint32_t at = atomicAdd(&counts->with_long, 1u);
      if (at < most_long) {
        long_list[at] = one;
        continue;
      }
    }
    const std::size_t i = from + one.sphere;
    work.answer(i, work.sphere(i), one.cell);
  }
}

// A warp for each sphere with a long list.
template <class Work>
__global__ void __launch_bounds__(kNearBlock)
    answer_long(std::size_t from, const __grid_constant__ Work work, const NearSphere *long_list,
                const NearCounts *counts, std::uint32_t most_long)
{
  const unsigned n = counts->with_long < most_long ? counts->with_long : most_long;
  for (unsigned k = (blockIdx.x * kNearBlock + threadIdx.x) / 32; k < n;
       k += gridDim.x * (kNearBlock / 32)) {
    const std::size_t i = from + long_list[k].sphere;
    work.answer_together(i, work.sphere(i), long_list[k].cell, WarpLanes());
  }
}

// kBlocks: of the second kernel, at once on a processor. With 4 of them 64 registers are
// left to a thread; a few numbers of rare branches do not fit.
template <int kBlocks>
class NearFirstWith {
 public:
  void reserve(std::size_t n)
  {
    const std::size_t most = n < kRun ? n : kRun;
    if (list_.size() < most) list_ = CudaBackend::Array<NearSphere>(most);
    if (counts_.size() > 0) return;
    long_list_ = CudaBackend::Array<NearSphere>(kMostLong);
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
    for (std::size_t from = 0; from < n; from += kRun) {
      const unsigned m = static_cast<unsigned>(n - from < kRun ? n - from : kRun);
      NearCounts *mine = counts_.data() + turn_, *next = counts_.data() + (1 - turn_);
      turn_ = 1 - turn_;
      const unsigned each = kNearBlock * kNearEach;
      list_near<<<(m + each - 1) / each, kNearBlock, 0, b.stream>>>(from, m, work, list_.data(),
                                                                    &mine->listed);
      cuda_check(cudaGetLastError(), "starting a kernel");
      const unsigned most = (m + kNearBlock - 1) / kNearBlock,
                     some = processors_ * kTurns * kBlocks, blocks = most < some ? most : some;
      answer_listed<kBlocks><<<blocks, kNearBlock, 0, b.stream>>>(
          from, work, list_.data(), mine, next, long_list_.data(), kMostLong);
      cuda_check(cudaGetLastError(), "starting a kernel");
      if constexpr (Work::kTogether) {
        answer_long<<<processors_, kNearBlock, 0, b.stream>>>(from, work, long_list_.data(), mine,
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

  CudaBackend::Array<NearSphere> list_, long_list_;
  CudaBackend::Array<NearCounts> counts_;    // of this run and of the next
  int processors_ = 0, turn_ = 0;
};
using NearFirst = NearFirstWith<4>;

}    // namespace lsdcd
