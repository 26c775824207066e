// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Neighbour lists (Verlet lists): for each candidate sphere the features that it can touch while its centre stays
// within a margin of where it was. A step tests these alone and reads no cell.
#pragma once

#include "contact/find_contacts.h"
#include "engine/lists/feature_search.h"
#include "engine/lists/record_copies.h"

namespace lsdcd {

// The list of one sphere. There is no room for more than kMax features: where more are close the
// margin shrinks, and where that does not help the sphere has no list and its cell is searched
// instead.
struct FeatureList {
  static constexpr int kMax = 7;

  Vec3 x;         // the centre when the list was made
  Real margin;    // length; negative: there is no list
  Real cutoff;    // how far from its centre a sphere felt the wall then
  std::int32_t n;
  FeatureCode code[kMax];    // ascending
};

// The lists of many, a column per number, so that neighbours read neighbouring words.
struct FeatureLists {
  static constexpr std::size_t kReals = 4, kInts = 1 + FeatureList::kMax;    // of a list

  Real *x = nullptr;            // columns x, y, z
  float *lengths = nullptr;     // columns margin, cutoff; in units, as walls may be 1e-60 in size
  std::int32_t *n = nullptr;    // columns n, code[0], code[1], ...
  std::size_t column = 0;
  Real unit = 1;
  RecordCopies copies = {};

  // Columns of `room` lists; unit: a length of the size of radii.
  static FeatureLists of(Real *reals, std::int32_t *ints, std::size_t room, Real unit)
  {
    return {reals, reinterpret_cast<float *>(reals + 3 * room), ints, room, unit, {}};
  }

  // Returns the lists from number k on.
  FeatureLists from(std::size_t k) const
  {
    return {x + k, lengths + k, n + k, column, unit, copies.from(k)};
  }

  // Does list k hold all that a sphere at q can touch, up to a cutoff?
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
  // `has_cutoff`: list k already has the list's cutoff, which is not rounded up once more.
  LSDCD_FN void put(std::size_t k, const FeatureList &list, const MeshFeaturesView &wall,
                    bool has_cutoff = false) const
  {
    for (int d = 0; d < 3; d++) x[d * column + k] = list.x[d];
    // Rounded down, and up.
    lengths[k] = static_cast<float>((1 - Real(1e-6)) * (list.margin / unit));
    if (!has_cutoff)
      lengths[column + k] = static_cast<float>((1 + Real(1e-6)) * (list.cutoff / unit));
    n[k] = list.n;
    for (int i = 0; i < list.n; i++)
      n[(i + 1) * column + k] = static_cast<std::int32_t>(list.code[i]);
    copies.put(k, wall, list.code, list.n);
  }
};

// List k of many, borrowed.
struct ListedFeatures {
  const FeatureLists &lists;
  std::size_t k;
};

// How far a sphere may go before its list is made again, as a share of its radius. Far enough that
// lists last hundreds of steps, near enough that most have one or two features.
constexpr Real kSkinFraction = 0.05;
// Where a list is too long its margin is divided by kShrink, up to kMaxShrinks times.
constexpr Real kShrink = 4;
constexpr int kMaxShrinks = 3;

// Returns the largest margin, at most `margin`, within which a ball meets few cells.
LSDCD_FN Real allowed_margin(const GridView &grid, Real margin)
{
  return margin < grid.length ? margin : grid.length;
}

// Puts a code into a list where it belongs, once. False: there is no room for it.
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

// Begins a list of a sphere at q.
LSDCD_FN void begin_list(FeatureList &list, const Vec3 &q, Real cutoff, Real margin)
{
  list.n = 0;
  list.x = q;
  list.margin = margin;
  list.cutoff = cutoff;
}

// Finds the list of a sphere at q for a margin; false: it is too long.
template <unsigned kSize>
LSDCD_FN bool gather_within(const Warp<kSize> &warp, bool mine, const GridView &grid, const Vec3 &q,
                            Real cutoff, Real margin, FeatureList &list)
{
  if (mine) begin_list(list, q, cutoff, margin);
  return for_each_within(warp, mine, grid, {q, cutoff, margin, excess_margin(grid, margin), -1},
                         [&](FeatureCode code) { return insert_code(list, code); });
}

// A sphere's cutoff, past which it feels nothing, and the springs it had in the last step.
template <class Springs>
struct QuerySphereWith {
  Vec3 x;
  Real radius, cutoff;
  Springs springs;    // read only where cutoff > radius
  int n_springs;
};
using QuerySphere = QuerySphereWith<const Spring *>;

// Can a sphere touch a feature after moving by up to the margin? True, too, where the answer would take too
// long. A feature at distance d is in the list of any cell from which it is within the grid's cutoff: cells
// within d - grid.cutoff of the sphere are enough. A thread whose sphere is not `mine`
// helps the others of its warp.
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

// Does a sphere seem to touch more than one feature of its list where it is? A hint: no result depends on it.
LSDCD_FN bool touches_more_than_one(const GridView &grid, const QuerySphere &s,
                                    const FeatureList &list)
{
  if (list.n < 2) return false;
  const MeshGeometry geometry(grid, s.x);
  int n = 0;
  for (int i = 0; i < list.n; i++) n += geometry.may_be_closest(list.code[i], s.cutoff, 0);
  return n > 1;
}

// Makes a new list of a sphere, for a way of up to `margin` at most, or for less where that list is too long;
// false: it has none, its cell has to be searched.
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

// Local minima of the distance from q to the listed features, in the order of their numbers, so
// that an answer does not depend on when the list was made.
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
