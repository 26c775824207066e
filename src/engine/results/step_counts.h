// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Counters of the broad phase and of steps, in the memory of kernels.
#pragma once

#include "backend/atomic.h"
#include "engine/wall_engine.h"

#include <cstdint>

namespace lsdcd {

constexpr std::uint64_t kNoSphere = std::uint64_t(1) << 32;

// The first three are of one choice or step, the others since the host last read them.
struct StepCounts {
  std::uint32_t n_candidates;
  int shared_used[2];                    // slots, of each pool in the last step that wrote it
  int n_found[2], n_multi_contact[2];    // of WorkLists, in turn
  // Spheres left out, a time for each step, as they have more contacts than a scratch memory or as all shared
  // slots were taken: an error.
  int no_scratch, no_slots, unused;    // unused: so that there is no byte that nothing writes
  // kNoSphere less the index of the first sphere beyond the grid's cutoff, or 0: an error.
  std::uint64_t too_large;
  std::uint64_t grown;          // likewise of the first sphere that feels more than at the choice
  std::uint64_t uncertified;    // answers
  // deepest: (overlap / radius as ascending bits) << 32 | sphere + 1.
  // uncertain: the largest overlap / radius that an uncertified answer may have missed, as ascending bits.
  std::uint64_t deepest, uncertain;
  std::uint64_t lists, listed,
      by_cells;    // lists made in steps, their features; searches of cells
};

// The counts as the host reads them.
inline StepDiagnostics diagnostics_of(const StepCounts &seen)
{
  StepDiagnostics diagnostics;
  diagnostics.deepest = from_ascending_bits(static_cast<std::uint32_t>(seen.deepest >> 32));
  diagnostics.deepest_sphere = static_cast<int>(seen.deepest & 0xffffffffu) - 1;
  diagnostics.uncertified = static_cast<std::int64_t>(seen.uncertified);
  diagnostics.uncertain = from_ascending_bits(static_cast<std::uint32_t>(seen.uncertain));
  diagnostics.lists = static_cast<std::int64_t>(seen.lists);
  diagnostics.listed = static_cast<std::int64_t>(seen.listed);
  diagnostics.by_cells = static_cast<std::int64_t>(seen.by_cells);
  return diagnostics;
}

}    // namespace lsdcd
