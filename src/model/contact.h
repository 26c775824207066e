// What a contact law is given and what it returns.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

// One sphere-wall contact in one step.
struct Contact {
  Vec3 normal;       // unit, wall -> centre
  Real overlap;      // length, > 0 in contact
  Real radius;       // of the sphere; its effective radius against a wall
  Real mass;         // of the sphere, or of the rigid body it belongs to
  Real v_normal;     // length/time, > 0 when it moves away from the wall
  Vec3 v_tangent;    // length/time, of the sphere's surface at the contact
  Real dt;           // time
  bool update;       // false: springs act but do not move (setup)
};

struct ContactForce {
  Real normal;        // force along the normal, < 0 where damping pulls
  Vec3 tangential;    // force on the sphere at the contact
  Real energy;        // elastic energy held
};

}    // namespace lsdcd
