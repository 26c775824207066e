#include "engine/force/cuda_law.h"

namespace lsdcd {

CudaLaw cuda_law(const EngineSettings &settings)
{
  const ContactLaw &law = settings.law;
  if (law.style != LawStyle::granular && law.added.any()) return cuda_added_law(settings);
  if (law.style != LawStyle::granular) {
    const WallEffects effects = wall_effects(settings);
    if (effects.surface || effects.records) return cuda_on_wall_law(settings);
    if (settings.precision == Precision::single_)
      return with_classic_law<float>(law, MakeCudaLaw<WallKernels::plain>{});
    return with_classic_law<Real>(law, MakeCudaLaw<WallKernels::plain>{});
  }
  switch (law.granular.normal) {
    case NormalModel::hertz:
      return cuda_hertz_law(settings);
    case NormalModel::dmt:
      return cuda_dmt_law(settings);
    case NormalModel::jkr:
      return cuda_jkr_law(settings);
    default:
      return cuda_hooke_law(settings);
  }
}

}    // namespace lsdcd
