#include "engine/host_law.h"

namespace lsdcd {

HostLaw host_dmt_law(const EngineSettings &s)
{
  const ContactLaw &p = s.law;
  return with_granular_law(p, DmtNormal<Real>(p.granular.k_normal, p.granular.cohesion),
                           MakeHostLaw<WallKernels::both>{wall_effects(s)});
}

}    // namespace lsdcd
