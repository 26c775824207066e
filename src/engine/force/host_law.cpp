#include "engine/force/host_law.h"

#include "base/input_error.h"

namespace lsdcd {

HostLaw host_law(const EngineSettings &settings)
{
  const ContactLaw &law = settings.law;
  if (law.style != LawStyle::granular && law.added.any()) return host_added_law(settings);
  if (law.style != LawStyle::granular) {
    const WallEffects effects = wall_effects(settings);
    if (effects.surface || effects.records) return host_on_wall_law(settings);
    if (settings.precision == Precision::single_)
      return with_classic_law<float>(law, MakeHostLaw<WallKernels::plain>{});
    return with_classic_law<Real>(law, MakeHostLaw<WallKernels::plain>{});
  }
  switch (law.granular.normal) {
    case NormalModel::hertz:
      return host_hertz_law(settings);
    case NormalModel::dmt:
      return host_dmt_law(settings);
    case NormalModel::jkr:
      return host_jkr_law(settings);
    default:
      return host_hooke_law(settings);
  }
}

}    // namespace lsdcd
