// The search for contacts of crowded spheres: those with more contacts than a law's loop has
// places for, found ahead of the law in memory that has room for them.
#pragma once

#include "engine/results/step_notes.h"

#include <type_traits>

namespace lsdcd {

// What one call needs to find the contacts of a crowded sphere: too much for a stack.
struct CrowdLane {
  Touch<kMostPlaces> touching;
  CornerRule<kMostPlaces> rule;
};
constexpr int kCrowdLanes = 8;    // 1 MB of memory each

LSDCD_FN void keep_crowded(const LawJob &job, int c, const Searcher &s,
                           const Touch<kMostPlaces> &found)
{
  const Crowd &crowd = job.in_place.crowd;
  crowd.n[c] = -1;
  if (found.set.overflow) return;
  const int n = found.set.n, first = fetch_add(&job.in_place.counts->crowd_used, n);
  if (first > crowd.size - n) return;
  crowd.n[c] = n;
  crowd.first[c] = first;
  keep_uncertain(job, crowd.which[c], may_miss(s.reach, found.exact_within), s.radius);
  for (int k = 0; k < n; k++) {
    crowd.contacts.put(first + k, found.set, k);
    crowd.weight[first + k] = found.weight[k];
  }
}

// Lane `at` of kCrowdLanes that share the crowded spheres which the step has noted;
// `pull_off`: of the law, at a radius of 1.
template <bool kBeyond, class Geometry>
LSDCD_FN void find_crowded(const LawJob &job, Real pull_off, int at)
{
  const Crowd &crowd = job.in_place.crowd;
  const int noted = job.in_place.counts->n_crowded;
  const int n = noted < crowd.most ? noted : crowd.most;
  CrowdLane &lane = crowd.lanes[at];
  for (int c = at; c < n; c += kCrowdLanes) {
    const Searcher s = searcher_of(job, job.near[crowd.which[c]], kBeyond, pull_off);
    lane.touching.set.clear();
    search<kBeyond, Geometry>(job.grid, job.settings.search, s, lane.touching);
    if (!lane.touching.set.overflow)
      share<Geometry>(job.grid, job.settings.search, s.reach, lane.rule, lane.touching);
    keep_crowded(job, c, s, lane.touching);
  }
}

// Calls run(beyond, geometry) with the constant and the type that a law and a grid ask for;
// `pull_off`: of the law, at a radius of 1.
template <class Run>
void with_search(const LawJob &job, Real pull_off, const Run &run)
{
  if (pull_off > 0) {
    if (job.grid.in_floats)
      run(std::true_type(), SameAs<BrickGeometry>());
    else
      run(std::true_type(), SameAs<WallGeometry>());
  } else {
    if (job.grid.in_floats)
      run(std::false_type(), SameAs<BrickGeometry>());
    else
      run(std::false_type(), SameAs<WallGeometry>());
  }
}

template <bool kBeyond, class Geometry, class B>
void find_crowd_with(B &b, const LawJob &job, Real pull_off)
{
  b.for_each(kCrowdLanes, [=] LSDCD_LAMBDA(std::size_t lane) {
    find_crowded<kBeyond, Geometry>(job, pull_off, static_cast<int>(lane));
  });
}

// The contacts of all spheres that the law's loop has noted as crowded.
template <class B>
void find_crowd(B &b, const LawJob &job, Real pull_off)
{
  with_search(job, pull_off, [&](auto beyond, auto geometry) {
    using Geometry = typename decltype(geometry)::Type;
    find_crowd_with<decltype(beyond)::value, Geometry>(b, job, pull_off);
  });
}

}    // namespace lsdcd
