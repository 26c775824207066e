// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "base/kept_rows.h"

namespace lsdcd {

// What a process's grains keep (KeptRows) in the memory of an engine's backend, where the pointers of grains' numbers are valid.
// Each grain has a first row and a count, which follow it through sorting.
class ResidentRows {
 public:
  virtual ~ResidentRows() = default;

  // Copy the rows of the grains [0, n) to the memory of the CPU and from it. All other rows there are forgotten.
  virtual void to_cpu(KeptRows &rows, int n) = 0;
  virtual void from_cpu(const KeptRows &rows, int n) = 0;

  // The following functions are for a host that moves grains in the memory of the engine.

  // Reserves memory for n grains; new ones have no rows.
  virtual void grow(int n) = 0;
  virtual int *first() = 0;
  virtual int *count() = 0;

  // Packs grains that leave the process, in the layout of messages of a host on a GPU: first the offset of each grain's numbers,
  // as an integer in a double, then for each grain what KeptRows packs. Grain which[k] leaves, and grain from[k], if that is not
  // -1, takes its place. Returns how many numbers it wrote.
  virtual int largest_packed_size(int n) = 0;    // numbers of the largest of n grains; waits
  virtual int pack(int n, const int *which, const int *from, double *buffer) = 0;
  // Unpacks grains that have arrived: grain to[k], if that is not -1, gets the k-th of them. From n_first on, offsets are those of
  // a second message, which begins at `second`.
  virtual void unpack(int n, const int *to, const double *buffer, int n_first, int second) = 0;
};

}    // namespace lsdcd
