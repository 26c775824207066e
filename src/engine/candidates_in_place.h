// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What an engine has chosen, for a host that brings each step what its candidates need, and no more.
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
