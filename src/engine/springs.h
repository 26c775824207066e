// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "contact/contact_history.h"

namespace lsdcd {

// The springs of a process's spheres in the memory of an engine's backend, where the pointers of spheres' numbers are valid.
// Each sphere has a first spring and a count, which follow it through sorting.
class Springs {
 public:
  virtual ~Springs() = default;

  // Copy the springs of the spheres [0, n) to the memory of the CPU and from it.
  virtual void to_store(ContactHistory &store, int n) = 0;
  virtual void from_store(const ContactHistory &store, int n) = 0;

  // The following functions are for a host that moves spheres in the memory of the engine.

  // Reserves memory for n spheres; new ones have no springs.
  virtual void grow(int n) = 0;
  virtual int *first() = 0;
  virtual int *count() = 0;

  // Packs spheres that leave the process, in the layout of messages of a host on a GPU: first the offset of each sphere's
  // numbers, as an integer in a double, then for each sphere its count of springs and its springs. Sphere which[k] leaves, and
  // sphere from[k], if that is not -1, takes its place. Returns how many numbers it wrote.
  virtual int largest_packed_size(int n) = 0;    // numbers of the largest of n spheres; waits
  virtual int most_packed_size() const = 0;      // the most numbers that a sphere can have
  virtual int pack(int n, const int *which, const int *from, double *buffer) = 0;
  // Unpacks spheres that have arrived: sphere to[k], if that is not -1, gets the k-th of them. From n_first on, offsets are
  // those of a second message, which begins at `second`.
  virtual void unpack(int n, const int *to, const double *buffer, int n_first, int second) = 0;
};

}    // namespace lsdcd
