#include "engine/backend_cpu.h"
#include "engine/engine_base.h"

namespace lsdcd {

namespace {

template <class Law>
class CpuEngine : public EngineBase<Law> {
  using Base = EngineBase<Law>;

 public:
  using Base::Base;

  std::string backend() const override { return backend_.name(); }
  void set_grid(const GridView &grid) override { grid_ = grid; }

  void start(const Spheres &spheres, const StepSettings &step, SpringStore *springs) override
  {
    this->begin(grid_, spheres, step, springs);
  }

  void collect() override
  {
    const std::size_t n = this->results_.near.size();
    result_.resize(n);
    if (Law::kHistory) spring_.resize(n * kPlaces);
    backend_.for_each(n, [this](std::size_t k) {
      result_[k] = wall_force<Law, kPlaces>(grid_, this->law_, this->force_settings_,
                                            this->state_of(this->results_.near[k]),
                                            spring_.data() + (Law::kHistory ? k * kPlaces : 0));
    });
    const int stride = this->redo_crowded(grid_, result_.data(), spring_, kPlaces);
    this->finish(result_.data(), spring_.data(), stride);
  }

  std::size_t bytes() const override
  {
    return this->shared_bytes() + result_.capacity() * sizeof(SphereResult) +
           spring_.capacity() * sizeof(Spring);
  }

 private:
  CpuBackend backend_;
  GridView grid_ = {};
  std::vector<SphereResult> result_;
  std::vector<Spring> spring_;
};

}    // namespace

std::unique_ptr<WallEngine> make_cpu_engine(const EngineSettings &settings)
{
  return with_law(settings, [&](const auto &law) -> std::unique_ptr<WallEngine> {
    return std::make_unique<CpuEngine<std::decay_t<decltype(law)>>>(settings, law);
  });
}

}    // namespace lsdcd
