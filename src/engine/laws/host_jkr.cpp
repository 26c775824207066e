#include "engine/host_law.h"

namespace lsdcd {

HostLaw host_jkr_law(const EngineSettings &s)
{
  const ContactLaw &p = s.law;
  return with_granular_law(p, JkrNormal<Real>(p.granular.modulus, p.granular.cohesion),
                           MakeHostLaw<WallKernels::both>{wall_effects(s)});
}

}    // namespace lsdcd
