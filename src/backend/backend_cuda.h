// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The backend of an NVIDIA GPU; backend.h says what its functions do.
#pragma once

#include "backend/backend.h"
#include "backend/block.h"
#include "backend/cuda_check.h"
#include "backend/cuda_limits.h"
#include "backend/cuda_side_stream.h"
#include "backend/owned_array.h"
#include "backend/warp.h"

#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_reduce.cuh>
#include <cub/device/device_scan.cuh>
#include <cub/device/device_select.cuh>
#include <cuda_runtime.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/iterator/transform_iterator.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace lsdcd {

template <class F>
__global__ void cuda_for_each(std::size_t n, const __grid_constant__ F f)
{
  const std::size_t i = std::size_t(blockIdx.x) * blockDim.x + threadIdx.x;
  if (i < n) f(i);
}

// Blocks of cuda_for_each_in_warps() at once on a processor, at least. Its threads wait for memory: 80 registers for each leave room for
// more of them. A kernel that computes much says how many in kBlocksAtOnce.
template <class F, class = void>
constexpr unsigned kInWarpsBlocks = 6;
template <class F>
constexpr unsigned kInWarpsBlocks<F, std::void_t<decltype(F::kBlocksAtOnce)>> = F::kBlocksAtOnce;

// Calls f(i) as cuda_for_each() does, by all threads of a warp together.
template <class F>
__global__ void __launch_bounds__(kInWarpsBlock, kInWarpsBlocks<F>)
    cuda_for_each_in_warps(std::size_t most, const std::uint32_t *n_at, const __grid_constant__ F f)
{
  const std::size_t n = n_at ? *n_at : most,
                    i = std::size_t(blockIdx.x) * kInWarpsBlock + threadIdx.x;
  if (n <= most && i / kWarpSize * kWarpSize < n) f(Warp<kWarpSize>(), i < n, i < n ? i : 0);
}

// Whole blocks; see block.h.
template <class F>
__global__ void __launch_bounds__(F::kThreads, F::kBlocksAtOnce)
    cuda_for_each_block(const __grid_constant__ F f)
{
  f(Block());
}

// Pairs of a key and a value, before a sort and after it, in memory that is used again: sort_in() sorts the first n of
// keys[0] and values[0].
template <class B>
struct SortMemory {
  template <class T>
  using Array = typename B::template Array<T>;

  Array<std::uint32_t> keys[2], values[2];

  void reserve(std::size_t n)
  {
    if (keys[0].size() >= n) return;
    for (int k = 0; k < 2; k++) {
      keys[k] = Array<std::uint32_t>(n);
      values[k] = Array<std::uint32_t>(n);
    }
  }
  std::size_t bytes() const { return 4 * keys[0].size() * sizeof(std::uint32_t); }
};
struct SortedPairs {
  const std::uint32_t *keys, *values;
};

struct CudaBackend {
  static constexpr bool kOnCpu = false;    // is its memory the CPU's?

  cudaStream_t stream = nullptr;

  CudaBackend() = default;
  explicit CudaBackend(void *cuda_stream) : stream(static_cast<cudaStream_t>(cuda_stream)) {}

  struct Memory {
    static void *allocate(std::size_t bytes)
    {
      void *at = nullptr;
      cuda_check(cudaMalloc(&at, bytes), "allocating device memory");
      return at;
    }
    static void free(void *at) { cudaFree(at); }
  };
  template <class T>
  using Array = OwnedArray<T, Memory>;

  // Page-locked memory of the CPU: what copies beside kernels.
  struct HostMemory {
    static void *allocate(std::size_t bytes)
    {
      void *at = nullptr;
      cuda_check(cudaMallocHost(&at, bytes), "allocating page-locked memory");
      return at;
    }
    static void free(void *at) { cudaFreeHost(at); }
  };
  template <class T>
  using CpuArray = OwnedArray<T, HostMemory>;

  // For a while, and for the default stream only: freed memory stays with the process until give_back(),
  // so that the next one is quick to get.
  struct PooledMemory {
    static void *allocate(std::size_t bytes)
    {
      if (!pooled()) return Memory::allocate(bytes);
      void *at = nullptr;
      cuda_check(cudaMallocAsync(&at, bytes, nullptr), "allocating device memory");
      return at;
    }
    static void free(void *at)
    {
      if (!pooled())
        Memory::free(at);
      else
        cudaFreeAsync(at, nullptr);
    }
    // Gives what is free back to the device, after work that took much.
    static void give_back()
    {
      int device = 0;
      cudaMemPool_t pool;
      if (!pooled() || cudaStreamSynchronize(nullptr) != cudaSuccess ||
          cudaGetDevice(&device) != cudaSuccess ||
          cudaDeviceGetDefaultMemPool(&pool, device) != cudaSuccess)
        return;
      cudaMemPoolTrimTo(pool, 0);
    }

   private:
    static bool pooled()
    {
      static const bool yes = [] {
        int device = 0, supported = 0;
        cudaMemPool_t pool;
        std::uint64_t keep = ~std::uint64_t(0);
        return cudaGetDevice(&device) == cudaSuccess &&
               cudaDeviceGetAttribute(&supported, cudaDevAttrMemoryPoolsSupported, device) ==
                   cudaSuccess &&
               supported && cudaDeviceGetDefaultMemPool(&pool, device) == cudaSuccess &&
               cudaMemPoolSetAttribute(pool, cudaMemPoolAttrReleaseThreshold, &keep) == cudaSuccess;
      }();
      return yes;
    }
  };
  template <class T>
  using Scratch = OwnedArray<T, PooledMemory>;

  template <class T>
  void copy_in(const T *host, T *to, std::size_t n)
  {
    if (n > 0)
      cuda_check(cudaMemcpyAsync(to, host, n * sizeof(T), cudaMemcpyHostToDevice, stream),
                 "copying to the device");
  }
  template <class T>
  void copy_out(const T *from, T *host, std::size_t n)
  {
    if (n > 0)
      cuda_check(cudaMemcpyAsync(host, from, n * sizeof(T), cudaMemcpyDeviceToHost, stream),
                 "copying from the device");
  }
  void wait() { cuda_check(cudaStreamSynchronize(stream), "running on the device"); }

  class Event {
   public:
    void record(CudaBackend &b) { event_.record(b.stream); }
    void wait() const { event_.wait(); }

   private:
    CudaEvent event_;
  };
  class SideStream {
   public:
    void ready(CudaBackend &b) { streams_.ready(b.stream); }
    void begin(CudaBackend &b)
    {
      streams_.begin(b.stream);
      std::swap(b.scratch_, scratch_);
    }
    void end(CudaBackend &b)
    {
      streams_.end(b.stream);
      std::swap(b.scratch_, scratch_);
    }
    std::size_t scratch_bytes() const { return scratch_.size(); }

   private:
    CudaSideStream streams_;
    Array<char> scratch_;    // of the stream that is not the backend's now
  };

  using Limits = CudaLimits;
  // f(block) by each thread of each block, as block.h says.
  template <class F>
  void for_each_block(const LaunchShape &shape, const F &f)
  {
    const auto kernel = cuda_for_each_block<F>;
    LaunchShape can = shape;
    if (shape.begins_early) {
      static const bool early = can_begin_early(kernel);
      can.begins_early = early;
    }
    launch(kernel, can, f);
  }

  template <class F>
  void for_each(std::size_t n, const F &f, unsigned block = 256)
  {
    if (n == 0) return;
    launch(cuda_for_each<F>, LaunchShape{static_cast<unsigned>((n + block - 1) / block), block}, n,
           f);
  }

  // A thread that is there only to help has an i that is not `mine`. With `n_at`: for *n_at in place of n, or
  // none if that is more.
  template <class F>
  void for_each_in_warps(std::size_t n, const F &f, const std::uint32_t *n_at = nullptr)
  {
    if (n == 0) return;
    const std::size_t blocks = (n + kInWarpsBlock - 1) / kInWarpsBlock;
    launch(cuda_for_each_in_warps<F>, LaunchShape{static_cast<unsigned>(blocks), kInWarpsBlock}, n,
           n_at, f);
  }

  // Milliseconds of the kernels that f() starts.
  template <class F>
  double milliseconds(const F &f)
  {
    cudaEvent_t from = nullptr, to = nullptr;
    cuda_check(cudaEventCreate(&from), "creating an event");
    cuda_check(cudaEventCreate(&to), "creating an event");
    cuda_check(cudaEventRecord(from, stream), "recording an event");
    f();
    cuda_check(cudaEventRecord(to, stream), "recording an event");
    cuda_check(cudaEventSynchronize(to), "running on the device");
    float ms = 0;
    cuda_check(cudaEventElapsedTime(&ms, from, to), "reading events");
    cudaEventDestroy(from);
    cudaEventDestroy(to);
    return ms;
  }

  // Of the stream that is the backend's now.
  std::size_t scratch_bytes() const { return scratch_.size(); }

  // Copies those of from[0, n), or of the numbers [0, n) where it is null, whose flag is set to `to`; *total, on the
  // device, becomes how many they are. Does not wait.
  template <class = void>
  void compact(std::size_t n, const int *from, const char *flags, int *to, std::uint32_t *total)
  {
    const auto select = [&](auto source) {
      with_scratch(0, [&](char *, void *more, std::size_t &bytes) {
        return cub::DeviceSelect::Flagged(more, bytes, source, flags, to, total,
                                          static_cast<int>(n), stream);
      });
    };
    if (n == 0)
      cuda_check(cudaMemsetAsync(total, 0, sizeof *total, stream), "clearing a count");
    else if (from)
      select(from);
    else
      select(thrust::counting_iterator<int>(0));
  }

  template <class T, class Read>
  T largest(std::size_t n, const Read &read)
  {
    if (n == 0) return T(0);
    using Places = thrust::counting_iterator<std::size_t>;
    const thrust::transform_iterator<Read, Places, T, T> values(Places(0), read);
    T *out = nullptr;
    with_scratch(sizeof(T), [&](char *at, void *more, std::size_t &bytes) {
      out = reinterpret_cast<T *>(at);
      return cub::DeviceReduce::Max(more, bytes, values, out, n, stream);
    });
    return read_one(*this, out);
  }
  // The last number before the scan and after it come in one wait.
  template <class T>
  T exclusive_scan(T *values, std::size_t n)
  {
    if (n == 0) return T(0);
    T *last = nullptr, both[2];
    with_scratch(sizeof both, [&](char *at, void *more, std::size_t &bytes) {
      last = reinterpret_cast<T *>(at);
      if (last) copy_over(values + n - 1, last, 1);
      return cub::DeviceScan::ExclusiveSum(more, bytes, values, values, n, stream);
    });
    copy_over(values + n - 1, last + 1, 1);
    copy_out(last, both, 2);
    wait();
    return both[0] + both[1];
  }

  // Sorts pairs by the lowest bits of their keys, as sort_pairs() does. Does not wait.
  template <class Memory>
  SortedPairs sort_in(std::size_t n, int bits, Memory &memory)
  {
    cub::DoubleBuffer<std::uint32_t> keys(memory.keys[0].data(), memory.keys[1].data()),
        values(memory.values[0].data(), memory.values[1].data());
    with_scratch(0, [&](char *, void *more, std::size_t &bytes) {
      return cub::DeviceRadixSort::SortPairs(more, bytes, keys, values, n, 0, bits, stream);
    });
    return {keys.Current(), values.Current()};
  }

  // A template, so that only who sorts compiles it. CUB asks twice: for the size of its scratch memory, then to run.
  template <class = void>
  void sort_pairs(Scratch<std::uint32_t> &keys, Scratch<std::uint32_t> &values,
                  std::uint32_t largest)
  {
    const std::size_t n = keys.size();
    if (n == 0) return;
    Scratch<std::uint32_t> sorted_keys(n), sorted_values(n);
    std::size_t bytes = 0;
    const auto sort = [&](void *at) {
      cuda_check(cub::DeviceRadixSort::SortPairs(at, bytes, keys.data(), sorted_keys.data(),
                                                 values.data(), sorted_values.data(), n, 0,
                                                 bits_of(largest), stream),
                 "sorting");
    };
    sort(nullptr);
    // Scratch memory comes and goes in the order of the default stream: another one is made to wait for it, and is
    // waited for.
    Scratch<char> room(bytes);
    if (stream) cuda_check(cudaStreamSynchronize(nullptr), "allocating device memory");
    sort(room.data());
    if (stream) wait();
    std::swap(keys, sorted_keys);
    std::swap(values, sorted_values);
  }

  std::string name() const
  {
    int device = 0;
    cudaDeviceProp prop;
    if (cudaGetDevice(&device) != cudaSuccess ||
        cudaGetDeviceProperties(&prop, device) != cudaSuccess)
      return "CUDA";
    return std::string("CUDA, ") + prop.name;
  }

 private:
  template <class... Parameters, class... Arguments>
  void launch(void (*kernel)(Parameters...), const LaunchShape &shape,
              const Arguments &...arguments)
  {
    cudaLaunchAttribute early = {};
    early.id = cudaLaunchAttributeProgrammaticStreamSerialization;
    early.val.programmaticStreamSerializationAllowed = 1;
    cudaLaunchConfig_t config = {};
    config.gridDim = dim3(shape.blocks);
    config.blockDim = dim3(shape.threads);
    config.stream = stream;
    config.attrs = &early;
    config.numAttrs = shape.begins_early ? 1 : 0;
    cuda_check(cudaLaunchKernelEx(&config, kernel, arguments...), "starting a kernel");
  }
  // Was the code of this kernel that runs here compiled for a GPU that can?
  template <class Kernel>
  static bool can_begin_early(Kernel *kernel)
  {
    cudaFuncAttributes attributes;
    return cudaFuncGetAttributes(&attributes, kernel) == cudaSuccess && attributes.ptxVersion >= 90;
  }

  template <class T>
  void copy_over(const T *from, T *to, std::size_t n)
  {
    cuda_check(cudaMemcpyAsync(to, from, n * sizeof(T), cudaMemcpyDeviceToDevice, stream),
               "copying on the device");
  }

  // CUB asks twice: for the size of its scratch memory, then to run. That memory is kept for the next call, as the pool of
  // Scratch takes 32 MiB of the device for any number of bytes; work of one stream uses it in turn. It begins with
  // `first` bytes for a result: call(at, more, bytes).
  template <class Call>
  void with_scratch(std::size_t first, Call call)
  {
    constexpr std::size_t kAlign = 256;    // as of an allocation
    first = (first + kAlign - 1) / kAlign * kAlign;
    std::size_t bytes = 0;
    cuda_check(call(nullptr, nullptr, bytes), "sizing scratch memory");
    if (scratch_.size() < first + bytes) {
      scratch_ = Array<char>();
      scratch_ = Array<char>(2 * (first + bytes));
    }
    cuda_check(call(scratch_.data(), scratch_.data() + first, bytes),
               "scan, select, sort or reduce");
  }

  Array<char> scratch_;
};

}    // namespace lsdcd
