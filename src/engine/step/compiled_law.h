// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A compiled contact law behind two pointers, so that engines are compiled once and laws
// add only the loop over spheres.
#pragma once

#include "engine/step/law_bytes.h"
#include "engine/step/law_job.h"
#include "engine/step/on_wall.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

// What engines have to store and move for a law.
struct LawTraits {
  bool history, heat, records;
  int n_extra;
};

template <class Law>
LawTraits traits_of(const Law &law)
{
  bool heat = false;
  if constexpr (Law::kHeat) heat = law.has_heat();
  return {Law::kHistory, heat, Law::kRecords, n_extra(law)};
}

// A law compiled for one backend; run() does the step of n near spheres, see run_compiled_law().
template <class Backend>
struct CompiledLaw {
  LawTraits traits;
  std::vector<LawBytes> laws;    // of LawTable::laws
  void (*run)(const LawBytes &, const LawJob &, std::size_t n, Backend &);
};

// The wall's effects that the settings ask for.
inline WallEffects wall_effects(const EngineSettings &s)
{
  return {s.surface.moves() || s.moves || has_several(s), s.records};
}

}    // namespace lsdcd
