// A query in one kernel, whose warps stay until all spheres are answered and wait for no other.
// A warp takes tiles of spheres, the next one on its way while it works on this one. It answers
// all of a tile as if the wall were far, and queues the few that may be in a brick. Full warps of
// those look for the list of their cell, and queue those that have one; full warps of these
// answer. So each lane has work in each step, whatever the order of spheres in memory, and
// nothing but answers is written. Lists that are too long for one lane wait for the end, when
// the warps of a block share them.
#pragma once

#include "engine/backend_cuda.h"
#include "grid/brick_filter.h"
#include "query/sphere.h"

#include <cuda_pipeline_primitives.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace lsdcd {

constexpr unsigned kAllLanes = 0xffffffffu;

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

// Spheres of a tile: four pieces of 16 bytes for each lane.
template <class S>
constexpr unsigned kTile = 4 * 32 * 16 / sizeof(S);

// Warps of a block, one block on a processor: 80 registers a thread, or in double 96.
template <class S>
constexpr unsigned kMostWarps = sizeof(S) <= 16 ? 24 : 20;

// Spheres that are near and wait: at most 31 when 32 more come.
constexpr unsigned kNearWait = 64;

// Of a warp, in shared memory. Of spheres that may be in a brick those that wait from tile to
// tile, less than 32, are kept, and the others are in the tile.
template <class S>
struct WarpRoom {
  S tile[2][kTile<S>];    // this one and the next
  S kept[32];
  S near[kNearWait];
  Cell near_cell[kNearWait];
  std::uint32_t near_at[kNearWait], maybe_at[32 + kTile<S>];    // indices of spheres
};
static_assert(sizeof(WarpRoom<Sphere>) % 16 == 0 && sizeof(WarpRoom<FloatSphere>) % 16 == 0,
              "one follows the other");
static_assert(offsetof(WarpRoom<Sphere>, near_cell) % 8 == 0 &&
                  offsetof(WarpRoom<FloatSphere>, near_cell) % 8 == 0,
              "cells are copied in one piece");

// How many lanes below this one vote yes.
__device__ inline unsigned votes_below(unsigned votes)
{
  return __popc(votes & ((1u << threadIdx.x % 32) - 1));
}

// A sphere read in pieces of 16 bytes, all of it, where a compiler would read its coordinates one
// by one from the same banks of shared memory.
template <class S>
__device__ S in_pieces(const S &s)
{
  constexpr unsigned kPieces = sizeof(S) / sizeof(uint4);
  uint4 piece[kPieces];
#pragma unroll
  for (unsigned k = 0; k < kPieces; k++) piece[k] = reinterpret_cast<const uint4 *>(&s)[k];
  S out;
  std::memcpy(&out, piece, sizeof out);
  return out;
}

// Spheres with long lists that wait for the end of a block. Where there are more, one lane each
// reads them, with other lanes that do the same.
constexpr unsigned kMostLong = 512;
struct alignas(16) LongLists {
  unsigned n;    // may be more than there is room for
  std::uint32_t at[kMostLong];
};

// How a kernel's spheres are shared out.
struct WarpTiles {
  unsigned n_spheres, n_tiles, n_warps;    // of all blocks
  unsigned n_words;    // of the brick table, whose bits fit into shared memory; or 0
};

template <class Work>
__global__ void __launch_bounds__(32 * kMostWarps<typename Work::Item>, 1)
    answer_in_warps(const __grid_constant__ Work work, const __grid_constant__ WarpTiles tiles)
{
  using S = typename Work::Item;
  constexpr unsigned kEach = kTile<S> / 32;    // spheres of a lane
  extern __shared__ __align__(16) char shared[];
  __shared__ LongLists long_lists;

  const unsigned lane = threadIdx.x % 32, warp = threadIdx.x / 32;
  WarpRoom<S> *const rooms = reinterpret_cast<WarpRoom<S> *>(shared);
  WarpRoom<S> &room = rooms[warp];
  std::uint32_t *const bricks = reinterpret_cast<std::uint32_t *>(rooms + blockDim.x / 32);

  // Tiles next to each other go to different processors, so that each has its part of those
  // near the wall.
  unsigned tile = blockIdx.x + warp * gridDim.x;

  // Past the last sphere a tile has numbers that are none, and are nowhere in the grid.
  const auto ask_for_tile = [&](unsigned t, unsigned turn) {
    if (t >= tiles.n_tiles) return;
    const unsigned first = t * kTile<S>, left = tiles.n_spheres - first;
    const char *source = reinterpret_cast<const char *>(work.spheres + first) + 16 * lane;
    char *to = reinterpret_cast<char *>(room.tile[turn]) + 16 * lane;
    if (left >= kTile<S>) {
#pragma unroll
      for (unsigned k = 0; k < 4; k++) __pipeline_memcpy_async(to + 512 * k, source + 512 * k, 16);
    } else {
      for (unsigned k = 0; k < 4; k++)
        if (16 * (lane + 32 * k) < left * sizeof(S))
          __pipeline_memcpy_async(to + 512 * k, source + 512 * k, 16);
        else
          *reinterpret_cast<uint4 *>(to + 512 * k) = {~0u, ~0u, ~0u, ~0u};
    }
  };

  // Two groups of copies for each tile: its spheres, and then the cells that it asks for.
  ask_for_tile(tile, 0);
  __pipeline_commit();
  __pipeline_commit();
  if (threadIdx.x == 0) long_lists.n = 0;
#pragma unroll 4
  for (unsigned i = threadIdx.x; i < tiles.n_words; i += blockDim.x) bricks[i] = work.words[i].bits;
  __syncthreads();

  // The same in all lanes: how many may be in a brick, the first n_kept of them from tiles
  // before; where those that are near begin and end, counted from the first ever.
  unsigned n_maybe = 0, n_kept = 0, near_begin = 0, near_end = 0;
  for (unsigned turn = 0;; turn ^= 1, tile += tiles.n_warps) {
    // After the last tile both queues run empty.
    const bool last = tile >= tiles.n_tiles;
    const unsigned first = tile * kTile<S>;
    bool more = last;    // to do than to answer as if far
    if (!last) {
      ask_for_tile(tile + tiles.n_warps, turn ^ 1);
      __pipeline_commit();
      __pipeline_wait_prior(2);
      __syncwarp();

      // All bits of a word where it is not known which to ask for.
      std::uint32_t place[kEach], word[kEach];
      bool ask[kEach];
#pragma unroll
      for (unsigned k = 0; k < kEach; k++) {
        const BrickGuess guess = work.guess(in_pieces(room.tile[turn][lane + 32 * k]));
        place[k] = guess.place;
        word[k] = guess.unsure ? ~0u : 0;
        ask[k] = guess.inside & !guess.unsure;
      }
      if (tiles.n_words > 0) {
#pragma unroll
        for (unsigned k = 0; k < kEach; k++)
          if (ask[k]) word[k] = bricks[place[k] / 32];
      } else {
#pragma unroll
        for (unsigned k = 0; k < kEach; k++)
          if (ask[k]) word[k] = work.words[place[k] / 32].bits;
      }

      const unsigned left = tiles.n_spheres - first;
      if (left >= kTile<S>) {
        if (lane < kTile<S> / 4) work.four_far(first + 4 * lane);
      } else {
        for (unsigned i = lane; i < left; i += 32) work.far(first + i);
      }

      bool maybe[kEach], any = false;
#pragma unroll
      for (unsigned k = 0; k < kEach; k++) {
        maybe[k] = word[k] >> place[k] % 32 & 1u;
        any |= maybe[k];
      }
      more = __any_sync(kAllLanes, any);
      if (more) {
#pragma unroll
        for (unsigned k = 0; k < kEach; k++) {
          const unsigned votes = __ballot_sync(kAllLanes, maybe[k]);
          if (maybe[k]) room.maybe_at[n_maybe + votes_below(votes)] = first + lane + 32 * k;
          n_maybe += __popc(votes);
        }
        // Near answers are written over far ones, too.
        __syncwarp();
      }
    }

    const unsigned full = last ? 1 : 32;
    while (more && (last ? n_maybe + (near_end - near_begin) > 0 : n_maybe >= full)) {
      // First those whose cells were asked for before.
      const unsigned n_near = near_end - near_begin;
      if (n_near >= full) {
        __pipeline_commit();
        __pipeline_wait_prior(0);
        __syncwarp();
        if (lane < n_near) {
          const unsigned mine = (near_begin + lane) % kNearWait;
          const Cell cell = room.near_cell[mine];
          const std::uint32_t at = room.near_at[mine];
          unsigned place = kMostLong;
          if (work.is_long(cell)) place = atomicAdd(&long_lists.n, 1u);
          if (place < kMostLong)
            long_lists.at[place] = at;
          else
            work.answer(at, room.near[mine], cell);
        }
        near_begin += min(n_near, 32u);
        __syncwarp();
      }

      // The last that came, so that those kept stay where they are.
      const unsigned n_look = min(n_maybe, 32u);
      n_maybe -= n_look;
      const S *sphere = nullptr;
      std::uint32_t at = 0, cell = kNoCell;
      if (lane < n_look) {
        const unsigned mine = n_maybe + lane;
        at = room.maybe_at[mine];
        sphere = mine < n_kept ? &room.kept[mine] : &room.tile[turn][at - first];
        cell = work.cell(*sphere);
      }
      const unsigned votes = __ballot_sync(kAllLanes, cell != kNoCell);
      if (cell != kNoCell) {
        const unsigned to = (near_end + votes_below(votes)) % kNearWait;
        __pipeline_memcpy_async(&room.near_cell[to], work.list(cell), sizeof(Cell));
        room.near[to] = *sphere;
        room.near_at[to] = at;
      }
      near_end += __popc(votes);
      __syncwarp();
    }
    if (last) break;

    if (more) {
      if (lane >= n_kept && lane < n_maybe)
        room.kept[lane] = room.tile[turn][room.maybe_at[lane] - first];
      n_kept = n_maybe;
    }
    __pipeline_commit();
    __syncwarp();
  }

  if constexpr (Work::kTogether) {
    __syncthreads();
    const unsigned n_long = min(long_lists.n, kMostLong);
    for (unsigned k = warp; k < n_long; k += blockDim.x / 32) {
      const std::uint32_t i = long_lists.at[k];
      const S s = work.sphere(i);
      work.answer_together(i, s, *work.list(work.cell(s)), WarpLanes());
    }
  }
}

class WarpQueues {
 public:
  // Needs no memory; asks what the device has.
  template <class S>
  void reserve(std::size_t)
  {
    if (processors_ > 0) return;
    int device = 0;
    cuda_check(cudaGetDevice(&device), "asking for the device");
    cuda_check(cudaDeviceGetAttribute(&shared_, cudaDevAttrMaxSharedMemoryPerBlockOptin, device),
               "asking for its shared memory");
    cuda_check(cudaDeviceGetAttribute(&processors_, cudaDevAttrMultiProcessorCount, device),
               "asking for its processors");
  }

  template <class Work>
  void run(CudaBackend &b, std::size_t n, const Work &work)
  {
    using S = typename Work::Item;
    const auto kernel = &answer_in_warps<Work>;
    const std::size_t room = shared_ - sizeof(LongLists);
    const unsigned warps =
        static_cast<unsigned>(std::min<std::size_t>(kMostWarps<S>, room / sizeof(WarpRoom<S>)));
    const std::size_t of_warps = warps * sizeof(WarpRoom<S>);
    const std::size_t words = n_brick_words(work.grid),
                      of_words = (words * sizeof(std::uint32_t) + 15) / 16 * 16;
    const bool fit = of_warps + of_words <= room;
    const std::size_t bytes = of_warps + (fit ? of_words : 0);
    if (allowed_ != reinterpret_cast<const void *>(kernel)) {
      cuda_check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize,
                                      static_cast<int>(room)),
                 "asking for shared memory");
      allowed_ = reinterpret_cast<const void *>(kernel);
    }
    for (std::size_t from = 0; from < n; from += kRun) {
      WarpTiles tiles;
      tiles.n_spheres = static_cast<unsigned>(std::min(n - from, kRun));
      tiles.n_tiles = (tiles.n_spheres + kTile<S> - 1) / kTile<S>;
      const unsigned blocks = std::min(tiles.n_tiles, static_cast<unsigned>(processors_));
      tiles.n_warps = blocks * warps;
      tiles.n_words = fit ? static_cast<unsigned>(words) : 0;
      kernel<<<blocks, 32 * warps, bytes, b.stream>>>(work.after(from), tiles);
      cuda_check(cudaGetLastError(), "starting a kernel");
    }
  }

 private:
  // Spheres of a kernel, so that their numbers and those of tiles have 32 bits; a multiple of 4.
  static constexpr std::size_t kRun = std::size_t(1) << 30;

  int processors_ = 0, shared_ = 0;    // bytes that a block can have
  const void *allowed_ = nullptr;      // the kernel that may have all of them
};

}    // namespace lsdcd
