// How a law is compiled for an NVIDIA GPU.
#pragma once

#include "parallel/backend_cuda.h"
#include "engine/force/joint_step.h"
#include "engine/force/laws.h"

namespace lsdcd {

using CudaLaw = CompiledLaw<CudaBackend>;

CudaLaw cuda_law(const EngineSettings &settings);

// Those of `granular`, one function per normal sub-model: a source file each.
CudaLaw cuda_hooke_law(const EngineSettings &);
CudaLaw cuda_hertz_law(const EngineSettings &);
CudaLaw cuda_dmt_law(const EngineSettings &);
CudaLaw cuda_jkr_law(const EngineSettings &);

// Those of the classic styles with effects of LIGGGHTS, and on walls with effects.
CudaLaw cuda_added_law(const EngineSettings &);
CudaLaw cuda_on_wall_law(const EngineSettings &);

// For with_..._law() of laws.h.
template <WallKernels kernels>
struct MakeCudaLaw {
  WallEffects effects;

  template <class Law>
  CudaLaw operator()(const Law &law) const
  {
    return on_wall<kernels>(law, effects, [](const auto &compiled) {
      using L = std::decay_t<decltype(compiled)>;
      return CudaLaw{traits_of<L>(), LawBytes(compiled), start_law<L, CudaBackend>};
    });
  }
};

}    // namespace lsdcd
