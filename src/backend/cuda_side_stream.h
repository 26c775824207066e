// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A second stream of an NVIDIA GPU, for work beside what the first one does.
#pragma once

#include "backend/cuda_event.h"

#include <utility>

namespace lsdcd {

class CudaSideStream {
 public:
  CudaSideStream() = default;
  ~CudaSideStream()
  {
    if (!second_) return;
    cudaStreamSynchronize(second_);
    cudaStreamDestroy(second_);
  }
  CudaSideStream(const CudaSideStream &) = delete;
  CudaSideStream &operator=(const CudaSideStream &) = delete;

  // The next work beside the first stream waits for all that this stream has got so far.
  void ready(cudaStream_t first)
  {
    if (!second_) make();
    ready_.record(first);
  }

  // `stream` becomes the second one.
  void begin(cudaStream_t &stream)
  {
    first_ = std::exchange(stream, second_);
    ready_.hold(second_);
  }

  // `stream` becomes the first one again, which waits for the work of the second.
  void end(cudaStream_t &stream)
  {
    done_.record(second_);
    stream = first_;
    done_.hold(first_);
  }

 private:
  // Its kernels go first: they are short, and the first stream's have work for all of the GPU.
  void make()
  {
    int lowest = 0, highest = 0;
    cuda_check(cudaDeviceGetStreamPriorityRange(&lowest, &highest), "asking for priorities");
    cuda_check(cudaStreamCreateWithPriority(&second_, cudaStreamNonBlocking, highest),
               "creating a stream");
  }

  cudaStream_t first_ = nullptr, second_ = nullptr;
  CudaEvent ready_, done_;
};

}    // namespace lsdcd
