#include "engine/host_law.h"

namespace lsdcd {

HostLaw host_added_law(const EngineSettings &s)
{
  return with_added_law(s.law, MakeHostLaw<WallKernels::both>{wall_effects(s)});
}

}    // namespace lsdcd
