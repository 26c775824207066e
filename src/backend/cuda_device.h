// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The GPU that a process uses, and streams on it.
#pragma once

#include "backend/cuda_check.h"

#include <cuda_runtime.h>

namespace lsdcd {

inline int current_gpu()
{
  int device = 0;
  cuda_check(cudaGetDevice(&device), "asking for the device");
  return device;
}
inline void use_gpu(int device)
{
  cuda_check(cudaSetDevice(device), "choosing a GPU");
}

// Makes a GPU current while it lives.
class OnGpu {
 public:
  explicit OnGpu(int device) : before_(current_gpu())
  {
    if (before_ != device) use_gpu(device);
  }
  ~OnGpu() { cudaSetDevice(before_); }
  OnGpu(const OnGpu &) = delete;
  OnGpu &operator=(const OnGpu &) = delete;

 private:
  int before_;
};

// Until all that was started on a GPU has ended, also on streams that are destroyed by now. For destructors: an
// error is left to who asks next.
inline void wait_for_gpu(int device) noexcept
{
  int before = 0;
  if (cudaGetDevice(&before) != cudaSuccess) return;
  cudaSetDevice(device);
  cudaDeviceSynchronize();
  cudaSetDevice(before);
}

// A stream of its own on the GPU that this process shares with others of its node.
class CudaStream {
 public:
  // `rank`: of the process on its node.
  explicit CudaStream(int rank)
  {
    int n_devices = 0;
    cuda_check(cudaGetDeviceCount(&n_devices), "counting GPUs");
    device_ = rank % n_devices;
    use_gpu(device_);
    cuda_check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "creating a stream");
  }
  ~CudaStream()
  {
    cudaSetDevice(device_);
    cudaStreamSynchronize(stream_);
    cudaStreamDestroy(stream_);
  }
  CudaStream(const CudaStream &) = delete;
  CudaStream &operator=(const CudaStream &) = delete;

  cudaStream_t get() const { return stream_; }

 private:
  int device_ = 0;
  cudaStream_t stream_ = nullptr;
};

// Where an array lies.
struct ArrayMemory {
  bool is_managed, is_on_gpu;
  int device;
};
inline ArrayMemory memory_of_array(const void *array)
{
  cudaPointerAttributes about = {};
  cuda_check(cudaPointerGetAttributes(&about, array), "asking where an array is");
  return {about.type == cudaMemoryTypeManaged, about.type == cudaMemoryTypeDevice, about.device};
}

// Throws InputError where an array is neither in the memory of `device` nor managed. For the text: what takes the
// array, and what of it is on the device.
inline void check_array(const void *array, const std::string &name, int device,
                        const std::string &taker, const std::string &on_device)
{
  const ArrayMemory place = memory_of_array(array);
  if (place.is_managed) return;
  if (!place.is_on_gpu)
    throw InputError("the array `" + name + "` is in the host's memory; " + taker +
                     " takes arrays of the device");
  if (place.device != device)
    throw InputError("the array `" + name + "` is on device " + std::to_string(place.device) +
                     ", " + on_device + " on device " + std::to_string(device));
}

}    // namespace lsdcd
