// Memory for contacts that are found ahead of the law, with room for all that there can be.
#pragma once

#include "engine/force/law_job.h"

namespace lsdcd {

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
    single_sphere_ = Array<int>(room_);
    single_feature_ = Array<FeatureCode>(room_);
    single_ = Array<Real>(room_ * kSingleReals);
    several_near_ = Array<int>(room_);
    several_ = Contacts(room_ * kPlaces);
    weight_ = Array<Real>(room_ * kPlaces);
    n_ = Array<int>(room_);
  }

  // Of one step over n near spheres. The two sets of counts take turns, so that a step finds
  // its own cleared by the one before.
  Found next(std::size_t n)
  {
    turn_ = 1 - turn_;
    return now(n);
  }
  Found now(std::size_t n)
  {
    Found found;
    found.counts = counts_.data() + turn_;
    found.next_counts = counts_.data() + (1 - turn_);
    found.n_near = static_cast<int>(n);
    Real *single = single_.data();
    const auto room = static_cast<std::ptrdiff_t>(room_);
    found.single = {single_sphere_.data(),        single_feature_.data(), {single, 1, room},
                    {single + 3 * room, 1, room}, {single + 6 * room},    {single + 7 * room}};
    found.several_near = several_near_.data();
    found.several = several_.view();
    found.weight = weight_.data();
    found.n = n_.data();
    return found;
  }

  std::size_t bytes() const
  {
    constexpr std::size_t contact = sizeof(FeatureCode) + sizeof(Vec3) + sizeof(Real);
    return counts_.size() * sizeof(FoundCounts) +
           room_ * (3 * sizeof(int) + sizeof(FeatureCode) + kSingleReals * sizeof(Real) +
                    kPlaces * (contact + sizeof(Real)));
  }

 private:
  static constexpr std::size_t kSingleReals = 8;    // place, normal, radius, distance

  Array<FoundCounts> counts_;
  Array<int> single_sphere_, several_near_, n_;
  Array<FeatureCode> single_feature_;
  Array<Real> single_;
  Contacts several_;
  Array<Real> weight_;
  std::size_t room_ = 0;
  int turn_ = 0;
};

}    // namespace lsdcd
