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

// Gives every contact its weight; `reach` is the distance at which contacts begin.
template <class Geometry, int kPlaces>
LSDCD_FN void share(const GridView &grid, const SearchSettings &settings, Real reach,
                    Touch<kPlaces> &out)
{
  if (settings.blend && out.set.n > 1) {
    CornerRule<kPlaces> rule;
    rule.solve(out.set, reach, out.weight, Geometry::slack(grid));
  } else {
    for (int i = 0; i < out.set.n; i++) out.weight[i] = 1;
  }
}

// A function of its own, so that it is compiled once however many laws there are.
// Where the set overflows nothing else is valid.
template <class Geometry, int kPlaces>
LSDCD_NOINLINE void touch(const GridView &grid, const SearchSettings &settings, const Vec3 &x,
                          Real radius, Touch<kPlaces> &out)
{
  out.exact_within = find_contacts_in<Geometry>(grid, x, radius, out.set);
  if (settings.side != 0) keep_side(grid.wall, settings.side * grid.outside, out.set);
  if (!out.set.overflow) share<Geometry>(grid, settings, radius, out);
}

// The same for adhesion that acts past touch, up to `reach` from the centre: beside what
// the sphere touches, what it has touched and not let go of since (`springs`: of the last
// step). Overlaps are shared as those of a sphere of radius `reach`, so that they are
// greater than 0 as long as a contact holds, and 0 where it lets go.
template <class Geometry, int kPlaces>
LSDCD_NOINLINE void touch_beyond(const GridView &grid, const SearchSettings &settings,
                                 const Vec3 &x, Real radius, Real reach, const Spring *springs,
                                 int n_springs, Touch<kPlaces> &out)
{
  out.exact_within = find_contacts_in<Geometry>(grid, x, reach, out.set);
  if (settings.side != 0) keep_side(grid.wall, settings.side * grid.outside, out.set);
  if (out.set.overflow) return;
  ContactSet<kPlaces> &set = out.set;
  for (int i = set.n - 1; i >= 0; i--)
    if (set.distance[i] >= radius &&
        !is_held(grid.wall, set.feature[i], set.normal[i], springs, n_springs))
      set.remove(i);
  share<Geometry>(grid, settings, reach, out);
}

}    // namespace lsdcd
