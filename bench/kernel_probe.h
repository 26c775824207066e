// One law's kernel by itself, for bench/free_when_off.py, which compiles this with the
// sources as they are and with effects cut out of them.
#pragma once

#include "engine/force/on_wall.h"
#include "engine/force/wall_force.h"
#include "model/contact_model.h"

namespace lsdcd {

#if PROBE_LAW == 0
using ProbedLaw = OnWall<HookeLaw<Real>, false, false>;
#elif PROBE_LAW == 1
using ProbedLaw = OnWall<HookeHistoryLaw<Real>, false, false>;
#elif PROBE_LAW == 2
using ProbedLaw = OnWall<HertzHistoryLaw<Real>, false, false>;
#else
using ProbedLaw = OnWall<GranularModel<Real, HertzNormal<Real>, SpringFriction<Real, false>,
                                       NoRolling<Real>, NoTwisting<Real>, NoHeat<Real>>,
                         false, false>;
#endif

}    // namespace lsdcd
