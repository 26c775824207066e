// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// One law's kernel by itself, for bench/free_when_off.py, which compiles this with the
// sources as they are and with effects cut out of them.
#pragma once

#include "engine/step/compiled_law.h"
#include "engine/step/contact_forces.h"
#include "engine/step/narrow_phase.h"
#include "law/contact_model.h"

namespace lsdcd {

#if PROBE_LAW == 0
using ProbedLaw = OnWall<HookeLaw, false, false>;
#elif PROBE_LAW == 1
using ProbedLaw = OnWall<HookeHistoryLaw, false, false>;
#elif PROBE_LAW == 2
using ProbedLaw = OnWall<HertzHistoryLaw, false, false>;
#else
using ProbedLaw = OnWall<GranularModel<TouchingNormal, true, false>, false, false>;
#endif

// Search, law and result of one sphere, as the kernels have them; `sink` has room for 8 contacts.
LSDCD_FN SphereResult probed_force(const GridView &grid, const ProbedLaw &law,
                                   const ForceSettings &settings, const SphereState &s,
                                   const SphereSink &sink)
{
  SphereResult out = {};
  CornerRule<8> rule;
  WeightedContacts<8> found = {};
  narrow_phase<false, false>(rule, grid, settings.search, {s.x, s.radius, s.radius}, nullptr,
                             found);
  if (!found.set.overflow)
    add_contacts(grid, law, settings, s, found.set.view(), found.weight, sink, out);
  return out;
}

}    // namespace lsdcd
