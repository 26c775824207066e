#include "engine/host_law.h"

namespace lsdcd {

HostLaw host_on_wall_law(const EngineSettings &s)
{
  return with_classic_law<Real>(s.law, MakeHostLaw<WallKernels::each>{wall_effects(s)});
}

}    // namespace lsdcd
