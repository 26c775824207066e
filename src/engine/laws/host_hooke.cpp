#include "engine/host_law.h"

namespace lsdcd {

HostLaw host_hooke_law(const EngineSettings &s)
{
  const ContactLaw &p = s.law;
  return with_granular_law(p, HookeNormal<Real>{p.granular.k_normal},
                           MakeHostLaw<WallKernels::both>{wall_effects(s)});
}

}    // namespace lsdcd
