// How a law is compiled for the host.
#pragma once

#include "parallel/backend_cpu.h"
#include "engine/force/law_step.h"
#include "engine/force/laws.h"

namespace lsdcd {

struct HostLaw : CompiledLaw<CpuBackend> {
  // Near sphere k once more, with more places for its contacts. False: still not enough.
  bool (*redo)(const LawBytes &, const LawJob &, std::size_t k, const SphereSink &);
};

// The law that the settings ask for.
HostLaw host_law(const EngineSettings &settings);

// Those of `granular`, one function per normal sub-model: a source file each.
HostLaw host_hooke_law(const EngineSettings &);
HostLaw host_hertz_law(const EngineSettings &);
HostLaw host_dmt_law(const EngineSettings &);
HostLaw host_jkr_law(const EngineSettings &);

// Those of the classic styles with effects of LIGGGHTS, and on walls with effects.
HostLaw host_added_law(const EngineSettings &);
HostLaw host_on_wall_law(const EngineSettings &);

template <class Law>
bool redo_law(const LawBytes &bytes, const LawJob &job, std::size_t k, const SphereSink &sink)
{
  const Law &law = bytes.as<Law>();
  const std::size_t i = job.near[k];
  SphereState s = place_of<Law>(job, i);
  add_motion<Law>(job, i, RowsAlone(i), s);
  SphereResult &result = job.result[k];
  result = wall_force<Law, kMorePlaces>(job.grid, law, job.settings, s, sink);
  if (result.n_contacts == kOverflow)
    result = wall_force<Law, kMostPlaces>(job.grid, law, job.settings, s, sink);
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
      return HostLaw{{traits_of<L>(), LawBytes(compiled), start_law<L, CpuBackend>}, redo_law<L>};
    });
  }
};

}    // namespace lsdcd
