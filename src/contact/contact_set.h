// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The contacts of one sphere with the wall in one step.
#pragma once

#include "base/vec3.h"
#include "contact/spring.h"

namespace lsdcd {

// The largest number of contacts of one sphere: more are an error.
constexpr int kMaxContacts = 512;

// A borrowed view of the contacts in a set of any size. GrainContactsView (grain_contacts.h) answers the same
// questions for grains that are no spheres.
struct ContactsView {
  static constexpr bool kHasArms = false;    // are arms kept with the springs?
  int n;
  const FeatureCode *feature;
  const Vec3 *normal;
  const Real *distance;

  LSDCD_FN ContactsView part(int from, int n_of_part) const
  {
    return {n_of_part, feature + from, normal + from, distance + from};
  }
  // Returns the overlap of a sphere of this radius at contact i; length.
  LSDCD_FN Real overlap_of(int i, Real radius) const { return radius - distance[i]; }
  LSDCD_FN Vec3 foot_of(int i, const Vec3 &x, const Vec3 &n) const { return x - distance[i] * n; }
};

// An array of a set. A set with a single contact needs no index, so that it can stay in registers.
template <class T, int kMost>
struct ContactArray {
  T at[kMost];

  LSDCD_FN T &operator[](int i) { return at[i]; }
  LSDCD_FN const T &operator[](int i) const { return at[i]; }
  LSDCD_FN const T *data() const { return at; }
};
template <class T>
struct ContactArray<T, 1> {
  T only = {};

  LSDCD_FN T &operator[](int) { return only; }
  LSDCD_FN const T &operator[](int) const { return only; }
  LSDCD_FN const T *data() const { return &only; }
};

// The capacity is fixed, so that the set can stay in registers and local memory. `overflow` is set if there are
// more contacts than that. The caller then repeats the search with a larger set, so that no contact is dropped.
template <int kMost>
struct ContactSet {
  int n = 0;
  bool overflow = false;
  ContactArray<FeatureCode, kMost> feature;
  ContactArray<Vec3, kMost> normal;    // unit, wall -> centre
  ContactArray<Real, kMost>
      distance;    // centre to closest point, length; < 0 where the centre has crossed

  LSDCD_FN ContactsView view() const { return {n, feature.data(), normal.data(), distance.data()}; }

  LSDCD_FN void add(FeatureCode f, const Vec3 &n_unit, Real d)
  {
    if (n == kMost) {
      overflow = true;
      return;
    }
    feature[n] = f;
    normal[n] = n_unit;
    distance[n++] = d;
  }
  // Clears the set by its members: assigning an empty set of capacity 512 would take 18 kB of a GPU thread's
  // stack.
  LSDCD_FN void clear()
  {
    n = 0;
    overflow = false;
  }
  // Sorts the contacts by the numbers of their features. Sets are small, and those from lists are nearly sorted.
  LSDCD_FN void sort()
  {
    for (int i = 1; i < n; i++) {
      const FeatureCode f = feature[i];
      const Vec3 n_unit = normal[i];
      const Real d = distance[i];
      int j = i;
      for (; j > 0 && feature[j - 1] > f; j--) {
        feature[j] = feature[j - 1];
        normal[j] = normal[j - 1];
        distance[j] = distance[j - 1];
      }
      feature[j] = f;
      normal[j] = n_unit;
      distance[j] = d;
    }
  }
  LSDCD_FN void remove(int i)
  {
    n--;
    feature[i] = feature[n];
    normal[i] = normal[n];
    distance[i] = distance[n];
  }
};

}    // namespace lsdcd
