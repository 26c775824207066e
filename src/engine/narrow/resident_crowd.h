// Memory of a resident engine for crowded spheres.
#pragma once

#include "engine/narrow/find_crowd.h"

namespace lsdcd {

template <class B>
class ResidentCrowd {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  ResidentCrowd() :
      which_(kCrowded), first_(kCrowded), n_(kCrowded), feature_(kCrowdContacts),
      normal_(kCrowdContacts), distance_(kCrowdContacts), weight_(kCrowdContacts),
      lanes_(kCrowdLanes)
  {
  }

  Crowd view()
  {
    return {kCrowded,       kCrowdContacts, which_.data(),
            first_.data(),  n_.data(),      {feature_.data(), normal_.data(), distance_.data()},
            weight_.data(), lanes_.data()};
  }

  static constexpr std::size_t bytes()
  {
    return kCrowdLanes * sizeof(CrowdLane) + kCrowded * 3 * sizeof(int) +
           kCrowdContacts * (sizeof(FeatureCode) + sizeof(Vec3) + 2 * sizeof(Real));
  }

 private:
  Array<int> which_, first_, n_;
  Array<FeatureCode> feature_;
  Array<Vec3> normal_;
  Array<Real> distance_, weight_;
  Array<CrowdLane> lanes_;
};

}    // namespace lsdcd
