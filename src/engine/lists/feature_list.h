// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Neighbour lists (Verlet lists): for each candidate sphere the features that it can touch while its centre stays
// within a margin of where it was. A step tests only these features and reads no cell.
#pragma once

#include "contact/find_contacts.h"
#include "engine/lists/feature_search.h"
#include "engine/lists/record_copies.h"

namespace lsdcd {

// The list of one sphere. It has space for kMax features. If more are close, the margin is reduced; if that does
// not help, the sphere has no list, and its cell is searched instead.
struct FeatureList {
  static constexpr int kMax = 7;

  Vec3 x;         // the centre when the list was made
  Real margin;    // length; negative: there is no list
  Real cutoff;    // the sphere's cutoff, its range from the centre, at that time
  std::int32_t n;
  FeatureCode code[kMax];    // ascending
};

// The lists of many spheres, with a column for each number, so that neighbouring threads read neighbouring words.
struct FeatureLists {
  static constexpr std::size_t kReals = 4, kInts = 1 + FeatureList::kMax;    // of a list

  Real *x = nullptr;            // columns x, y, z
  float *lengths = nullptr;     // columns margin, cutoff; in units, as walls may be 1e-60 in size
  std::int32_t *n = nullptr;    // columns n, code[0], code[1], ...
  std::size_t column = 0;
  Real unit = 1;
  RecordCopies copies = {};

  // Returns lists in these columns, which have space for `room` lists. `unit`: a length of the size of radii.
  static FeatureLists of(Real *reals, std::int32_t *ints, std::size_t room, Real unit)
  {
    return {reals, reinterpret_cast<float *>(reals + 3 * room), ints, room, unit, {}};
  }

  // Returns the lists from number k on.
  FeatureLists from(std::size_t k) const
  {
    return {x + k, lengths + k, n + k, column, unit, copies.from(k)};
  }

  // Returns whether list k has all features that a sphere at q can touch, up to a cutoff.
  LSDCD_FN bool holds(std::size_t k, const Vec3 &q, Real up_to) const
  {
    const Real m = margin(k);
    const Vec3 way = q - Vec3{x[k], x[column + k], x[2 * column + k]};
    return m >= 0 && norm_sq(way) <= m * m && up_to <= cutoff(k);
  }
  LSDCD_FN Real margin(std::size_t k) const { return unit * lengths[k]; }
  LSDCD_FN Real cutoff(std::size_t k) const { return unit * lengths[column + k]; }
  LSDCD_FN int size(std::size_t k) const { return n[k]; }
  LSDCD_FN FeatureCode code(std::size_t k, int i) const
  {
    return static_cast<FeatureCode>(n[(i + 1) * column + k]);
  }
  // Stores a list. `has_cutoff`: list k already has the cutoff of this list, which is not rounded up a second
  // time.
  LSDCD_FN void put(std::size_t k, const FeatureList &list, const MeshFeaturesView &wall,
                    bool has_cutoff = false) const
  {
    for (int d = 0; d < 3; d++) x[d * column + k] = list.x[d];
    // The margin is rounded down, and the cutoff up.
    lengths[k] = static_cast<float>((1 - Real(1e-6)) * (list.margin / unit));
    if (!has_cutoff)
      lengths[column + k] = static_cast<float>((1 + Real(1e-6)) * (list.cutoff / unit));
    n[k] = list.n;
    for (int i = 0; i < list.n; i++)
      n[(i + 1) * column + k] = static_cast<std::int32_t>(list.code[i]);
    copies.put(k, wall, list.code, list.n);
  }
};

// A borrowed view of list k.
struct ListedFeatures {
  const FeatureLists &lists;
  std::size_t k;
};

// How far a sphere may move before its list is made again, as a share of its radius: far enough that lists last
// hundreds of steps, and near enough that most have one or two features.
constexpr Real kSkinFraction = 0.05;
// If a list is too long, its margin is divided by kShrink, up to kMaxShrinks times.
constexpr Real kShrink = 4;
constexpr int kMaxShrinks = 3;

// Returns the largest margin, at most `margin`, within which a ball meets few cells.
LSDCD_FN Real allowed_margin(const GridView &grid, Real margin)
{
  return margin < grid.length ? margin : grid.length;
}

// Inserts a code into a list in ascending order, if it is not there yet. Returns false if the list is full.
LSDCD_FN bool insert_code(FeatureList &list, FeatureCode code)
{
  int at = list.n;
  while (at > 0 && list.code[at - 1] > code) at--;
  if (at > 0 && list.code[at - 1] == code) return true;
  if (list.n == FeatureList::kMax) return false;
  for (int i = list.n; i > at; i--) list.code[i] = list.code[i - 1];
  list.code[at] = code;
  list.n++;
  return true;
}

// Starts an empty list of a sphere at q.
LSDCD_FN void begin_list(FeatureList &list, const Vec3 &q, Real cutoff, Real margin)
{
  list.n = 0;
  list.x = q;
  list.margin = margin;
  list.cutoff = cutoff;
}

// Finds the list of a sphere at q for a margin. Returns false if it is too long.
template <unsigned kSize>
LSDCD_FN bool gather_within(const Warp<kSize> &warp, bool mine, const GridView &grid, const Vec3 &q,
                            Real cutoff, Real margin, FeatureList &list)
{
  if (mine) begin_list(list, q, cutoff, margin);
  return for_each_within(warp, mine, grid, {q, cutoff, margin, excess_margin(grid, margin), -1},
                         [&](FeatureCode code) { return insert_code(list, code); });
}

// A sphere's cutoff, beyond which it feels nothing, and the springs that it had in the last step.
template <class Springs>
struct QuerySphereWith {
  Vec3 x;
  Real radius, cutoff;
  Springs springs;    // read only if cutoff > radius
  int n_springs;
};
using QuerySphere = QuerySphereWith<const Spring *>;

// Returns whether a sphere can touch a feature after moving by up to the margin. Also returns true if the answer
// would take too long. A feature at distance d is in the list of any cell from which it is within the grid's
// cutoff, so that it is enough to read cells within d - grid.cutoff of the sphere. A thread whose sphere is not
// `mine` helps the other threads of its warp.
template <unsigned kSize>
LSDCD_NOINLINE bool can_touch(const Warp<kSize> &warp, bool mine, const GridView &grid,
                              const QuerySphere &s, Real margin)
{
  const bool too_long = !(allowed_margin(grid, margin) >= margin);
  const Real past = excess_margin(grid, s.cutoff + margin - grid.cutoff);
  return !for_each_within(warp, mine && !too_long, grid, {s.x, s.cutoff, margin, past, s.cutoff},
                          [](FeatureCode) { return false; }) ||
         too_long;
}

// Returns whether a sphere seems to touch more than one feature of its list now. This is a hint: no result
// depends on it.
LSDCD_FN bool touches_more_than_one(const GridView &grid, const QuerySphere &s,
                                    const FeatureList &list)
{
  if (list.n < 2) return false;
  const MeshGeometry geometry(grid, s.x);
  int n = 0;
  for (int i = 0; i < list.n; i++) n += geometry.may_be_closest(list.code[i], s.cutoff, 0);
  return n > 1;
}

// Makes a new list of a sphere that may move by up to `margin`, or by less if that list is too long. Returns
// false if the sphere gets no list, so that its cell has to be searched.
template <unsigned kSize>
LSDCD_NOINLINE bool gather(const Warp<kSize> &warp, bool mine, const GridView &grid,
                           const QuerySphere &s, Real margin, FeatureList &list)
{
  const Real most = kSkinFraction * s.radius;
  Real m = allowed_margin(grid, margin < most ? margin : most);
  bool missing = mine;
  for (int i = 0; i <= kMaxShrinks && warp.vote(missing); i++, m /= kShrink)
    if (gather_within(warp, missing, grid, s.x, s.cutoff, m, list)) missing = false;
  if (missing) begin_list(list, s.x, s.cutoff, -1);
  return mine && !missing;
}

// Finds the local minima of the distance from q to the listed features, in the order of their numbers, so that
// the answer does not depend on when the list was made.
template <int kCapacity>
LSDCD_FN void find_in_list(const GridView &grid, const ListedFeatures &list, const Vec3 &q,
                           Real cutoff, ContactSet<kCapacity> &set)
{
  const int n = list.lists.size(list.k);
  if (n == 0) return;
  const MeshGeometry geometry(grid, q);
  for (int i = 0; i < n; i++) {
    const FeatureCode code = list.lists.code(list.k, i);
    const FeatureRecord *copy = list.lists.copies.of(list.k, i);
    if constexpr (kCapacity == 1)
      add_feature(geometry, code, cutoff, set, copy);
    else
      add_feature_noinline(geometry, code, cutoff, set, copy);
    if (set.overflow) return;    // nothing else is valid
  }
}

}    // namespace lsdcd
