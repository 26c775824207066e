// What a contact law is given and what it returns.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

// One sphere-wall contact in one step. T is the type that forces are computed in.
template <class T>
struct Contact {
  Vec3Of<T> normal;       // unit, wall -> centre
  T overlap;              // length, > 0 in contact
  T radius;               // of the sphere; its effective radius against a wall
  T mass;                 // of the sphere, or of the rigid body it belongs to
  T v_normal;             // length/time, > 0 when it moves away from the wall
  Vec3Of<T> v_tangent;    // length/time, of the sphere's surface at the contact
  T dt;                   // time
  bool update;            // false: springs act but do not move (setup)
};

template <class T>
struct ContactForce {
  T normal;                // force along the normal, < 0 where damping pulls
  Vec3Of<T> tangential;    // force on the sphere at the contact
  T energy;                // elastic energy held
};

}    // namespace lsdcd
