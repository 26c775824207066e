// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How a law is compiled for a backend.
#pragma once

#include "engine/step/joint_step.h"
#include "engine/step/laws.h"

namespace lsdcd {

// The laws that the settings ask for.
template <class B>
CompiledLaw<B> law_for(const EngineSettings &settings);

// Those of `granular`, of the classic styles with effects of LIGGGHTS, and of these styles on walls with
// effects: a source file each, compiled for each backend.
template <class B>
CompiledLaw<B> granular_law(const ContactLaw &law, const WallEffects &effects);
template <class B>
CompiledLaw<B> added_law(const ContactLaw &law, const WallEffects &effects);
template <class B>
CompiledLaw<B> on_wall_law(const ContactLaw &law, const WallEffects &effects);

// For with_..._law() of laws.h.
template <class B, WallKernels kernels>
struct MakeLaw {
  WallEffects effects;

  template <class Law>
  CompiledLaw<B> operator()(const Law &law) const
  {
    return on_wall<kernels>(law, effects, [](const auto &compiled) {
      using L = std::decay_t<decltype(compiled)>;
      return CompiledLaw<B>{traits_of(compiled), {LawBytes(compiled)}, run_compiled_law<L, B>};
    });
  }
};

}    // namespace lsdcd
