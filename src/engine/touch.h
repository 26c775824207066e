// The half of the kernel that no law changes: what a sphere touches, and how its
// contacts share their overlap.
#pragma once

#include "contact/corner.h"
#include "contact/find_contacts.h"

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

// A function of its own, so that it is compiled once however many laws there are.
// Where the set overflows nothing else is valid.
template <class Geometry, int kPlaces>
LSDCD_NOINLINE void touch(const GridView &grid, const SearchSettings &settings, const Vec3 &x,
                          Real radius, Touch<kPlaces> &out)
{
  out.exact_within = find_contacts_in<Geometry>(grid, x, radius, out.set);
  if (settings.side != 0) keep_side(grid.wall, settings.side * grid.outside, out.set);
  if (out.set.overflow) return;
  if (settings.blend && out.set.n > 1) {
    CornerRule<kPlaces> rule;
    rule.solve(out.set, radius, out.weight, Geometry::slack(grid));
  } else {
    for (int i = 0; i < out.set.n; i++) out.weight[i] = 1;
  }
}

}    // namespace lsdcd
