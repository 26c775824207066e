// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Counters of the broad phase and of steps, in the memory of kernels.
#pragma once

#include "backend/atomic.h"
#include "engine/results/step_results.h"

#include <cstdint>

namespace lsdcd {

constexpr std::uint64_t kNoSphere = std::uint64_t(1) << 32;

// Three words, each of which begins with overlap / radius as ascending bits, so that each keeps the deepest overlap of
// all threads. In the first word the mesh and the sphere + 1 follow; 2^28 spheres of a process would not fit into its
// memory. The other two words are written only if the first one was: steps follow each other, so that the second word
// always belongs to the sphere in the first. The third word is for a sphere between several meshes, and has a bit for
// each mesh that it touches. It may belong to another sphere with the same overlap in float; hence the CPU checks that
// it contains the mesh of the first word.
struct DeepestOverlap {
  static constexpr int kRatioAt = 33, kMeshAt = 28;
  static constexpr std::uint64_t kRest = (std::uint64_t(1) << kRatioAt) - 1,
                                 kSphere = (std::uint64_t(1) << kMeshAt) - 1;

  LSDCD_FN static std::uint64_t ratio(Real overlap_ratio)
  {
    return std::uint64_t(ascending_bits(static_cast<float>(overlap_ratio))) << kRatioAt;
  }
};

// The counts up to n_multi_contact are of the last candidate search or step, the others since the CPU last read them.
struct StepCounts {
  std::uint32_t n_candidates;
  int shared_used[2];                    // places of each pool in the last step that wrote it
  int n_found[2], n_multi_contact[2];    // of WorkLists, in turn
  // Spheres that were left out, counted in each step, because they have more contacts than a scratch memory, or because
  // all shared places were taken: an error.
  int no_scratch, no_places, unused;    // unused: so that no byte is left unwritten
  // kNoSphere less the index of the first sphere beyond the grid's cutoff, or 0: an error.
  std::uint64_t too_large;
  // kNoSphere less the index of the first sphere with a larger cutoff than at the candidate search, or 0: an error.
  std::uint64_t grown;
  std::uint64_t uncertified;    // number of answers
  // The deepest overlap, see DeepestOverlap.
  std::uint64_t deepest, deepest_step, deepest_meshes;
  // The largest overlap / radius that an uncertified answer may have missed, as ascending bits.
  std::uint64_t uncertain;
  std::uint64_t lists, listed,
      by_cells;    // lists made in steps, their features; searches of cells
};

// Returns the counts as the CPU reads them. `first_step`: number of the first step that they count.
inline StepDiagnostics diagnostics_of(const StepCounts &seen, std::int64_t first_step)
{
  using Deepest = DeepestOverlap;
  StepDiagnostics diagnostics;
  diagnostics.deepest =
      from_ascending_bits(static_cast<std::uint32_t>(seen.deepest >> Deepest::kRatioAt));
  diagnostics.deepest_sphere = static_cast<int>(seen.deepest & Deepest::kSphere) - 1;
  if (seen.deepest > 0) {
    const auto mesh =
        static_cast<std::uint32_t>((seen.deepest & Deepest::kRest) >> Deepest::kMeshAt);
    diagnostics.deepest_mesh = static_cast<int>(mesh);
    diagnostics.deepest_meshes = 1u << mesh;
    const auto meshes = static_cast<std::uint32_t>(seen.deepest_meshes & Deepest::kRest);
    if (((seen.deepest_meshes ^ seen.deepest) >> Deepest::kRatioAt) == 0 && (meshes >> mesh & 1))
      diagnostics.deepest_meshes = meshes;
    diagnostics.deepest_step =
        first_step + static_cast<std::int64_t>(seen.deepest_step & Deepest::kRest);
  }
  diagnostics.uncertified = static_cast<std::int64_t>(seen.uncertified);
  diagnostics.uncertain = from_ascending_bits(static_cast<std::uint32_t>(seen.uncertain));
  diagnostics.lists = static_cast<std::int64_t>(seen.lists);
  diagnostics.listed = static_cast<std::int64_t>(seen.listed);
  diagnostics.by_cells = static_cast<std::int64_t>(seen.by_cells);
  return diagnostics;
}

}    // namespace lsdcd
