// The search for contacts ahead of the law, in kernels that each have one kind of work and
// that no law changes: one contact at most, which is what nearly all spheres have; and all
// contacts and their shares, for the few that the first one has listed.
#pragma once

#include "engine/found_contacts.h"
#include "engine/step_notes.h"

namespace lsdcd {

// Lists near spheres with one contact, and with that contact; and those with several. With
// room for one there is nothing to index, all is in registers.
template <bool kBeyond, bool kNearest, class Geometry>
struct FindOne {
  using Item = Touch<1>;
  LawJob job;
  Real pull_off;    // of the law, at a radius of 1

  LSDCD_FN int find(std::size_t k, Item &found) const
  {
    if (k == 0) {
      *job.found.next_counts = {};
      if (job.in_place.counts) clear_step(job.in_place);
    }
    const std::size_t i = job.near ? job.near[k] : k;
    const Searcher s = searcher_of(job, i, kBeyond, pull_off);
    note_reach(job, i, s.reach);
    if constexpr (kNearest) {
      search<kBeyond, Geometry>(job.grid, job.settings.search, s, found);
    } else {
      GridView grid = job.grid;
      grid.nearest = 0;    // it is; so told, the compiler leaves out the search of such lists
      search<kBeyond, Geometry>(grid, job.settings.search, s, found);
    }
    if (found.set.overflow) return kSeveral;
    keep_uncertain(job, k, may_miss(s.reach, found.exact_within), s.radius);
    if (found.set.n == 1) return kSingle;
    touches_nothing(job, k, i);
    return kNoList;
  }
  LSDCD_FN void keep(int list, int at, std::size_t k, const Item &found) const
  {
    job.found.sphere[list][at] = static_cast<int>(k);
    if (list == kSingle) job.found.single.put(at, found.set, 0);
  }
};

// The s-th that is listed as having several contacts; it may have one or none after all.
template <bool kBeyond, class Geometry>
LSDCD_FN void find_several(const LawJob &job, Real pull_off, std::size_t s)
{
  const Found &found = job.found;
  const std::size_t k = found.sphere[kSeveral][s], i = job.near ? job.near[k] : k;
  const Searcher searcher = searcher_of(job, i, kBeyond, pull_off);
  Touch<kPlaces> touching;
  touch<kBeyond, Geometry>(job.grid, job.settings.search, searcher, touching);
  if (touching.set.overflow) {
    found.n[s] = crowded_as(put_off(job, k));
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

template <bool kBeyond, class Geometry, class B>
void find_first_with(B &b, const LawJob &job, std::size_t n, Real pull_off)
{
  int *listed = job.found.counts->listed;
  if (job.grid.nearest > 0)
    b.list(n, FindOne<kBeyond, true, Geometry>{job, pull_off}, listed);
  else
    b.list(n, FindOne<kBeyond, false, Geometry>{job, pull_off}, listed);
  for_each_several(b, job.found, n, [=] LSDCD_LAMBDA(std::size_t s) {
    find_several<kBeyond, Geometry>(job, pull_off, s);
  });
}

// Fills job.found for n near spheres and notes the crowded ones; `pull_off`: of the law, at
// a radius of 1.
template <class B>
void find_first(B &b, const LawJob &job, std::size_t n, Real pull_off)
{
  if (pull_off > 0) {
    if (job.grid.in_floats)
      find_first_with<true, BrickGeometry>(b, job, n, pull_off);
    else
      find_first_with<true, WallGeometry>(b, job, n, pull_off);
  } else {
    if (job.grid.in_floats)
      find_first_with<false, BrickGeometry>(b, job, n, pull_off);
    else
      find_first_with<false, WallGeometry>(b, job, n, pull_off);
  }
}

}    // namespace lsdcd
