#include "engine/host_law.h"

namespace lsdcd {

HostLaw host_hertz_law(const EngineSettings &s)
{
  const ContactLaw &p = s.law;
  return with_granular_law(p, HertzNormal<Real>{p.granular.k_normal},
                           MakeHostLaw<WallKernels::both>{wall_effects(s)});
}

}    // namespace lsdcd
