// How a law is compiled for the host.
#pragma once

#include "engine/backend_cpu.h"
#include "engine/compiled_law.h"
#include "engine/laws.h"

namespace lsdcd {

template <class Law>
SphereState state_of(const HostJob &job, int i)
{
  const Spheres &all = *job.spheres;
  const auto at = [i](const Real *a) { return Vec3{a[3 * i], a[3 * i + 1], a[3 * i + 2]}; };
  SphereState s = {
      at(all.x), at(all.v), at(all.omega), all.radius[i], all.mass[i], nullptr, nullptr, 0, 0};
  if constexpr (Law::kHistory) {
    s.springs = job.springs->of(i);
    s.extra = job.springs->extra_of(i);
    s.n_springs = job.springs->count(i);
  }
  if constexpr (Law::kHeat) s.temperature = all.temperature[i];
  return s;
}

template <class Law>
void run_law(const LawBytes &bytes, const HostJob &job, std::size_t n)
{
  const Law &law = bytes.as<Law>();
  CpuBackend().for_each(n, [&](std::size_t k) {
    SphereSink sink;    // what the law has no use for is not even set
    if constexpr (Law::kHistory) sink.springs = job.sink.springs + k * kPlaces;
    if constexpr (Law::kExtra > 0) sink.extra = job.sink.extra + k * kPlaces * Law::kExtra;
    if constexpr (Law::kHeat) sink.heat = job.sink.heat + k;
    if constexpr (Law::kRecords) sink.records = job.sink.records + k * kPlaces;
    job.result[k] = wall_force<Law, kPlaces>(*job.grid, law, job.settings,
                                             state_of<Law>(job, job.near[k]), sink);
  });
}

template <class Law>
bool redo_law(const LawBytes &bytes, const HostJob &job, std::size_t k, const SphereSink &sink)
{
  const Law &law = bytes.as<Law>();
  const SphereState s = state_of<Law>(job, job.near[k]);
  SphereResult &result = job.result[k];
  result = wall_force<Law, kMorePlaces>(*job.grid, law, job.settings, s, sink);
  if (result.n_contacts == kOverflow)
    result = wall_force<Law, kMostPlaces>(*job.grid, law, job.settings, s, sink);
  return result.n_contacts != kOverflow;
}

// For with_..._law() of laws.h.
template <WallKernels kernels>
struct MakeHostLaw {
  WallEffects effects;

  template <class Law>
  HostLaw operator()(const Law &law) const
  {
    return on_wall<kernels>(law, effects, [](const auto &compiled) {
      using L = std::decay_t<decltype(compiled)>;
      return HostLaw{traits_of<L>(), LawBytes(compiled), run_law<L>, redo_law<L>};
    });
  }
};

}    // namespace lsdcd
