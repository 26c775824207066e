// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Contact laws for grains that may be no spheres, and what a step knows of such grains, on a CPU.
#pragma once

#include "backend/atomic.h"
#include "contact/near_features.h"
#include "engine/grains.h"
#include "engine/results/step_counts.h"
#include "law/contact_model.h"
#include "shape/shapes_made.h"
#include "tree/triangle_tree.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

// What is within `reach` (length) of where a candidate's centre was when the list was made, in the frame of the mesh.
struct NearList {
  Vec3 from = {0, 0, 0};
  Real reach = -1;    // below 0: there is no list
  NearFeatures features;

  // Does it have all within `radius` of x?
  bool holds(const Vec3 &x, Real radius) const { return norm(x - from) + radius <= reach; }
};

// Shapes, trees and lists for steps.
struct ShapeWork {
  const GrainShape *rows = nullptr;     // of all grains of the step; null: all are spheres
  std::vector<Superellipsoid> shape;    // of each candidate, by its index; half-axes 0: a sphere
  std::vector<Quaternion> turn;         // of each of them that is no sphere, as in rows
  std::vector<const TriangleTree *> trees;    // of each mesh
  std::vector<NearList> near;                 // of each slot
  // kNoSphere less the index of the first grain whose nearest points were not found to rounding, or 0: an error.
  std::uint64_t unsure = 0;
  // The largest overlap / least radius of curvature as DeepestOverlap::ratio(), and the index of the grain + 1.
  std::uint64_t sharpest = 0;

  bool is_sphere(std::size_t i) const { return !rows || rows[i].is_sphere(); }
};

// A law with the arm of a grain beside the spring of each contact.
template <class Base>
struct ShapeLaw {
  static constexpr bool kHistory = Base::kHistory;
  static constexpr int kVectors = kHistory ? 1 : 0, kScalars = 0, kExtra = 3 * kVectors;
  static constexpr bool kBeyondContact = false, kContactTorque = false, kHeat = false;
  static_assert(Base::kExtra == 0 && !Base::kBeyondContact && !Base::kContactTorque,
                "such laws are not for shapes");

  Base base;
  ShapeWork *work;

  bool stores(int) const { return true; }
  template <class Memory>
  ContactForce evaluate(const Contact &c, Memory &memory) const
  {
    ContactMemory<0> sliding = {memory.shear};
    const ContactForce force = base.evaluate(c, sliding);
    memory.shear = sliding.shear;
    return force;
  }
};

// Does the law read Contact::radius?
template <class Normal, class Damping, class Tangential>
bool reads_radius(const ContactModel<Normal, Damping, Tangential> &)
{
  return Normal::kUsesContactRadius;
}
template <class Normal, bool kHistory>
bool reads_radius(const GranularModel<Normal, kHistory, false> &law)
{
  return law.uses_contact_radius || law.elastic.uses_contact_radius();
}

}    // namespace lsdcd
