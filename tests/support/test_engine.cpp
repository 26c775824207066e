#include "support/test_engine.h"

#include "support/device.h"
#include "support/device_memory.h"

namespace lsdcd {

namespace {

// Brings the host's spheres and springs to where a resident engine computes, and back, in
// every step. Vectors lie there as x x x y y y z z z in one step and as x y z x y z in the next.
class ResidentForHost : public WallEngine {
 public:
  ResidentForHost(std::unique_ptr<ResidentEngine> engine, bool has_history, bool cuda) :
      engine_(std::move(engine)), has_history_(has_history), x_(cuda), v_(cuda), omega_(cuda),
      force_(cuda), torque_(cuda), radius_(cuda), mass_(cuda), temperature_(cuda), heat_(cuda),
      mask_(cuda)
  {
  }

  std::string backend() const override { return engine_->backend(); }
  void set_grid(const GridView &grid) override { engine_->set_grid(grid); }

  void start(const Spheres &host, const StepSettings &step, SpringStore *springs) override
  {
    host_ = host;
    springs_ = has_history_ ? springs : nullptr;
    const std::size_t n = host.n;
    Spheres s = host;
    const auto put = [n](DeviceArray<Real> &to, const Real *from) {
      return from ? to.put(from, n) : nullptr;
    };
    packed_ = !packed_;
    s.x = put_vectors(x_, host.x, n);
    s.radius = put(radius_, host.radius);
    s.mask = host.mask ? mask_.put(host.mask, n) : nullptr;
    if (springs_) engine_->springs_from(*springs_, host.n);
    // As LAMMPS has it: places first, and velocities and forces after the search has begun.
    s.v = s.omega = {};
    s.force = s.torque = {};
    s.mass = s.temperature = s.heat_flow = nullptr;
    engine_->choose(s, 0);
    engine_->mark_places();
    engine_->search(s, step);
    s.v = put_vectors(v_, host.v, n);
    s.omega = put_vectors(omega_, host.omega, n);
    const std::vector<Real> none(3 * n, 0);
    s.force = rows_in(force_.put(none), n);
    s.torque = rows_in(torque_.put(none), n);
    s.mass = put(mass_, host.mass);
    s.temperature = put(temperature_, host.temperature);
    s.heat_flow = put(heat_, host.heat_flow);
    engine_->start(s, step, nullptr);
    moves_ = step.update_history;
  }

  void collect() override
  {
    engine_->collect();
    engine_->look();    // throws where a sphere was left out
    const std::size_t n = host_.n;
    add_vectors(host_.force, force_.get(3 * n), n);
    add_vectors(host_.torque, torque_.get(3 * n), n);
    if (host_.heat_flow) {
      const std::vector<Real> heat = heat_.get(n);
      for (std::size_t i = 0; i < n; i++) host_.heat_flow[i] = heat[i];
    }
    if (springs_ && moves_) engine_->springs_to(*springs_, host_.n);
  }

  const WallTotals &totals() const override { return engine_->totals(); }
  int n_touching() const override { return engine_->n_touching(); }
  const int *touching() const override { return engine_->touching(); }
  const SphereOutput *sphere_output() const override { return engine_->sphere_output(); }
  const Real *sphere_heat() const override { return engine_->sphere_heat(); }
  int n_records() const override { return engine_->n_records(); }
  const ContactRecord *records() const override { return engine_->records(); }
  int n_near() const override { return engine_->n_near(); }
  std::size_t bytes() const override { return engine_->bytes(); }

 private:
  Rows<Real> rows_in(Real *at, std::size_t n) const
  {
    return packed_ ? Rows<Real>(at) : Rows<Real>(at, 1, static_cast<std::ptrdiff_t>(n));
  }
  Rows<const Real> put_vectors(DeviceArray<Real> &to, const Rows<const Real> &from,
                               std::size_t n) const
  {
    std::vector<Real> laid_out(3 * n);
    const Rows<Real> rows = rows_in(laid_out.data(), n);
    for (std::size_t i = 0; i < n; i++) rows.put(i, from[i]);
    return rows_in(to.put(laid_out), n);
  }
  void add_vectors(const Rows<Real> &to, std::vector<Real> laid_out, std::size_t n) const
  {
    const Rows<Real> rows = rows_in(laid_out.data(), n);
    for (std::size_t i = 0; i < n; i++) to.add(i, rows[i]);
  }

  std::unique_ptr<ResidentEngine> engine_;
  bool has_history_, moves_ = false, packed_ = false;
  Spheres host_;
  SpringStore *springs_ = nullptr;
  DeviceArray<Real> x_, v_, omega_, force_, torque_, radius_, mass_, temperature_, heat_;
  DeviceArray<int> mask_;
};

}    // namespace

std::unique_ptr<WallEngine> for_host(std::unique_ptr<ResidentEngine> engine, bool has_history,
                                     bool cuda)
{
  return std::make_unique<ResidentForHost>(std::move(engine), has_history, cuda);
}

std::unique_ptr<WallEngine> make_resident_test_engine(const EngineSettings &settings)
{
  const bool cuda = settings.device == Device::cuda;
  return for_host(cuda ? make_resident_cuda_engine(settings, 0, nullptr)
                       : make_resident_cpu_engine(settings),
                  settings.law.has_history(), cuda);
}

std::unique_ptr<WallEngine> make_test_engine(EngineSettings settings)
{
  settings.device = test_device();
  return test_is_resident() ? make_resident_test_engine(settings) : make_engine(settings);
}

std::unique_ptr<WallEngine> on_host(EngineSettings settings)
{
  settings.device = Device::cpu;
  return make_engine(settings);
}

std::unique_ptr<WallEngine> in_place(EngineSettings settings)
{
  settings.device = test_device();
  return make_resident_test_engine(settings);
}

}    // namespace lsdcd
