// A query in two kernels. The first is light: full occupancy, several spheres in flight in
// each thread, tables that stay in L1 and L2; it answers every sphere far from the wall and
// lists the others. The second has full warps of those, whatever their order in memory.
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

// Answers the listed spheres, and clears the count that the next list begins with.
template <int kBlocks, class Work>
__global__ void __launch_bounds__(kNearBlock, kBlocks)
    answer_listed(std::size_t from, const __grid_constant__ Work work, const NearSphere *list,
                  const std::uint32_t *listed, std::uint32_t *next_listed)
{
  const unsigned n = *listed, first = blockIdx.x * blockDim.x + threadIdx.x;
  if (first == 0) *next_listed = 0;
  for (unsigned k = first; k < n; k += gridDim.x * blockDim.x) {
    const NearSphere one = list[k];
    const std::size_t i = from + one.sphere;
    work.answer(i, work.sphere(i), one.cell);
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
    if (listed_.size() > 0) return;
    listed_ = CudaBackend::Array<std::uint32_t>(2);
    cuda_check(cudaMemset(listed_.data(), 0, 2 * sizeof(std::uint32_t)), "clearing memory");
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
      std::uint32_t *mine = listed_.data() + turn_, *next = listed_.data() + (1 - turn_);
      turn_ = 1 - turn_;
      const unsigned each = kNearBlock * kNearEach;
      list_near<<<(m + each - 1) / each, kNearBlock, 0, b.stream>>>(from, m, work, list_.data(),
                                                                    mine);
      cuda_check(cudaGetLastError(), "starting a kernel");
      const unsigned most = (m + kNearBlock - 1) / kNearBlock,
                     some = processors_ * kTurns * kBlocks, blocks = most < some ? most : some;
      answer_listed<kBlocks>
          <<<blocks, kNearBlock, 0, b.stream>>>(from, work, list_.data(), mine, next);
      cuda_check(cudaGetLastError(), "starting a kernel");
    }
  }

 private:
  static constexpr std::size_t kRun = std::size_t(1) << 26;    // spheres per pair of kernels
  static constexpr unsigned kTurns = 3;                        // to even out what blocks take

  CudaBackend::Array<NearSphere> list_;
  CudaBackend::Array<std::uint32_t> listed_;    // this run's count and the next one's
  int processors_ = 0, turn_ = 0;
};
using NearFirst = NearFirstWith<4>;

}    // namespace lsdcd
