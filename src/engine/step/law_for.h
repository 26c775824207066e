// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Which compiled law the settings ask for. Compiled once for each backend, with the classic styles.
#pragma once

#include "engine/step/compile_law.h"

namespace lsdcd {

template <class B>
CompiledLaw<B> law_for(const EngineSettings &settings, const ContactLaw &law)
{
  const WallEffects effects = wall_effects(settings);
  if (!law.is_classic()) return granular_law<B>(law, effects);
  if (law.is_extended()) return added_law<B>(law, effects);
  if (effects.surface || effects.records) return on_wall_law<B>(law, effects);
  if (settings.precision == Precision::single_)
    return with_classic_law<float>(law, MakeLaw<B, WallKernels::plain>{});
  return with_classic_law<Real>(law, MakeLaw<B, WallKernels::plain>{});
}

template <class B>
CompiledLaw<B> law_for(const EngineSettings &settings)
{
  CompiledLaw<B> made = law_for<B>(settings, settings.law());
  made.laws.clear();
  for (const ContactLaw &law : settings.laws.laws) {
    const CompiledLaw<B> one = law_for<B>(settings, law);
    if (one.run != made.run) throw std::logic_error("laws of a wall must have the same sub-models");
    made.laws.push_back(one.laws.front());
  }
  return made;
}

}    // namespace lsdcd
