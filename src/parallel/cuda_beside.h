// A second stream of an NVIDIA GPU, for work beside what the first one does.
#pragma once

#include "parallel/cuda_check.h"

#include <cuda_runtime.h>

#include <utility>

namespace lsdcd {

class CudaBeside {
 public:
  CudaBeside() = default;
  ~CudaBeside()
  {
    if (!second_) return;
    cudaStreamSynchronize(second_);
    cudaEventDestroy(ready_);
    cudaEventDestroy(done_);
    cudaStreamDestroy(second_);
  }
  CudaBeside(const CudaBeside &) = delete;
  CudaBeside &operator=(const CudaBeside &) = delete;

  // What the first stream has been given so far is what the next work beside it waits for.
  void ready(cudaStream_t first)
  {
    if (!second_) make();
    cuda_check(cudaEventRecord(ready_, first), "recording an event");
  }

  // `stream` becomes the second one.
  void begin(cudaStream_t &stream)
  {
    first_ = std::exchange(stream, second_);
    cuda_check(cudaStreamWaitEvent(second_, ready_, 0), "ordering two streams");
  }

  // `stream` becomes the first one again, which waits for what the second was given.
  void end(cudaStream_t &stream)
  {
    cuda_check(cudaEventRecord(done_, second_), "recording an event");
    stream = first_;
    cuda_check(cudaStreamWaitEvent(first_, done_, 0), "ordering two streams");
  }

 private:
  // Its kernels go first: they are short, and the first stream's have work for all of the GPU.
  void make()
  {
    int lowest = 0, highest = 0;
    cuda_check(cudaDeviceGetStreamPriorityRange(&lowest, &highest), "asking for priorities");
    cuda_check(cudaStreamCreateWithPriority(&second_, cudaStreamNonBlocking, highest),
               "creating a stream");
    cuda_check(cudaEventCreateWithFlags(&ready_, cudaEventDisableTiming), "creating an event");
    cuda_check(cudaEventCreateWithFlags(&done_, cudaEventDisableTiming), "creating an event");
  }

  cudaStream_t first_ = nullptr, second_ = nullptr;
  cudaEvent_t ready_ = nullptr, done_ = nullptr;
};

}    // namespace lsdcd
