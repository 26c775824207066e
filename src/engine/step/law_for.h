// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Which compiled law the settings ask for. Compiled once for each backend, with the classic styles.
#pragma once

#include "engine/step/compile_law.h"

namespace lsdcd {

template <class B>
CompiledLaw<B> one_law_for(const EngineSettings &settings)
{
  const ContactLaw &law = settings.law;
  if (!law.is_classic()) return granular_law<B>(settings);
  if (law.is_extended()) return added_law<B>(settings);
  const WallEffects effects = wall_effects(settings);
  if (effects.surface || effects.records) return on_wall_law<B>(settings);
  if (settings.precision == Precision::single_)
    return with_classic_law<float>(law, MakeLaw<B, WallKernels::plain>{});
  return with_classic_law<Real>(law, MakeLaw<B, WallKernels::plain>{});
}

template <class B>
CompiledLaw<B> law_for(const EngineSettings &settings)
{
  CompiledLaw<B> made = one_law_for<B>(settings);
  EngineSettings one = settings;
  for (const ContactLaw &law : settings.laws.laws) {
    one.law = law;
    const CompiledLaw<B> other = one_law_for<B>(one);
    if (other.start != made.start)
      throw std::logic_error("laws of a wall must have the same sub-models");
    made.table.push_back(other.law);
  }
  return made;
}

}    // namespace lsdcd
