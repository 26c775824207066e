#include "parallel/threads.h"
#include "engine/force/cuda_law.h"
#include "engine/engine_base.h"
#include "engine/narrow/found_contacts.h"
#include "parallel/pinned.h"

#include <cstring>

namespace lsdcd {

namespace {

// A near sphere as it travels to the GPU.
struct NearSphere {
  Vec3 x, v, omega;
  Real radius, mass;
  std::int32_t first_spring, n_springs;
};

class CudaEngine : public EngineBase {
 public:
  explicit CudaEngine(const EngineSettings &settings) :
      EngineBase(settings), cuda_law_(cuda_law(settings))
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
    begin(host_grid_, spheres, step, springs);
    const std::size_t n = results_.near.size();
    if (n == 0) return;
    sphere_.reserve(n);
    result_.reserve(n);
    gather(n);
    if (law_.traits.heat) gather_heat(n);
    sphere_.to_device(n, backend_.stream);
    found_.reserve(backend_, n);
    // Only spheres that touch write all of their result.
    cuda_check(cudaMemsetAsync(result_.device(), 0, n * sizeof(SphereResult), backend_.stream),
               "clearing memory");
    const LawJob job = device_job(n);
    find_first(backend_, job, n, settings_.law.pull_off());
    cuda_law_.start(cuda_law_.law, job, n, backend_);
    result_.to_host(n, backend_.stream);
    if (law_.traits.heat) heat_.to_host(n, backend_.stream);
    if (keeps_contacts()) pack_contacts(n);
  }

  void collect() override
  {
    const std::size_t n = results_.near.size(), n_extra = law_.traits.n_extra;
    backend_.wait();
    SphereResult *result = n > 0 ? result_.host() : nullptr;
    SphereSink sink = {nullptr, nullptr, heat_.host(), nullptr};
    if (keeps_contacts() && n > 0) {
      std::size_t n_contacts = 0;
      for (std::size_t k = 0; k < n; k++)
        n_contacts += result[k].n_contacts > 0 ? result[k].n_contacts : 0;
      if (n_contacts > 0) {
        if (law_.traits.history) packed_.to_host(n_contacts, backend_.stream);
        if (n_extra > 0) packed_extra_.to_host(n_contacts * n_extra, backend_.stream);
        if (law_.traits.records) packed_record_.to_host(n_contacts, backend_.stream);
        backend_.wait();
      }
      sink.springs = packed_.host();
      sink.extra = packed_extra_.host();
      sink.records = packed_record_.host();
    }
    int stride = kPacked;
    if (any_crowded(n)) {
      spread(sink, n);
      stride = redo_crowded(host_job(host_grid_, result, sink), crowded_, crowded_extra_,
                            crowded_record_);
      sink.springs = crowded_.data();
      sink.extra = crowded_extra_.data();
      sink.records = crowded_record_.data();
    }
    finish(result, sink, stride);
  }

  std::size_t bytes() const override
  {
    return shared_bytes() + block_.size() + sphere_.bytes() + result_.bytes() +
           old_spring_.bytes() + packed_.bytes() + new_spring_.size() * sizeof(Spring) +
           old_extra_.bytes() + packed_extra_.bytes() + new_extra_.size() * sizeof(Real) +
           packed_record_.bytes() + found_.bytes() + new_record_.size() * sizeof(ContactRecord) +
           temperature_.bytes() + heat_.bytes() + offset_.size() * sizeof(std::uint32_t) +
           scratch_.size();
  }

  // Most spheres have one contact or none of the kPlaces they have room for: only
  // what is there crosses to the host.
  void pack_contacts(std::size_t n)
  {
    const bool history = law_.traits.history, records = law_.traits.records;
    const int n_extra = law_.traits.n_extra;
    const SphereResult *result = result_.device();
    const Spring *from = new_spring_.data();
    const Real *from_extra = new_extra_.data();
    std::uint32_t *offset = offset_.data();
    const ContactRecord *from_record = new_record_.data();
    Spring *to = packed_.device();
    ContactRecord *to_record = packed_record_.device();
    Real *to_extra = packed_extra_.device();
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
      for (int i = 0; i < result[k].n_contacts; i++) {
        if (history) to[offset[k] + i] = from[k * kPlaces + i];
        if (records) to_record[offset[k] + i] = from_record[k * kPlaces + i];
      }
    });
    if (n_extra == 0) return;
    backend_.for_each(n, [=] __device__(std::size_t k) {
      for (int i = 0; i < result[k].n_contacts * n_extra; i++)
        to_extra[offset[k] * std::size_t(n_extra) + i] = from_extra[k * kPlaces * n_extra + i];
    });
  }

 private:
  LawJob device_job(std::size_t n)
  {
    constexpr std::ptrdiff_t reals = sizeof(NearSphere) / sizeof(Real),
                             ints = sizeof(NearSphere) / sizeof(std::int32_t);
    const NearSphere *s = sphere_.device();
    LawJob job;
    job.grid = device_grid_;
    job.settings = force_settings_;
    job.x = {&s->x.x, reals, 1};
    job.v = {&s->v.x, reals, 1};
    job.omega = {&s->omega.x, reals, 1};
    job.radius = {&s->radius, reals};
    job.mass = {&s->mass, reals};
    job.temperature = {temperature_.device()};
    job.springs = {
        {&s->first_spring, ints}, {&s->n_springs, ints}, old_spring_.device(), old_extra_.device()};
    return_results(job, result_.device());
    job.found = found_.next(n);
    job.found.just_now = true;
    job.sink = {new_spring_.data(), new_extra_.data(), heat_.device(), new_record_.data()};
    return job;
  }

  bool keeps_contacts() const { return law_.traits.history || law_.traits.records; }

  // Room for what the contacts of n spheres leave behind.
  void reserve_contacts(std::size_t n)
  {
    if (!keeps_contacts()) return;
    const std::size_t n_extra = law_.traits.n_extra;
    if (law_.traits.history) packed_.reserve(n * kPlaces);
    if (n_extra > 0) packed_extra_.reserve(n * kPlaces * n_extra);
    if (law_.traits.records) packed_record_.reserve(n * kPlaces);
    if (offset_.size() >= n) return;
    const std::size_t room = n + n / 2;
    offset_ = CudaBackend::Array<std::uint32_t>(room);
    if (law_.traits.history) new_spring_ = CudaBackend::Array<Spring>(room * kPlaces);
    new_extra_ = CudaBackend::Array<Real>(room * kPlaces * n_extra);
    if (law_.traits.records) new_record_ = CudaBackend::Array<ContactRecord>(room * kPlaces);
  }

  void gather(std::size_t n)
  {
    NearSphere *to = sphere_.host();
    const std::int64_t m = static_cast<std::int64_t>(n);
#pragma omp parallel for schedule(static) num_threads(threads()) if (m > 4096)
    for (std::int64_t k = 0; k < m; k++) {
      const int i = results_.near[k];
      to[k] = {spheres_.x[i],
               spheres_.v[i],
               spheres_.omega[i],
               spheres_.radius[i],
               spheres_.mass[i],
               0,
               law_.traits.history ? springs_->count(i) : 0};
    }
    reserve_contacts(n);
    if (!law_.traits.history) return;
    const std::size_t n_extra = law_.traits.n_extra;
    std::int32_t n_springs = 0;
    for (std::size_t k = 0; k < n; k++) {
      to[k].first_spring = n_springs;
      n_springs += to[k].n_springs;
    }
    old_spring_.reserve(n_springs > 0 ? n_springs : 1);
    if (n_extra > 0) old_extra_.reserve((n_springs > 0 ? n_springs : 1) * n_extra);
#pragma omp parallel for schedule(static) num_threads(threads()) if (m > 4096)
    for (std::int64_t k = 0; k < m; k++) {
      if (to[k].n_springs == 0) continue;
      const int i = results_.near[k];
      std::memcpy(old_spring_.host() + to[k].first_spring, springs_->of(i),
                  to[k].n_springs * sizeof(Spring));
      if (n_extra > 0)
        std::memcpy(old_extra_.host() + to[k].first_spring * n_extra, springs_->extra_of(i),
                    to[k].n_springs * n_extra * sizeof(Real));
    }
    if (n_springs == 0) return;
    old_spring_.to_device(n_springs, backend_.stream);
    if (n_extra > 0) old_extra_.to_device(n_springs * n_extra, backend_.stream);
  }

  void gather_heat(std::size_t n)
  {
    temperature_.reserve(n);
    heat_.reserve(n);
    for (std::size_t k = 0; k < n; k++)
      temperature_.host()[k] = spheres_.temperature[results_.near[k]];
    temperature_.to_device(n, backend_.stream);
  }

  // Back to kPlaces contacts each, as redo_crowded wants them.
  void spread(const SphereSink &packed, std::size_t n)
  {
    const std::size_t n_extra = law_.traits.n_extra;
    const bool history = law_.traits.history, records = law_.traits.records;
    crowded_.assign(history ? n * kPlaces : 0, Spring{});
    crowded_extra_.assign(n * kPlaces * n_extra, 0);
    crowded_record_.assign(records ? n * kPlaces : 0, ContactRecord{});
    if (!keeps_contacts()) return;
    std::size_t at = 0;
    for (std::size_t k = 0; k < n; k++)
      for (int i = 0; i < result_.host()[k].n_contacts; i++, at++) {
        if (history) crowded_[k * kPlaces + i] = packed.springs[at];
        if (records) crowded_record_[k * kPlaces + i] = packed.records[at];
        std::copy(packed.extra + at * n_extra, packed.extra + (at + 1) * n_extra,
                  crowded_extra_.begin() + (k * kPlaces + i) * n_extra);
      }
  }

  bool any_crowded(std::size_t n)
  {
    for (std::size_t k = 0; k < n; k++)
      if (result_.host()[k].n_contacts == kOverflow) return true;
    return false;
  }

  CudaLaw cuda_law_;
  CudaBackend backend_;
  int device_ = 0;
  GridView host_grid_ = {}, device_grid_ = {};
  CudaBackend::Array<char> block_;
  Mirrored<NearSphere> sphere_;
  Mirrored<SphereResult> result_;
  FoundContacts<CudaBackend> found_;
  Mirrored<Spring> old_spring_, packed_;
  CudaBackend::Array<Spring> new_spring_;
  // Of laws that keep more than a stretch, and of those with heat; empty otherwise.
  Mirrored<Real> old_extra_, packed_extra_, temperature_, heat_;
  CudaBackend::Array<Real> new_extra_;
  Mirrored<ContactRecord> packed_record_;
  CudaBackend::Array<ContactRecord> new_record_;
  CudaBackend::Array<std::uint32_t> offset_;
  CudaBackend::Array<char> scratch_;
  std::vector<Spring> crowded_;
  std::vector<Real> crowded_extra_;
  std::vector<ContactRecord> crowded_record_;
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
  return std::make_unique<CudaEngine>(settings);
}

}    // namespace lsdcd
