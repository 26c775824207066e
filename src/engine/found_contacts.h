// Memory for contacts that are found ahead of the law, with room for all that there can be.
#pragma once

#include "engine/law_job.h"

#include <algorithm>

namespace lsdcd {

// f(s) for those of n near spheres that are listed as having several contacts. The host does
// not know how many there are: each of so many lanes takes what falls to it.
constexpr std::size_t kSeveralLanes = 1 << 16;

template <class B, class F>
void for_each_several(B &b, const Found &found, std::size_t n, const F &f)
{
  const std::size_t lanes = std::min(n, kSeveralLanes);
  const FoundCounts *counts = found.counts;
  b.for_each(
      lanes,
      [=] LSDCD_LAMBDA(std::size_t lane) {
        const std::size_t n_several = counts->listed[kSeveral];
        for (std::size_t s = lane; s < n_several; s += lanes) f(s);
      },
      128);
}

template <class B>
class FoundContacts {
  template <class T>
  using Array = typename B::template Array<T>;

  struct Contacts {
    Array<FeatureCode> feature;
    Array<Vec3> normal;
    Array<Real> distance;

    Contacts() = default;
    explicit Contacts(std::size_t n) : feature(n), normal(n), distance(n) {}
    ContactArrays view() { return {feature.data(), normal.data(), distance.data()}; }
  };

 public:
  // For steps over n near spheres.
  void reserve(B &b, std::size_t n)
  {
    if (counts_.size() == 0) {
      counts_ = Array<FoundCounts>(2);
      FoundCounts *counts = counts_.data();
      b.for_each(2, [=] LSDCD_LAMBDA(std::size_t i) { counts[i] = {}; });
    }
    if (n <= room_) return;
    room_ = n + n / 8;
    for (Array<int> &list : sphere_) list = Array<int>(room_);
    single_ = Contacts(room_);
    several_ = Contacts(room_ * kPlaces);
    weight_ = Array<Real>(room_ * kPlaces);
    n_ = Array<int>(room_);
  }

  // Of one step. The two sets of counts take turns, so that a step finds its own cleared
  // by the one before.
  Found next()
  {
    turn_ = 1 - turn_;
    return now();
  }
  Found now()
  {
    Found found;
    found.counts = counts_.data() + turn_;
    found.next_counts = counts_.data() + (1 - turn_);
    for (int i = 0; i < kFoundLists; i++) found.sphere[i] = sphere_[i].data();
    found.single = single_.view();
    found.several = several_.view();
    found.weight = weight_.data();
    found.n = n_.data();
    return found;
  }

  std::size_t bytes() const
  {
    constexpr std::size_t contact = sizeof(FeatureCode) + sizeof(Vec3) + sizeof(Real);
    return counts_.size() * sizeof(FoundCounts) +
           room_ *
               ((kFoundLists + 1) * sizeof(int) + (1 + kPlaces) * contact + kPlaces * sizeof(Real));
  }

 private:
  Array<FoundCounts> counts_;
  Array<int> sphere_[kFoundLists], n_;
  Contacts single_, several_;
  Array<Real> weight_;
  std::size_t room_ = 0;
  int turn_ = 0;
};

}    // namespace lsdcd
