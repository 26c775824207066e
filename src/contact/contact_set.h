// The contacts of one sphere with the wall in one step.
#pragma once

#include "base/vec3.h"
#include "contact/spring.h"

namespace lsdcd {

// The contacts of a set of any size, borrowed.
struct ContactsView {
  int n;
  const FeatureCode *feature;
  const Vec3 *normal;
  const Real *distance;
};

// A fixed number of places, so that it can live in registers and local memory.
// `overflow` is set when more contacts were found than there are places; the
// caller then repeats the sphere with a larger set and drops nothing.
template <int kPlaces>
struct ContactSet {
  int n = 0;
  bool overflow = false;
  FeatureCode feature[kPlaces];
  Vec3 normal[kPlaces];      // unit, wall -> centre
  Real distance[kPlaces];    // centre to foot point, length; < 0 where the centre has crossed

  LSDCD_FN ContactsView view() const { return {n, feature, normal, distance}; }

  LSDCD_FN void add(FeatureCode f, const Vec3 &n_unit, Real d)
  {
    if (n == kPlaces) {
      overflow = true;
      return;
    }
    feature[n] = f;
    normal[n] = n_unit;
    distance[n++] = d;
  }
  LSDCD_FN void remove(int i)
  {
    n--;
    feature[i] = feature[n];
    normal[i] = normal[n];
    distance[i] = distance[n];
  }
};

}    // namespace lsdcd
