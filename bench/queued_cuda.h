// A query in one kernel: each warp answers the spheres that are far from the wall, keeps
// the others in a queue of its own in shared memory and answers them whenever it has a
// full warp of them. Against NearFirst: no list in device memory, no second launch, and
// near spheres come from L2; but all of it at the occupancy of the heavier part.
#pragma once

#include "query/near_first_cuda.h"

namespace lsdcd {

constexpr unsigned kQueuedBlocks = 3;                   // at once on a processor
constexpr unsigned kQueueRoom = 32 * kNearEach + 31;    // a round on top of what was left

// Answers one near sphere per lane; those with long lists one after another, by all lanes.
template <class Work>
__device__ void answer_warp(const Work &work, std::size_t from, bool has_one, const NearSphere &one)
{
  const WarpLanes lanes;
  const bool is_long = has_one && work.is_long(one.cell);
  if (has_one && !is_long) {
    const std::size_t i = from + one.sphere;
    work.answer(i, work.sphere(i), one.cell);
  }
  for (unsigned left = lanes.vote(is_long); left; left &= left - 1) {
    const unsigned whose = lowest_bit(left);
    const std::size_t i = from + lanes.from(one.sphere, whose);
    work.answer_together(i, work.sphere(i), lanes.from(one.cell, whose), lanes);
  }
}

template <class Work>
__global__ void __launch_bounds__(kNearBlock, kQueuedBlocks)
    answer_queued(std::size_t n, const __grid_constant__ Work work)
{
  __shared__ NearSphere queues[kNearBlock / 32][kQueueRoom];
  NearSphere *queue = queues[threadIdx.x / 32];
  const unsigned lane = threadIdx.x % 32, all = 0xffffffffu;
  const std::size_t n_rounds = (n + 32 * kNearEach - 1) / (32 * kNearEach),
                    n_warps = std::size_t(gridDim.x) * (kNearBlock / 32);
  unsigned queued = 0;
  for (std::size_t round = std::size_t(blockIdx.x) * (kNearBlock / 32) + threadIdx.x / 32;
       round < n_rounds; round += n_warps) {
    const std::size_t first = round * (32 * kNearEach) + lane;
    typename Work::Item sphere[kNearEach];
#pragma unroll
    for (unsigned k = 0; k < kNearEach; k++)
      if (first + k * 32 < n) sphere[k] = work.sphere(first + k * 32);
#pragma unroll
    for (unsigned k = 0; k < kNearEach; k++) {
      const std::size_t i = first + k * 32;
      const std::uint32_t cell = i < n ? work.cell_of(sphere[k]) : kNoCell;
      if (i < n && cell == kNoCell) work.far(i);
      const unsigned vote = __ballot_sync(all, cell != kNoCell);
      if (cell != kNoCell)
        queue[queued + __popc(vote & ((1u << lane) - 1))] = {static_cast<std::uint32_t>(i), cell};
      queued += __popc(vote);
    }
    __syncwarp();
    while (queued >= 32) {
      queued -= 32;
      answer_warp(work, 0, true, queue[queued + lane]);
    }
    __syncwarp();
  }
  answer_warp(work, 0, lane < queued, lane < queued ? queue[lane] : NearSphere{0, 0});
}

class Queued {
 public:
  void reserve(std::size_t)
  {
    int device = 0;
    cuda_check(cudaGetDevice(&device), "asking for the device");
    cuda_check(cudaDeviceGetAttribute(&processors_, cudaDevAttrMultiProcessorCount, device),
               "asking for its processors");
  }

  template <class Work>
  void run(CudaBackend &b, std::size_t n, const Work &work)
  {
    if (n > 0xffffffffull) throw InputError("a queue takes at most 4294967295 spheres");
    const unsigned blocks = processors_ * kQueuedBlocks;    // all there at once
    answer_queued<<<blocks, kNearBlock, 0, b.stream>>>(n, work);
    cuda_check(cudaGetLastError(), "starting a kernel");
  }

 private:
  int processors_ = 0;
};

}    // namespace lsdcd
