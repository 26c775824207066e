// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The half of the kernel that no law changes: what a sphere touches, and how its
// contacts share their overlap.
#pragma once

#include "contact/corner.h"
#include "contact/history.h"
#include "engine/lists/wall_list.h"

namespace lsdcd {

struct SearchSettings {
  bool blend;    // corner rule; false: plain sum
  int side;      // 0 both, +1 outside, -1 inside
};

template <int kCapacity>
struct Touch {
  ContactSet<kCapacity> set;
  Real weight[kCapacity];    // share of each contact, 0 to 1
  Real exact_within;         // the set is certified for spheres up to this radius
};

// A sphere's cutoff, past which it feels nothing, and the springs it had in the last step.
template <class Springs>
struct QuerySphereWith {
  Vec3 x;
  Real radius, cutoff;
  Springs springs;    // read only where cutoff > radius
  int n_springs;
};
using QuerySphere = QuerySphereWith<const Spring *>;

// Leaves the contacts on the side that is asked for and, where adhesion acts beyond contact
// (cutoff > radius), beside those that overlap those that overlapped and have not let go since.
template <bool kBeyondContact, class Springs, int kCapacity>
LSDCD_FN void keep_acting(const GridView &grid, const SearchSettings &settings,
                          const QuerySphereWith<Springs> &s, ContactSet<kCapacity> &set)
{
  if (settings.side != 0) keep_side(grid.wall, settings.side * grid.outside, set);
  if constexpr (kBeyondContact) {
    for (int i = set.n - 1; i >= 0; i--)
      if (set.distance[i] >= s.radius &&
          !is_held(grid.wall, set.view(), i, settings.blend, s.springs, s.n_springs))
        set.remove(i);
  }
}

// What is within the cutoff, into a set that is empty: of the sphere's list, or of its cell where `list`
// is null. In the order of the features' numbers, so that the corner rule and sums give the same bits
// from both. Where the set overflows nothing else is valid.
template <bool kBeyondContact, class Geometry, class Springs, int kCapacity>
LSDCD_FN void search_in(const GridView &grid, const SearchSettings &settings,
                        const QuerySphereWith<Springs> &s, const ListedFeatures *list,
                        Touch<kCapacity> &out)
{
  out.exact_within = kAnyDistance;
  if (list)
    find_in_list<Geometry>(grid, *list, s.x, s.cutoff, out.set);
  else
    out.exact_within = find_contacts_in<Geometry>(grid, s.x, s.cutoff, out.set);
  keep_acting<kBeyondContact>(grid, settings, s, out.set);
  out.set.sort();
}
template <bool kBeyondContact, class Springs, int kCapacity>
LSDCD_FN void search(const GridView &grid, const SearchSettings &settings,
                     const QuerySphereWith<Springs> &s, const ListedFeatures *list,
                     Touch<kCapacity> &out)
{
  if (grid.in_floats)
    search_in<kBeyondContact, BrickGeometry>(grid, settings, s, list, out);
  else
    search_in<kBeyondContact, MeshGeometry>(grid, settings, s, list, out);
}

// Can a search of this grid miss contacts?
LSDCD_FN bool may_miss_any(const GridView &grid)
{
  return grid.nearest > 0;
}

// Overlap of the deepest contact that may be missing; 0: certified.
LSDCD_FN Real may_miss(Real cutoff, Real exact_within)
{
  return exact_within < cutoff ? cutoff - exact_within : 0;
}

// How far apart closest points may be that count as one, by the geometry that the grid was made for.
LSDCD_FN Real tolerance_of(const GridView &grid)
{
  return grid.in_floats ? BrickGeometry::tolerance(grid) : MeshGeometry::tolerance(grid);
}

// Gives every contact its weight: overlaps are shared as those of a sphere of radius `cutoff`, so
// that they are greater than 0 as long as a contact holds, and 0 where it lets go.
template <int kCapacity>
LSDCD_FN void share(const SearchSettings &settings, Real cutoff, Real tolerance,
                    CornerRule<kCapacity> &rule, Touch<kCapacity> &out)
{
  if (settings.blend && out.set.n > 1)
    rule.solve(out.set, cutoff, out.weight, tolerance);
  else
    for (int i = 0; i < out.set.n; i++) out.weight[i] = 1;
}

// All that a sphere touches, with weights. `rule`: memory of the corner rule, which a stack may have
// no room for.
template <bool kBeyondContact, int kCapacity>
LSDCD_FN void touch_with(const GridView &grid, const SearchSettings &settings, const QuerySphere &s,
                         const ListedFeatures *list, CornerRule<kCapacity> &rule,
                         Touch<kCapacity> &out)
{
  search<kBeyondContact>(grid, settings, s, list, out);
  if (!out.set.overflow) share(settings, s.cutoff, tolerance_of(grid), rule, out);
}

// Functions of their own, so that they are compiled once however many laws there are.
template <bool kBeyondContact, int kCapacity>
LSDCD_NOINLINE void touch_in(CornerRule<kCapacity> &rule, const GridView &grid,
                             const SearchSettings &settings, const QuerySphere &s,
                             const ListedFeatures *list, Touch<kCapacity> &out)
{
  touch_with<kBeyondContact>(grid, settings, s, list, rule, out);
}
template <bool kBeyondContact, int kCapacity>
LSDCD_NOINLINE void touch(const GridView &grid, const SearchSettings &settings,
                          const QuerySphere &s, const ListedFeatures *list, Touch<kCapacity> &out)
{
  CornerRule<kCapacity> rule;
  touch_with<kBeyondContact>(grid, settings, s, list, rule, out);
}

// Can it touch anything after a way of up to the margin? Where it is not `mine` a thread only helps
// others of its warp. `cell`: see NearSearch.
template <unsigned kSize>
LSDCD_NOINLINE bool can_touch(const Warp<kSize> &warp, bool mine, const GridView &grid,
                              const QuerySphere &s, Real margin, std::uint32_t cell = kNoCell)
{
  if (grid.in_floats)
    return can_touch<BrickGeometry>(warp, mine, grid, s.x, s.cutoff, margin, cell);
  return can_touch<MeshGeometry>(warp, mine, grid, s.x, s.cutoff, margin, cell);
}

// Does a sphere seem to touch several of the features of its list where it is? No answer depends on this.
LSDCD_FN bool touches_several(const GridView &grid, const QuerySphere &s, const WallList &list)
{
  if (list.n < 2 || grid.in_floats) return false;
  const MeshGeometry geometry(grid, s.x);
  int n = 0;
  for (int i = 0; i < list.n; i++) n += geometry.may_be_closest(list.code[i], s.cutoff, 0);
  return n > 1;
}

// Makes the list of a sphere anew, for a way of up to `margin` at most; false: it has none, its cell
// has to be searched.
template <unsigned kSize>
LSDCD_NOINLINE bool gather(const Warp<kSize> &warp, bool mine, const GridView &grid,
                           const QuerySphere &s, Real margin, WallList &list)
{
  const Real most = kSkinFraction * s.radius, m = margin < most ? margin : most;
  if (grid.in_floats)
    gather_for<BrickGeometry>(warp, mine, grid, s.x, s.cutoff, m, list);
  else
    gather_for<MeshGeometry>(warp, mine, grid, s.x, s.cutoff, m, list);
  return mine && list.margin >= 0;
}

}    // namespace lsdcd
