#include "parallel/backend_cpu.h"
#include "engine/engine_base.h"

namespace lsdcd {

namespace {

class CpuEngine : public EngineBase {
 public:
  using EngineBase::EngineBase;

  std::string backend() const override { return CpuBackend().name(); }
  void set_grid(const GridView &grid) override { grid_ = grid; }

  void start(const Spheres &spheres, const StepSettings &step, SpringStore *springs) override
  {
    begin(grid_, spheres, step, springs);
  }

  void collect() override
  {
    const std::size_t n = results_.near.size();
    result_.resize(n);
    if (law_.traits.history) spring_.resize(n * kPlaces);
    extra_.resize(n * kPlaces * law_.traits.n_extra);
    if (law_.traits.heat) heat_.resize(n);
    if (law_.traits.records) record_.resize(n * kPlaces);
    const LawJob job = host_job(grid_, result_.data(), sink());
    CpuBackend backend;
    law_.start(law_.law, job, n, backend);
    const int stride = redo_crowded(job, spring_, extra_, record_);
    finish(result_.data(), sink(), stride);
  }

  std::size_t bytes() const override
  {
    return shared_bytes() + result_.capacity() * sizeof(SphereResult) +
           spring_.capacity() * sizeof(Spring) +
           (extra_.capacity() + heat_.capacity()) * sizeof(Real) +
           record_.capacity() * sizeof(ContactRecord);
  }

 private:
  SphereSink sink() { return {spring_.data(), extra_.data(), heat_.data(), record_.data()}; }

  GridView grid_ = {};
  std::vector<SphereResult> result_;
  std::vector<Spring> spring_;
  std::vector<Real> extra_, heat_;
  std::vector<ContactRecord> record_;
};

}    // namespace

std::unique_ptr<WallEngine> make_cpu_engine(const EngineSettings &settings)
{
  return std::make_unique<CpuEngine>(settings);
}

}    // namespace lsdcd
