#include "engine/choose/selection_cuda.h"
#include "engine/host_adapter.h"
#include "engine/step/compile_law.h"

namespace lsdcd {

namespace {

// A stream of its own on the GPU that this process shares with others of its node.
class Stream {
 public:
  explicit Stream(int rank)
  {
    int n_devices = 0;
    cuda_check(cudaGetDeviceCount(&n_devices), "counting GPUs");
    device_ = rank % n_devices;
    cuda_check(cudaSetDevice(device_), "choosing a GPU");
    cuda_check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "creating a stream");
  }
  ~Stream()
  {
    cudaSetDevice(device_);
    cudaStreamSynchronize(stream_);
    cudaStreamDestroy(stream_);
  }
  Stream(const Stream &) = delete;
  Stream &operator=(const Stream &) = delete;

  cudaStream_t get() const { return stream_; }

 private:
  int device_ = 0;
  cudaStream_t stream_ = nullptr;
};

CudaBackend on(cudaStream_t stream)
{
  CudaBackend backend;
  backend.stream = stream;
  return backend;
}

// The stream outlives what runs in it.
class CudaEngine : private Stream, public HostAdapter<CudaBackend> {
 public:
  explicit CudaEngine(const EngineSettings &settings) :
      Stream(settings.device_rank), HostAdapter(settings, law_for<CudaBackend>(settings), on(get()))
  {
  }
};

}    // namespace

std::unique_ptr<WallEngine> make_cuda_engine(const EngineSettings &settings)
{
  return std::make_unique<CudaEngine>(settings);
}

std::unique_ptr<InPlaceEngine> make_cuda_engine_in_place(const EngineSettings &settings, int device,
                                                         void *stream)
{
  // The host code has chosen its device with a CUDA runtime of its own.
  cuda_check(cudaSetDevice(device), "choosing the GPU of the particles");
  return std::make_unique<EngineOn<CudaBackend>>(settings, law_for<CudaBackend>(settings),
                                                 on(static_cast<cudaStream_t>(stream)));
}

}    // namespace lsdcd
