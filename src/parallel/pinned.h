// Page-locked host memory that grows: what copies to and from a GPU overlap with.
#pragma once

#include "parallel/backend_cuda.h"

#include <cstddef>

namespace lsdcd {

// A pair of buffers, one on the host, one on the device, of the same size.
template <class T>
class Mirrored {
 public:
  Mirrored() = default;
  ~Mirrored()
  {
    cudaFreeHost(host_);
    cudaFree(device_);
  }
  Mirrored(const Mirrored &) = delete;
  Mirrored &operator=(const Mirrored &) = delete;

  // Room for n; contents are lost when it grows.
  void reserve(std::size_t n)
  {
    if (n <= room_) return;
    cudaFreeHost(host_);
    cudaFree(device_);
    host_ = device_ = nullptr;
    room_ = n + n / 2;
    cuda_check(cudaMallocHost(&host_, room_ * sizeof(T)), "allocating page-locked memory");
    cuda_check(cudaMalloc(&device_, room_ * sizeof(T)), "allocating device memory");
  }
  T *host() { return host_; }
  T *device() { return device_; }
  std::size_t room() const { return room_; }
  std::size_t bytes() const { return room_ * sizeof(T); }    // on each side

  void to_device(std::size_t n, cudaStream_t stream)
  {
    cuda_check(cudaMemcpyAsync(device_, host_, n * sizeof(T), cudaMemcpyHostToDevice, stream),
               "copying to the device");
  }
  void to_host(std::size_t n, cudaStream_t stream)
  {
    cuda_check(cudaMemcpyAsync(host_, device_, n * sizeof(T), cudaMemcpyDeviceToHost, stream),
               "copying from the device");
  }

 private:
  T *host_ = nullptr, *device_ = nullptr;
  std::size_t room_ = 0;
};

}    // namespace lsdcd
