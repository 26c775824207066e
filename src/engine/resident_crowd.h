// Spheres with more contacts than a law's loop has places for: found ahead of the law, in
// memory that has room for them.
#pragma once

#include "base/atomic.h"
#include "engine/law_job.h"

namespace lsdcd {

// What one call needs to find the contacts of a crowded sphere: too much for a stack.
struct CrowdLane {
  Touch<kMostPlaces> touching;
  CornerRule<kMostPlaces> rule;
};

template <class B>
class ResidentCrowd {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  ResidentCrowd() :
      which_(kCrowded), first_(kCrowded), n_(kCrowded), uncertain_(kCrowded),
      feature_(kCrowdContacts), normal_(kCrowdContacts), distance_(kCrowdContacts),
      weight_(kCrowdContacts), lanes_(kLanes)
  {
  }

  Crowd view()
  {
    return {kCrowded,          kCrowdContacts,  which_.data(),  first_.data(),    n_.data(),
            uncertain_.data(), feature_.data(), normal_.data(), distance_.data(), weight_.data()};
  }

  // The contacts of those that the law's loop has noted in job.in_place.crowd; `pull_off`:
  // of the law, at a radius of 1.
  void find(B &b, const LawJob &job, Real pull_off)
  {
    CrowdLane *lanes = lanes_.data();
    const bool beyond = pull_off > 0;
    b.for_each(
        kLanes,
        [=] LSDCD_LAMBDA(std::size_t at) {
          StepCounts &counts = *job.in_place.counts;
          const Crowd &crowd = job.in_place.crowd;
          const int n = counts.n_crowded < crowd.most ? counts.n_crowded : crowd.most;
          for (int c = static_cast<int>(at); c < n; c += kLanes) {
            const std::size_t i = job.near[crowd.which[c]];
            const Real radius = job.radius[i], reach = reach_of(radius, pull_off);
            Searcher s = {job.x[i], radius, reach, nullptr, 0};
            if (beyond) {
              s.n_springs = job.springs.count[i];
              s.springs = job.springs.pool + (s.n_springs > 0 ? job.springs.first[i] : 0);
            }
            CrowdLane &lane = lanes[at];
            lane.touching.set.n = 0;
            lane.touching.set.overflow = false;
            if (job.grid.in_floats)
              find_one<BrickGeometry>(job, s, beyond, lane);
            else
              find_one<WallGeometry>(job, s, beyond, lane);
            keep_one(crowd, c, counts, lane.touching, reach);
          }
        },
        kLanes);
  }

  static constexpr std::size_t bytes()
  {
    return kLanes * sizeof(CrowdLane) + kCrowded * (3 * sizeof(int) + sizeof(Real)) +
           kCrowdContacts * (sizeof(FeatureCode) + sizeof(Vec3) + 2 * sizeof(Real));
  }

 private:
  static constexpr int kLanes = 8;    // 1 MB of memory each

  template <class Geometry>
  LSDCD_FN static void find_one(const LawJob &job, const Searcher &s, bool beyond, CrowdLane &lane)
  {
    if (beyond)
      search<true, Geometry>(job.grid, job.settings.search, s, lane.touching);
    else
      search<false, Geometry>(job.grid, job.settings.search, s, lane.touching);
    if (!lane.touching.set.overflow)
      share<Geometry>(job.grid, job.settings.search, s.reach, lane.rule, lane.touching);
  }

  LSDCD_FN static void keep_one(const Crowd &crowd, int c, StepCounts &counts,
                                const Touch<kMostPlaces> &found, Real reach)
  {
    crowd.n[c] = -1;
    if (found.set.overflow) return;
    const int n = found.set.n, first = fetch_add(&counts.crowd_used, n);
    if (first > crowd.size - n) return;
    crowd.n[c] = n;
    crowd.first[c] = first;
    crowd.uncertain[c] = found.exact_within < reach ? reach - found.exact_within : 0;
    for (int k = 0; k < n; k++) {
      crowd.feature[first + k] = found.set.feature[k];
      crowd.normal[first + k] = found.set.normal[k];
      crowd.distance[first + k] = found.set.distance[k];
      crowd.weight[first + k] = found.weight[k];
    }
  }

  Array<int> which_, first_, n_;
  Array<Real> uncertain_;
  Array<FeatureCode> feature_;
  Array<Vec3> normal_;
  Array<Real> distance_, weight_;
  Array<CrowdLane> lanes_;
};

}    // namespace lsdcd
