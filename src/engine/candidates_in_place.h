// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The choice of an engine, for a host that brings each step the numbers of its candidates alone.
#pragma once

namespace lsdcd {

// Engines for particles in their own memory are such, too.
class CandidatesInPlace {
 public:
  virtual ~CandidatesInPlace() = default;

  // Indices of the n_candidates() of the last choice, in the memory of the engine's backend. A sphere near several
  // meshes may be there once for each.
  virtual const int *candidates() const = 0;
};

}    // namespace lsdcd
