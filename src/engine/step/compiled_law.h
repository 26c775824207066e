// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A compiled contact law behind two pointers, so that engines are compiled once and laws
// add only the loop over spheres.
#pragma once

#include "engine/step/law_job.h"
#include "engine/step/on_wall.h"

#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>

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

// The parameters of any law, as bytes.
class LawBytes {
 public:
  template <class Law>
  explicit LawBytes(const Law &law)
  {
    static_assert(std::is_trivially_copyable<Law>::value && sizeof(Law) <= sizeof bytes_,
                  "laws are plain numbers");
    ::new (bytes_) Law(law);
  }
  template <class Law>
  const Law &as() const
  {
    return *std::launder(reinterpret_cast<const Law *>(bytes_));
  }

 private:
  alignas(std::max_align_t) unsigned char bytes_[256];
};

// A law compiled for one backend; start() does the step of n near spheres, see start_law().
template <class Backend>
struct CompiledLaw {
  LawTraits traits;
  LawBytes law;
  void (*start)(const LawBytes &, const LawJob &, std::size_t n, Backend &);
};

// The wall's effects that the settings ask for.
inline WallEffects wall_effects(const EngineSettings &s)
{
  return {s.surface.moves() || s.moves || s.meshes > 1, s.records};
}

}    // namespace lsdcd
