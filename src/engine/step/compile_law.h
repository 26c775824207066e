// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Selects the compiled laws for the settings of an engine: the smallest ones that have all effects asked
// for.
#pragma once

#include "engine/step/run_compiled_law.h"
#include "law/smallest_model.h"

#include <stdexcept>
#include <type_traits>

namespace lsdcd {

// Compiles a law with the effects of the wall; an argument for with_..._law().
template <class B, WallKernels kernels>
struct CompileLaw {
  WallEffects effects;

  template <class Law>
  CompiledLaw<B> operator()(const Law &law) const
  {
    return on_wall<kernels, B::kOnCpu>(law, effects, [](const auto &compiled) {
      using L = std::decay_t<decltype(compiled)>;
      return CompiledLaw<B>{traits_of(compiled), {LawBytes(compiled)}, run_compiled_law<L, B>};
    });
  }
};

// Each of the following functions has a group of laws that are compiled together, with a source file for
// each group and each backend (laws/CMakeLists.txt).
template <class B>
CompiledLaw<B> granular_law(const ContactLaw &law, const WallEffects &effects);
template <class B>
CompiledLaw<B> added_law(const ContactLaw &law, const WallEffects &effects);
template <class B>
CompiledLaw<B> granular_added_law(const ContactLaw &law, const WallEffects &effects);
template <class B>
CompiledLaw<B> plastic_law(const ContactLaw &law, const WallEffects &effects);
template <class B>
CompiledLaw<B> reaching_law(const ContactLaw &law, const WallEffects &effects);
template <class B>
CompiledLaw<B> on_wall_law(const ContactLaw &law, const WallEffects &effects);
template <class B>
CompiledLaw<B> plain_law(const ContactLaw &law, const WallEffects &effects);
template <class B>
CompiledLaw<B> energy_law(const ContactLaw &law, const WallEffects &effects);
template <class B>
CompiledLaw<B> energy_records_law(const ContactLaw &law, const WallEffects &effects);
template <class B>
CompiledLaw<B> impacts_law(const ContactLaw &law, const WallEffects &effects);

// Returns the compiled form of one law of the settings.
template <class B>
CompiledLaw<B> law_for(const EngineSettings &settings, const ContactLaw &law)
{
  const WallEffects effects = wall_effects(settings);
  if (law.keeps_forces)
    return effects.records ? energy_records_law<B>(law, effects) : energy_law<B>(law, effects);
  if (effects.records) return impacts_law<B>(law, effects);
  if (law.reaches()) return reaching_law<B>(law, effects);
  if (law.yields()) return plastic_law<B>(law, effects);
  if (law.is_extended())
    return law.is_classic() ? added_law<B>(law, effects) : granular_added_law<B>(law, effects);
  if (!law.is_classic()) return granular_law<B>(law, effects);
  if (effects.posed || effects.contacts) return on_wall_law<B>(law, effects);
  return plain_law<B>(law, effects);
}

// Returns the compiled forms of all laws of the settings.
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
