// Choosing among many spheres on an NVIDIA GPU: bits of those to keep, and from them a list.
#pragma once

#include "base/strided_view.h"
#include "backend/cuda_bricks.h"
#include "backend/cuda_limits.h"
#include "backend/cuda_second_look.h"

#include <cub/block/block_reduce.cuh>
#include <cub/block/block_scan.cuh>
#include <cuda_pipeline_primitives.h>
#include <cuda_runtime.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace lsdcd {

constexpr unsigned kMarkTile = 128,
                   kMarkWords = kMarkTile / kWarpSize;    // items of a warp at a time

// Warps of a block at most, and blocks at once on a processor: 48 registers a thread.
constexpr unsigned kMarkWarps = 20, kMarkBlocks = 2, kMarkBlock = kWarpSize * kMarkWarps;

// A warp's tile: rows of the items' slots, those to look at more closely, and bits of those
// that are kept.
struct alignas(16) MarkTile {
  double slot[kMarkTile][3];
  unsigned kept[kMarkWords];
  std::uint8_t waiting[kMarkTile];
};

// Asks for n rows from `first` on for a warp, to be there after __pipeline_wait_prior(0) and a
// barrier. Packed ones come in parts of 16 bytes, whosever they are.
__device__ inline void bring_rows(const StridedView<const double> &rows, std::size_t first,
                                  unsigned n, double (*to)[3])
{
  const unsigned lane = Warp<kWarpSize>::rank();
  if (n == kMarkTile && rows.row == 3 && rows.column == 1 &&
      reinterpret_cast<std::uintptr_t>(rows.of(first)) % sizeof(uint4) == 0) {
    const uint4 *from = reinterpret_cast<const uint4 *>(rows.of(first)) + lane;
    uint4 *there = reinterpret_cast<uint4 *>(to) + lane;
#pragma unroll
    for (unsigned k = 0; k < kMarkTile * 3 * sizeof(double) / sizeof(uint4); k += kWarpSize)
      __pipeline_memcpy_async(there + k, from + k, sizeof(uint4));
  } else {
    for (unsigned i = lane; i < n; i += kWarpSize) {
      const Vec3 row = rows[first + i];
      to[i][0] = row.x;
      to[i][1] = row.y;
      to[i][2] = row.z;
    }
  }
  __pipeline_commit();
}

// Bits of the items to keep, or none and a list for a second look. Warps stay and take one tile
// after the other. Few may be kept, and more is read of those alone, by full warps.
template <bool kTableNear, class Work>
__global__ void __launch_bounds__(kMarkBlock, kMarkBlocks)
    cuda_mark(unsigned n, const __grid_constant__ Work work, unsigned *words,
              const SecondLookList list)
{
  constexpr unsigned kEach = kMarkTile / kWarpSize;
  extern __shared__ uint4 mark_shared[];
  __shared__ unsigned turns;
  const Warp<kWarpSize> warp;
  const unsigned lane = warp.rank(), n_warps = blockDim.x / kWarpSize;
  MarkTile *const tiles = reinterpret_cast<MarkTile *>(mark_shared),
                  &mine = tiles[threadIdx.x / kWarpSize];
  if (threadIdx.x == 0) turns = n_warps;
  const auto table = [&] {
    if constexpr (kTableNear)
      return BrickTableNear(work.table, tiles + n_warps);
    else
      return work.table;
  }();
  __syncthreads();
  const auto place_of = [&](unsigned i) {
    return Vec3{mine.slot[i][0], mine.slot[i][1], mine.slot[i][2]};
  };

  // A block has every gridDim.x-th tile, and its warps take them as they come.
  for (unsigned turn = threadIdx.x / kWarpSize;;) {
    const unsigned tile = turn * gridDim.x + blockIdx.x, first = tile * kMarkTile;
    if (first >= n) return;
    const unsigned last = min(n - first, kMarkTile) - 1;
    bring_rows(work.places(), first, last + 1, mine.slot);
    typename Work::Item item[kEach];
    bool odd = false;
#pragma unroll
    for (unsigned k = 0; k < kEach; k++)
      item[k] = work.read(first + min(lane + k * kWarpSize, last));
    if (lane < kMarkWords) mine.kept[lane] = 0;
    turn = warp.take_room(&turns, 1);
#pragma unroll
    for (unsigned k = 0; k < kEach; k++) odd = odd || work.may_be_large(item[k]);
    if (odd)
      for (unsigned i = lane; i <= last; i += kWarpSize)
        work.check(first + i, work.read(first + i));
    __pipeline_wait_prior(0);
    __syncwarp();

    unsigned waiting = 0;
#pragma unroll
    for (unsigned k = 0; k < kEach; k++) {
      const unsigned i = lane + k * kWarpSize;
      const bool may = work.may_keep(item[k], place_of(min(i, last)), table) & (i <= last);
      const unsigned votes = warp.vote(may);
      if (may) mine.waiting[waiting + warp.count_below(votes)] = static_cast<std::uint8_t>(i);
      waiting += warp.count(votes);
    }
    __syncwarp();
#pragma unroll 1    // nearly always one turn
    for (unsigned turn_first = 0; turn_first < waiting; turn_first += kWarpSize) {
      const unsigned w = turn_first + lane, i = mine.waiting[min(w, waiting - 1)];
      const std::uint32_t found = w < waiting ? work.find(place_of(i), table) : Work::kNotFound;
      const bool kept = found != Work::kNotFound;
      if (kept) atomicOr(&mine.kept[i / 32], 1u << (i % 32));
      if (list.items) list.put(kept, {first + i, found});
    }
    __syncwarp();
    if (work.notes())
      for (unsigned i = lane; i <= last; i += kWarpSize)
        work.note(first + i, mine.kept[i / 32] >> lane & 1u);
    if (lane < kMarkWords) words[tile * kMarkWords + lane] = list.items ? 0 : mine.kept[lane];
    __syncwarp();
  }
}

template <class Work>
void start_mark(unsigned n, const Work &work, CudaLimits &limits, unsigned *words,
                const SecondLookList &list, cudaStream_t stream)
{
  const CudaLimits::Shape shape =
      limits.shape(kMarkWarps, kMarkBlocks, sizeof(MarkTile), BrickTableNear::bytes(work.table));
  const unsigned of_block = kMarkTile * shape.warps;
  const auto kernel = shape.has_table ? cuda_mark<true, Work> : cuda_mark<false, Work>;
  limits.allow(kernel, shape.shared);
  kernel<<<std::min((n + of_block - 1) / of_block, limits.processors() * kMarkBlocks),
           kWarpSize * shape.warps, shape.shared, stream>>>(n, work, words, list);
  cuda_check(cudaGetLastError(), "starting a kernel");
}

// From bits to a list: each block counts those of its words, waits for what blocks before it have
// counted, and writes its own. *total becomes how many there are, or kNoRoom where a second look had
// too little room.
constexpr std::uint32_t kNoRoom = ~std::uint32_t(0);
constexpr unsigned kGatherBlock = 1024;
struct GatherCounts {
  volatile unsigned long long *of_block;    // low word: what it counted; high word: in which turn
  unsigned turn;                            // another one for each gathering
};
__global__ static void __launch_bounds__(kGatherBlock)
    cuda_gather(const unsigned *words, unsigned n_words, unsigned each, const GatherCounts counts,
                const SecondLookList list, int *to, std::uint32_t *total)
{
  using Sum = cub::BlockReduce<unsigned, kGatherBlock>;
  using Scan = cub::BlockScan<unsigned, kGatherBlock>;
  __shared__ union {
    typename Sum::TempStorage sum;
    typename Scan::TempStorage scan;
  } shared;
  __shared__ unsigned before;
  const unsigned begin = blockIdx.x * each, end = min(begin + each, n_words);
  unsigned n = 0;
  for (unsigned w = begin + threadIdx.x; w < end; w += kGatherBlock) n += __popc(words[w]);
  n = Sum(shared.sum).Sum(n);
  if (threadIdx.x == 0)
    counts.of_block[blockIdx.x] = static_cast<unsigned long long>(counts.turn) << 32 | n;
  __syncthreads();

  // Blocks begin in the order of their numbers, so that those before this one are at work or done.
  unsigned ahead = 0;
  for (unsigned b = threadIdx.x; b < blockIdx.x; b += kGatherBlock) {
    unsigned long long counted = 0;
    do counted = counts.of_block[b];
    while (counted >> 32 != counts.turn);
    ahead += static_cast<unsigned>(counted);
  }
  ahead = Sum(shared.sum).Sum(ahead);
  if (threadIdx.x == 0) before = ahead;
  if (blockIdx.x == gridDim.x - 1 && threadIdx.x < kWarpSize) {
    const bool was_short = list.length && list.empty();
    if (threadIdx.x == 0) *total = was_short ? kNoRoom : ahead + n;
  }
  __syncthreads();

  int *next = to + before;
  for (unsigned first = begin; first < end; first += kGatherBlock) {
    const unsigned w = first + threadIdx.x, word = w < end ? words[w] : 0;
    unsigned at, all;
    Scan(shared.scan).ExclusiveSum(__popc(word), at, all);
    __syncthreads();
    for (unsigned left = word; left != 0; left &= left - 1)
      next[at++] = static_cast<int>(w * 32 + __ffs(left) - 1);
    next += all;
  }
}

}    // namespace lsdcd
