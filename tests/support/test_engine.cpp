// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "support/test_engine.h"

#include "support/device.h"
#include "support/device_memory.h"

namespace lsdcd {

namespace {

// Copies a host's spheres to the memory of an engine, and forces back. Vectors are x x x y y y z z z in
// one step and x y z x y z in the next. Two of four steps run beside the host's work, and one of these
// adds forces at once.
class InPlaceForHost : public WallEngine {
 public:
  InPlaceForHost(std::unique_ptr<WallEngine> engine, bool cuda,
                 std::function<void()> before_begin) :
      engine_(std::move(engine)),
      before_begin_(std::move(before_begin)), x_(cuda), v_(cuda), omega_(cuda), force_(cuda),
      torque_(cuda), radius_(cuda), mass_(cuda), temperature_(cuda), heat_(cuda), mask_(cuda)
  {
  }

  std::string backend() const override { return engine_->backend(); }
  void set_pose(const Pose &pose, int mesh) override { engine_->set_pose(pose, mesh); }
  bool is_under_way() const override { return engine_->is_under_way(); }
  StepResults &results() override { return engine_->results(); }
  ResidentRows &springs() override { return engine_->springs(); }
  NodeEngine *nodes(int mesh) override { return engine_->nodes(mesh); }
  void take_nodes(WallEngine &from) override
  {
    engine_->take_nodes(*dynamic_cast<InPlaceForHost &>(from).engine_);
  }
  StepDiagnostics read_diagnostics() override { return engine_->read_diagnostics(); }
  int n_candidates() const override { return engine_->n_candidates(); }
  std::size_t bytes() const override { return engine_->bytes(); }

  Real largest_radius(const Spheres &s) override { return engine_->largest_radius(places(s)); }
  Real farthest_past(const Spheres &s, const PeriodicFaces &faces) override
  {
    return engine_->farthest_past(places(s), faces);
  }
  void choose(const Spheres &s, Real margin, bool watch) override
  {
    engine_->choose(places(s), margin, watch);
  }
  bool has_moved(const Spheres &s) override { return engine_->has_moved(places(s)); }

  void begin(When /*when*/) override
  {
    if (before_begin_) before_begin_();
    state_ = StepState::begun;
  }

  void submit(const Spheres &host, const StepSettings &step) override
  {
    require(StepState::begun);
    host_ = host;
    turn_++;
    const std::size_t n = host.n;
    Spheres s = places(host);
    s.v = put_vectors(v_, host.v, n);
    s.omega = put_vectors(omega_, host.omega, n);
    const std::vector<Real> none(3 * n, 0);
    s.force = rows_in(force_.put(none), n);
    s.torque = rows_in(torque_.put(none), n);
    s.mass = put(mass_, host.mass, n);
    s.temperature = put(temperature_, host.temperature, n);
    s.heat_flow = put(heat_, host.heat_flow, n);
    constexpr When kWhen[] = {When::in_turn, When::in_turn, When::beside,
                              When::beside_adding_early};
    engine_->begin(kWhen[turn_ % 4]);
    engine_->submit(s, step);
    state_ = StepState::submitted;
  }

  void collect() override
  {
    require(StepState::submitted);
    engine_->collect();
    state_ = StepState::none;
    const std::size_t n = host_.n;
    add_vectors(host_.force, force_.get(3 * n), n);
    add_vectors(host_.torque, torque_.get(3 * n), n);
    if (!host_.heat_flow) return;
    const std::vector<Real> heat = heat_.get(n);
    for (std::size_t i = 0; i < n; i++) host_.heat_flow[i] = heat[i];
  }

 protected:
  void put_grid(const ViewOf<StepGrid> &grid, int mesh) override { engine_->set_grid(grid, mesh); }

 private:
  // The arrays that a choice reads.
  Spheres places(const Spheres &host)
  {
    const std::size_t n = host.n;
    Spheres s;
    s.n = host.n;
    s.x = put_vectors(x_, host.x, n);
    s.radius = put(radius_, host.radius, n);
    s.mask = host.mask ? mask_.put(host.mask, n) : nullptr;
    s.group_bit = host.group_bit;
    return s;
  }
  static Real *put(DeviceArray<Real> &to, const Real *from, std::size_t n)
  {
    return from ? to.put(from, n) : nullptr;
  }
  StridedView<Real> rows_in(Real *at, std::size_t n) const
  {
    return turn_ % 2 == 1 ? StridedView<Real>(at)
                          : StridedView<Real>(at, 1, static_cast<std::ptrdiff_t>(n));
  }
  StridedView<const Real> put_vectors(DeviceArray<Real> &to, const StridedView<const Real> &from,
                                      std::size_t n) const
  {
    std::vector<Real> laid_out(3 * n);
    const StridedView<Real> rows = rows_in(laid_out.data(), n);
    for (std::size_t i = 0; i < n; i++) rows.put(i, from[i]);
    return rows_in(to.put(laid_out), n);
  }
  void add_vectors(const StridedView<Real> &to, std::vector<Real> laid_out, std::size_t n) const
  {
    const StridedView<Real> rows = rows_in(laid_out.data(), n);
    for (std::size_t i = 0; i < n; i++) to.add(i, rows[i]);
  }

  std::unique_ptr<WallEngine> engine_;
  std::function<void()> before_begin_;
  int turn_ = 0;
  Spheres host_;
  DeviceArray<Real> x_, v_, omega_, force_, torque_, radius_, mass_, temperature_, heat_;
  DeviceArray<int> mask_;
};

}    // namespace

std::unique_ptr<WallEngine> in_place(EngineSettings settings)
{
  return in_place_after(std::move(settings), {});
}

std::unique_ptr<WallEngine> in_place_after(EngineSettings settings,
                                           std::function<void()> before_begin)
{
  const bool cuda = test_on_cuda();
  return std::make_unique<InPlaceForHost>(cuda ? make_cuda_engine_in_place(settings, 0, nullptr)
                                               : make_cpu_engine(settings),
                                          cuda, std::move(before_begin));
}

std::unique_ptr<WallEngine> make_test_engine(EngineSettings settings)
{
  if (test_in_place()) return in_place(settings);
  settings.device = test_device();
  return make_engine(settings);
}

std::unique_ptr<WallEngine> on_cpu(EngineSettings settings)
{
  settings.device = Device::cpu;
  return make_engine(settings);
}

std::unique_ptr<WallEngine> with_mirror(EngineSettings settings)
{
  settings.arrays = HostArrays::apart;
  return make_cpu_engine(settings);
}

}    // namespace lsdcd
