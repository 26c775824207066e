// The half of the kernel that no law changes: what a sphere touches, and how its
// contacts share their overlap.
#pragma once

#include "contact/corner.h"
#include "contact/find_contacts.h"
#include "contact/history.h"

namespace lsdcd {

struct SearchSettings {
  bool blend;    // corner rule; false: plain sum
  int side;      // 0 both, +1 outside, -1 inside
};

template <int kPlaces>
struct Touch {
  ContactSet<kPlaces> set;
  Real weight[kPlaces];    // share of each contact, 0 to 1
  Real exact_within;       // the set is certified for spheres up to this radius
};

// A sphere's reach, past which it feels nothing, and the springs it had in the last step.
struct Searcher {
  Vec3 x;
  Real radius, reach;
  const Spring *springs;    // read only where reach > radius
  int n_springs;
};

// What is within reach, into a set that is empty. Where adhesion acts past touch (reach >
// radius), that is beside what the sphere touches what it has touched and not let go of
// since. Where the set overflows nothing else is valid.
template <bool kBeyond, class Geometry, int kPlaces>
LSDCD_FN void search(const GridView &grid, const SearchSettings &settings, const Searcher &s,
                     Touch<kPlaces> &out)
{
  out.exact_within = find_contacts_in<Geometry>(grid, s.x, s.reach, out.set);
  if (settings.side != 0) keep_side(grid.wall, settings.side * grid.outside, out.set);
  if constexpr (kBeyond) {
    ContactSet<kPlaces> &set = out.set;
    for (int i = set.n - 1; i >= 0; i--)
      if (set.distance[i] >= s.radius &&
          !is_held(grid.wall, set.feature[i], set.normal[i], s.springs, s.n_springs))
        set.remove(i);
  }
}

// Can a search of this grid miss contacts?
LSDCD_FN bool may_miss_any(const GridView &grid)
{
  return grid.nearest > 0 && !grid.complete.bricks;
}

// Overlap of the deepest contact that may be missing; 0: certified.
LSDCD_FN Real may_miss(Real reach, Real exact_within)
{
  return exact_within < reach ? reach - exact_within : 0;
}

// Gives every contact its weight. Overlaps are shared as those of a sphere of radius
// `reach`, so that they are greater than 0 as long as a contact holds, and 0 where it lets
// go.
template <class Geometry, int kPlaces>
LSDCD_FN void share(const GridView &grid, const SearchSettings &settings, Real reach,
                    CornerRule<kPlaces> &rule, Touch<kPlaces> &out)
{
  if (settings.blend && out.set.n > 1)
    rule.solve(out.set, reach, out.weight, Geometry::slack(grid));
  else
    for (int i = 0; i < out.set.n; i++) out.weight[i] = 1;
}

// A function of its own, so that it is compiled once however many laws there are.
template <bool kBeyond, class Geometry, int kPlaces>
LSDCD_NOINLINE void touch(const GridView &grid, const SearchSettings &settings, const Searcher &s,
                          Touch<kPlaces> &out)
{
  search<kBeyond, Geometry>(grid, settings, s, out);
  if (out.set.overflow) return;
  CornerRule<kPlaces> rule;
  share<Geometry>(grid, settings, s.reach, rule, out);
}

}    // namespace lsdcd
