// The search for contacts ahead of the law, in kernels that each have one kind of work and
// that no law changes: one contact at most, which is what nearly all spheres have; and all
// contacts and their shares, for the few that the first one has listed.
#pragma once

#include "parallel/rows_together.h"
#include "engine/narrow/find_crowd.h"
#include "engine/narrow/found_contacts.h"

namespace lsdcd {

// Lists near spheres with one contact, with that contact and what else the law reads of
// them, and those with several. With room for one there is nothing to index, all is in
// registers.
template <bool kBeyond, bool kNearest, class Geometry>
struct FindOne {
  struct Item {
    int sphere;
    Vec3 x;
    Real radius;
    Touch<1> touch;
  };
  LawJob job;
  Real pull_off;    // of the law, at a radius of 1

  LSDCD_FN void read(std::size_t k, Item &item) const
  {
    item.sphere = job.near ? job.near[k] : static_cast<int>(k);
    item.radius = job.radius[item.sphere];
    item.x = RowsTogether(item.sphere).read(job.x);
  }
  LSDCD_FN int find(std::size_t k, Item &item) const
  {
    if (k == 0) {
      *job.found.next_counts = {};
      if (job.in_place.counts) clear_step(job.in_place);
    }
    const Searcher s = searcher_of(job, item.sphere, item.x, item.radius, kBeyond, pull_off);
    note_reach(job, item.sphere, s.reach);
    if constexpr (kNearest) {
      search<kBeyond, Geometry>(job.grid, job.settings.search, s, item.touch);
    } else {
      GridView grid = job.grid;
      grid.nearest = 0;    // it is; so told, the compiler leaves out the search of such lists
      search<kBeyond, Geometry>(grid, job.settings.search, s, item.touch);
    }
    const ContactSet<1> &set = item.touch.set;
    if (set.overflow) return kSeveral;
    keep_uncertain(job, k, may_miss(s.reach, item.touch.exact_within), s.radius);
    if (set.n == 1) return kSingle;
    lose_springs(job, item.sphere);
    return kNoList;
  }
  LSDCD_FN void keep(int list, int at, std::size_t k, const Item &item) const
  {
    const Found &found = job.found;
    int result = ResultColumns::kNowhere;
    if (list == kSingle) {
      const SingleContacts &single = found.single;
      single.sphere[at] = item.sphere;
      single.x.put(at, item.x);
      single.radius[at] = item.radius;
      single.feature[at] = item.touch.set.feature[0];
      single.normal.put(at, item.touch.set.normal[0]);
      single.distance[at] = item.touch.set.distance[0];
      result = at;
    } else if (list == kSeveral) {
      found.several_near[at] = static_cast<int>(k);
      result = found.result_of_several(at);
    }
    if (job.in_place.counts)
      job.in_place.result.place[k] = result;
    else if (list == kNoList)
      job.result[k].n_contacts = 0;
  }
};

// All contacts of those that are listed as having several; they may have one or none after
// all. Then those of the crowded ones.
template <bool kBeyond, class Geometry>
struct FindSeveral {
  LawJob job;
  Real pull_off;

  LSDCD_FN std::size_t n_few() const { return job.found.counts->listed[kSeveral]; }
  // Counts what is done, where that takes counting.
  LSDCD_FN unsigned *ended() const { return &job.found.counts->several_ended; }

  LSDCD_FN void few(std::size_t s) const
  {
    const Found &found = job.found;
    const std::size_t k = found.several_near[s], i = job.near ? job.near[k] : k;
    const Searcher searcher = searcher_of(job, i, kBeyond, pull_off);
    Touch<kPlaces> touching;
    touch<kBeyond, Geometry>(job.grid, job.settings.search, searcher, touching);
    if (touching.set.overflow) {
      found.n[s] = crowded_as(put_off(job, k, result_of_several(job, s, k)));
      return;
    }
    keep_uncertain(job, k, may_miss(searcher.reach, touching.exact_within), searcher.radius);
    found.n[s] = touching.set.n;
    for (int c = 0; c < touching.set.n; c++) {
      const std::size_t to = s * kPlaces + c;
      found.several.put(to, touching.set, c);
      found.weight[to] = touching.weight[c];
    }
  }

  static constexpr std::size_t kLastLanes = kCrowdLanes;
  LSDCD_FN void last(std::size_t lane) const
  {
    if (job.in_place.counts) find_crowded<kBeyond, Geometry>(job, pull_off, static_cast<int>(lane));
  }
};

template <bool kBeyond, class Geometry, class B>
void find_first_with(B &b, const LawJob &job, std::size_t n, Real pull_off)
{
  int *listed = job.found.counts->listed;
  if (job.grid.nearest > 0)
    b.list(n, FindOne<kBeyond, true, Geometry>{job, pull_off}, listed);
  else
    b.list(n, FindOne<kBeyond, false, Geometry>{job, pull_off}, listed);
  b.few(n, FindSeveral<kBeyond, Geometry>{job, pull_off});
}

// Fills job.found for n near spheres, and finds the contacts of crowded ones; `pull_off`: of
// the law, at a radius of 1.
template <class B>
void find_first(B &b, const LawJob &job, std::size_t n, Real pull_off)
{
  with_search(job, pull_off, [&](auto beyond, auto geometry) {
    using Geometry = typename decltype(geometry)::Type;
    find_first_with<decltype(beyond)::value, Geometry>(b, job, n, pull_off);
  });
}

}    // namespace lsdcd
