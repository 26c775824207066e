// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The candidates of an engine, for a host that copies no other spheres to the engine in each step.
#pragma once

namespace lsdcd {

// Engines for particles that lie where the engine computes have this interface.
class CandidatesInPlace {
 public:
  virtual ~CandidatesInPlace() = default;

  // Indices of the n_candidates() of the last choice, in the memory of the engine's backend. A sphere near several
  // meshes may be there once for each.
  virtual const int *candidates() const = 0;
};

}    // namespace lsdcd
