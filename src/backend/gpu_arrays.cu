// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/gpu_arrays.h"

#include "backend/cuda_device.h"

namespace lsdcd {

namespace {

class CudaArrays : public GpuArrays {
 public:
  explicit CudaArrays(void *stream) :
      device_(current_gpu()), stream_(static_cast<cudaStream_t>(stream))
  {
  }

  int device() const override { return device_; }
  void run(const std::function<void()> &work) const override
  {
    const OnGpu on(device_);
    work();
  }
  void check(const void *array, const char *name, const char *user) const override
  {
    check_array(array, name, device_, user, user);
  }
  void copy_out(const void *from, void *to, std::size_t bytes) const override
  {
    cuda_check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDefault, stream_),
               "copying from the device");
    wait();
  }
  void copy_in(const void *from, void *to, std::size_t bytes) const override
  {
    cuda_check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDefault, stream_),
               "copying to the device");
    wait();
  }
  void wait() const override
  {
    cuda_check(cudaStreamSynchronize(stream_), "running on the device");
  }

 private:
  int device_;
  cudaStream_t stream_;
};

}    // namespace

std::unique_ptr<GpuArrays> make_gpu_arrays(void *stream)
{
  return std::make_unique<CudaArrays>(stream);
}

}    // namespace lsdcd
