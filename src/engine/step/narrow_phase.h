// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The narrow phase: finds the contacts of a sphere from its list or its cell, filters them, and gives each its
// weight by the corner rule. It does not depend on the law.
#pragma once

#include "contact/corner.h"
#include "contact/history.h"
#include "engine/lists/feature_list.h"
#include "engine/nodes/node_list.h"
#include "engine/settings.h"

namespace lsdcd {

struct SearchSettings {
  Corner corner = Corner::blend;
  Side side = Side::both;
};

template <int kCapacity>
struct WeightedContacts {
  ContactSet<kCapacity> set;
  Real weight[kCapacity];    // share of each contact, 0 to 1
  Real exact_within;         // the set is certified for spheres up to this radius
};

// Removes contacts on the wrong side. With adhesion beyond contact (cutoff > radius) a contact that does not overlap
// stays until it has let go.
template <bool kBeyondContact, class Springs, int kCapacity>
LSDCD_FN void filter_contacts(const GridView &grid, const SearchSettings &settings,
                              const QuerySphereWith<Springs> &s, ContactSet<kCapacity> &set)
{
  if (settings.side != Side::both)
    filter_side(grid.wall, (settings.side == Side::out ? 1 : -1) * grid.outside, set);
  if constexpr (kBeyondContact) {
    for (int i = set.n - 1; i >= 0; i--)
      if (set.distance[i] >= s.radius &&
          !is_held(grid.wall, set.view(), i, settings.corner == Corner::blend, s.springs,
                   s.n_springs))
        set.remove(i);
  }
}

// Returns whether the nodes of this grid's mesh move. Lists of spheres then name primitives. kNodes: it may be so.
template <bool kNodes>
LSDCD_FN bool is_at_nodes(const GridView &grid)
{
  return kNodes && grid.list_kind.is_every();
}

// Finds the contacts within the cutoff in the list of a sphere, which has features or primitives.
template <bool kNodes, int kCapacity>
LSDCD_FN void find_listed(const GridView &grid, const ListedFeatures &list, const Vec3 &q,
                          Real cutoff, ContactSet<kCapacity> &set)
{
  if constexpr (kNodes)
    if (is_at_nodes<kNodes>(grid)) return find_in_node_list(grid, list, q, cutoff, set);
  find_in_list(grid, list, q, cutoff, set);
}

// Finds the contacts within the cutoff and puts them into an empty set: from the sphere's list, or from its cell if
// `list` is null. They are sorted by the numbers of their features, so that the corner rule and sums give the same
// bits in both cases. If the set overflows, nothing else is valid.
template <bool kBeyondContact, bool kNodes, class Springs, int kCapacity>
LSDCD_FN void find_filtered(const GridView &grid, const SearchSettings &settings,
                            const QuerySphereWith<Springs> &s, const ListedFeatures *list,
                            WeightedContacts<kCapacity> &out)
{
  out.exact_within = kAnyDistance;
  if (list)
    find_listed<kNodes>(grid, *list, s.x, s.cutoff, out.set);
  else
    out.exact_within = find_contacts_in<PackedEntries>(grid, s.x, s.cutoff, out.set);
  filter_contacts<kBeyondContact>(grid, settings, s, out.set);
  out.set.sort();
}

// Returns whether a search of this grid can miss contacts. Lists of every primitive, such as those of nodes that
// move, leave nothing out.
LSDCD_FN bool may_miss_any(const GridView &grid)
{
  return grid.list_kind.has_primitives() && !grid.list_kind.is_every();
}

// Returns the overlap of the deepest contact that may be missing; 0: certified.
LSDCD_FN Real may_miss(Real cutoff, Real exact_within)
{
  return exact_within < cutoff ? cutoff - exact_within : 0;
}

// Gives every contact its weight. Overlaps are shared as those of a sphere of radius `cutoff`, so that they are
// greater than 0 as long as a contact holds, and 0 when it lets go.
template <int kCapacity>
LSDCD_FN void share_overlap(const SearchSettings &settings, Real cutoff, Real tolerance,
                            CornerRule<kCapacity> &rule, WeightedContacts<kCapacity> &out)
{
  if (settings.corner == Corner::blend && out.set.n > 1)
    rule.solve(out.set, cutoff, out.weight, tolerance);
  else
    for (int i = 0; i < out.set.n; i++) out.weight[i] = 1;
}

// Finds the contacts of a sphere with their weights. `rule`: memory of the corner rule, which may be too large for a
// stack. This is a function of its own, so that it is compiled once however many laws there are.
template <bool kBeyondContact, bool kNodes, int kCapacity>
LSDCD_NOINLINE void narrow_phase(CornerRule<kCapacity> &rule, const GridView &grid,
                                 const SearchSettings &settings, const QuerySphere &s,
                                 const ListedFeatures *list, WeightedContacts<kCapacity> &out)
{
  find_filtered<kBeyondContact, kNodes>(grid, settings, s, list, out);
  if (!out.set.overflow) share_overlap(settings, s.cutoff, grid.tolerance, rule, out);
}

}    // namespace lsdcd
