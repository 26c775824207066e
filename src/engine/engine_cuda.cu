#include "base/threads.h"
#include "engine/backend_cuda.h"
#include "engine/engine_base.h"
#include "engine/pinned.h"

#include <cstring>

namespace lsdcd {

namespace {

// A near sphere as it travels to the GPU.
struct NearSphere {
  Vec3 x, v, omega;
  Real radius, mass;
  std::int32_t first_spring, n_springs;
};

template <class Law>
class CudaEngine : public EngineBase<Law> {
  using Base = EngineBase<Law>;

 public:
  CudaEngine(const EngineSettings &settings, const Law &law) : Base(settings, law)
  {
    int n_devices = 0;
    cuda_check(cudaGetDeviceCount(&n_devices), "counting GPUs");
    device_ = settings.device_rank % n_devices;
    cuda_check(cudaSetDevice(device_), "choosing a GPU");
    cuda_check(cudaStreamCreateWithFlags(&backend_.stream, cudaStreamNonBlocking),
               "creating a stream");
  }
  ~CudaEngine() override
  {
    cudaSetDevice(device_);
    cudaStreamSynchronize(backend_.stream);
    cudaStreamDestroy(backend_.stream);
  }

  std::string backend() const override { return backend_.name(); }

  void set_grid(const GridView &grid) override
  {
    if (!grid.block) throw std::logic_error("a CUDA engine needs the view of a flat grid block");
    cuda_check(cudaSetDevice(device_), "choosing a GPU");
    host_grid_ = grid;
    block_ = CudaBackend::Array<char>(grid.block_bytes);
    // On the kernels' stream and waited for: a plain copy from pageable memory may
    // still be under way when it returns, and this stream waits for no other.
    cuda_check(cudaMemcpyAsync(block_.data(), grid.block, grid.block_bytes, cudaMemcpyHostToDevice,
                               backend_.stream),
               "copying the grid to the device");
    backend_.wait();
    device_grid_ = moved_view(grid, block_.data());
  }

  void start(const Spheres &spheres, const StepSettings &step, SpringStore *springs) override
  {
    cuda_check(cudaSetDevice(device_), "choosing a GPU");
    this->begin(host_grid_, spheres, step, springs);
    const std::size_t n = this->results_.near.size();
    if (n == 0) return;
    sphere_.reserve(n);
    result_.reserve(n);
    gather(n);
    sphere_.to_device(n, backend_.stream);

    const GridView grid = device_grid_;
    const Law law = this->law_;
    const ForceSettings settings = this->force_settings_;
    const NearSphere *in = sphere_.device();
    SphereResult *out = result_.device();
    const Spring *old = Law::kHistory ? old_spring_.device() : nullptr;
    Spring *springs_out = Law::kHistory ? new_spring_.data() : nullptr;
    backend_.for_each(
        n,
        [=] __device__(std::size_t k) {
          const NearSphere &s = in[k];
          const SphereState state = {
              s.x, s.v, s.omega, s.radius, s.mass, old + s.first_spring, s.n_springs};
          out[k] = wall_force<Law, kPlaces>(grid, law, settings, state,
                                            Law::kHistory ? springs_out + k * kPlaces : nullptr);
        },
        128);
    result_.to_host(n, backend_.stream);
    if (Law::kHistory) pack_springs(n);
  }

  void collect() override
  {
    const std::size_t n = this->results_.near.size();
    backend_.wait();
    SphereResult *result = n > 0 ? result_.host() : nullptr;
    const Spring *springs = nullptr;
    if (Law::kHistory && n > 0) {
      std::size_t n_springs = 0;
      for (std::size_t k = 0; k < n; k++)
        n_springs += result[k].n_contacts > 0 ? result[k].n_contacts : 0;
      if (n_springs > 0) {
        packed_.to_host(n_springs, backend_.stream);
        backend_.wait();
      }
      springs = packed_.host();
    }
    int stride = kPacked;
    if (any_crowded(n)) {
      spread(springs, n);
      stride = this->redo_crowded(host_grid_, result, crowded_, kPlaces);
      springs = crowded_.data();
    }
    this->finish(result, springs, stride);
  }

  std::size_t bytes() const override
  {
    return this->shared_bytes() + block_.size() + sphere_.bytes() + result_.bytes() +
           old_spring_.bytes() + packed_.bytes() + new_spring_.size() * sizeof(Spring) +
           offset_.size() * sizeof(std::uint32_t) + scratch_.size();
  }

  // Most spheres have one spring or none of the kPlaces they have room for: only
  // what is there crosses to the host.
  void pack_springs(std::size_t n)
  {
    const SphereResult *result = result_.device();
    const Spring *from = new_spring_.data();
    std::uint32_t *offset = offset_.data();
    Spring *to = packed_.device();
    backend_.for_each(n, [=] __device__(std::size_t k) {
      offset[k] = result[k].n_contacts > 0 ? result[k].n_contacts : 0;
    });
    std::size_t bytes = 0;
    cuda_check(cub::DeviceScan::ExclusiveSum(nullptr, bytes, offset, offset, n, backend_.stream),
               "sizing a scan");
    if (scratch_.size() < bytes) scratch_ = CudaBackend::Array<char>(2 * bytes);
    bytes = scratch_.size();
    cuda_check(
        cub::DeviceScan::ExclusiveSum(scratch_.data(), bytes, offset, offset, n, backend_.stream),
        "scanning");
    backend_.for_each(n, [=] __device__(std::size_t k) {
      for (int i = 0; i < result[k].n_contacts; i++) to[offset[k] + i] = from[k * kPlaces + i];
    });
  }

 private:
  void gather(std::size_t n)
  {
    NearSphere *to = sphere_.host();
    const std::int64_t m = static_cast<std::int64_t>(n);
#pragma omp parallel for schedule(static) num_threads(threads()) if (m > 4096)
    for (std::int64_t k = 0; k < m; k++) {
      const SphereState s = this->state_of(this->results_.near[k]);
      to[k] = {s.x, s.v, s.omega, s.radius, s.mass, 0, s.n_springs};
    }
    if constexpr (Law::kHistory) {
      std::int32_t n_springs = 0;
      for (std::size_t k = 0; k < n; k++) {
        to[k].first_spring = n_springs;
        n_springs += to[k].n_springs;
      }
      old_spring_.reserve(n_springs > 0 ? n_springs : 1);
      packed_.reserve(n * kPlaces);
      if (new_spring_.size() < n * kPlaces) {
        new_spring_ = CudaBackend::Array<Spring>(packed_.room());
        offset_ = CudaBackend::Array<std::uint32_t>(packed_.room() / kPlaces);
      }
#pragma omp parallel for schedule(static) num_threads(threads()) if (m > 4096)
      for (std::int64_t k = 0; k < m; k++)
        if (to[k].n_springs > 0)
          std::memcpy(old_spring_.host() + to[k].first_spring,
                      this->springs_->of(this->results_.near[k]), to[k].n_springs * sizeof(Spring));
      if (n_springs > 0) old_spring_.to_device(n_springs, backend_.stream);
    }
  }

  // Back to kPlaces springs each, as redo_crowded wants them.
  void spread(const Spring *springs, std::size_t n)
  {
    crowded_.assign(Law::kHistory ? n * kPlaces : 0, Spring{});
    if constexpr (Law::kHistory)
      for (std::size_t k = 0; k < n; k++)
        for (int i = 0; i < result_.host()[k].n_contacts; i++)
          crowded_[k * kPlaces + i] = *springs++;
  }

  bool any_crowded(std::size_t n)
  {
    for (std::size_t k = 0; k < n; k++)
      if (result_.host()[k].n_contacts == kOverflow) return true;
    return false;
  }

  CudaBackend backend_;
  int device_ = 0;
  GridView host_grid_ = {}, device_grid_ = {};
  CudaBackend::Array<char> block_;
  Mirrored<NearSphere> sphere_;
  Mirrored<SphereResult> result_;
  Mirrored<Spring> old_spring_, packed_;
  CudaBackend::Array<Spring> new_spring_;
  CudaBackend::Array<std::uint32_t> offset_;
  CudaBackend::Array<char> scratch_;
  std::vector<Spring> crowded_;
};

}    // namespace

bool cuda_available(std::string *why)
{
  int n = 0;
  const cudaError_t status = cudaGetDeviceCount(&n);
  if (status == cudaSuccess && n > 0) return true;
  if (why)
    *why = status == cudaSuccess ? "no GPU found"
                                 : std::string("no usable GPU: ") + cudaGetErrorString(status);
  cudaGetLastError();    // or the next call would report it again
  return false;
}

std::unique_ptr<WallEngine> make_cuda_engine(const EngineSettings &settings)
{
  return with_law(settings, [&](const auto &law) -> std::unique_ptr<WallEngine> {
    return std::make_unique<CudaEngine<std::decay_t<decltype(law)>>>(settings, law);
  });
}

}    // namespace lsdcd
