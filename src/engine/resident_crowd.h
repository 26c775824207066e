// Spheres with more contacts than a law's loop has places for: found ahead of the law, in
// memory that has room for them.
#pragma once

#include "engine/step_notes.h"

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
      which_(kCrowded), first_(kCrowded), n_(kCrowded), feature_(kCrowdContacts),
      normal_(kCrowdContacts), distance_(kCrowdContacts), weight_(kCrowdContacts), lanes_(kLanes)
  {
  }

  Crowd view()
  {
    return {kCrowded,      kCrowdContacts, which_.data(),
            first_.data(), n_.data(),      {feature_.data(), normal_.data(), distance_.data()},
            weight_.data()};
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
          const Crowd &crowd = job.in_place.crowd;
          const int noted = job.in_place.counts->n_crowded;
          const int n = noted < crowd.most ? noted : crowd.most;
          for (int c = static_cast<int>(at); c < n; c += kLanes) {
            const Searcher s = searcher_of(job, job.near[crowd.which[c]], beyond, pull_off);
            CrowdLane &lane = lanes[at];
            lane.touching.set.n = 0;
            lane.touching.set.overflow = false;
            if (job.grid.in_floats)
              find_one<BrickGeometry>(job, s, beyond, lane);
            else
              find_one<WallGeometry>(job, s, beyond, lane);
            keep_one(job, c, s, lane.touching);
          }
        },
        kLanes);
  }

  static constexpr std::size_t bytes()
  {
    return kLanes * sizeof(CrowdLane) + kCrowded * 3 * sizeof(int) +
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

  LSDCD_FN static void keep_one(const LawJob &job, int c, const Searcher &s,
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

  Array<int> which_, first_, n_;
  Array<FeatureCode> feature_;
  Array<Vec3> normal_;
  Array<Real> distance_, weight_;
  Array<CrowdLane> lanes_;
};

}    // namespace lsdcd
