// How a law is compiled for the host.
#pragma once

#include "parallel/backend_cpu.h"
#include "engine/force/joint_step.h"
#include "engine/force/laws.h"

namespace lsdcd {

using HostLaw = CompiledLaw<CpuBackend>;

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

// For with_..._law() of laws.h.
template <WallKernels kernels>
struct MakeHostLaw {
  WallEffects effects;

  template <class Law>
  HostLaw operator()(const Law &law) const
  {
    return on_wall<kernels>(law, effects, [](const auto &compiled) {
      using L = std::decay_t<decltype(compiled)>;
      return HostLaw{traits_of<L>(), LawBytes(compiled), start_law<L, CpuBackend>};
    });
  }
};

}    // namespace lsdcd
