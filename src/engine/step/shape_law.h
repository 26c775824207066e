// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Contact laws for grains that may be no spheres, and the data of such grains in a step, on a CPU.
#pragma once

#include "backend/atomic.h"
#include "contact/near_features.h"
#include "engine/grains.h"
#include "engine/results/step_counts.h"
#include "engine/step/compiled_law.h"
#include "law/contact_model.h"
#include "shape/shapes_made.h"
#include "tree/triangle_tree.h"

#include <cstdint>
#include <deque>
#include <type_traits>
#include <vector>

namespace lsdcd {

struct CpuBackend;

// All features within `reach` (length) of the place of a candidate's centre at the time when the list was made, in the frame of the
// mesh.
struct NearList {
  Vec3 from = {0, 0, 0};
  Real reach = -1;    // below 0: there is no list
  NearFeatures features;

  // Returns whether the list has all features within `radius` of x.
  bool holds(const Vec3 &x, Real radius) const { return norm(x - from) + radius <= reach; }
};

// Shapes, trees and lists for steps.
struct ShapeWork {
  const GrainShape *rows = nullptr;     // of all grains of the step; null: all are spheres
  std::vector<Superellipsoid> shape;    // of each candidate, by its index; half-axes 0: a sphere
  std::vector<Quaternion> turn;         // orientation of each of them that is no sphere, as in rows
  std::vector<const TriangleTree *> trees;    // of each mesh
  std::vector<NearList> near;                 // of each candidate-mesh pair
  // kNoSphere less the index of the first grain whose nearest points were not found to rounding, or 0: an error.
  std::uint64_t unsure = 0;
  // The largest overlap, divided by the depth that a contact may have (ShapeAtMeshes::check_depths), as DeepestOverlap::ratio(), and
  // the index of the grain + 1.
  std::uint64_t sharpest = 0;
  std::deque<LawBytes> laws;    // laws of spheres, for ShapeLaw: their addresses stay

  bool is_sphere(std::size_t i) const { return !rows || rows[i].is_sphere(); }
};

// A law of spheres that is called through a pointer, and that keeps the arm of a grain in addition to the spring of each contact. So
// steps of shapes are compiled only twice, with springs and without, and not for each law. kBooks: the law has an energy balance.
template <bool kHistory_, bool kBooks = false>
struct ShapeLaw {
  using Force = std::conditional_t<kBooks, FullForce, ContactForce>;
  static constexpr bool kHistory = kHistory_;
  static constexpr int kVectors = kHistory ? 1 : 0, kScalars = 0, kExtra = 3 * kVectors;
  static constexpr bool kBeyondContact = false, kContactTorque = kBooks, kHeat = false;
  static constexpr bool kReaches = false, kYields = false, kMidpoint = false;

  const LawBytes *base;    // one of work->laws
  ContactForce (*evaluate_base)(const LawBytes &base, const Contact &, ContactMemory<0> &);
  // Calls friction_spring() with the spring before and after.
  SpringPart (*spring_of_base)(const LawBytes &base, const Contact &, const Vec3 &begun,
                               const Vec3 &shear);
  bool reads_radius;    // does the law read Contact::radius?
  ShapeWork *work;
  // Call parts() with the spring before and after, and normal_energy(), for a law with kBooks.
  ForceParts (*parts_of_base)(const LawBytes &base, const Contact &, const Vec3 &begun,
                              const Vec3 &shear, const FullForce &);
  Real (*energy_of_base)(const LawBytes &base, const Contact &, Real overlap);

  bool stores(int) const { return true; }
  template <class Memory>
  Force evaluate(const Contact &c, Memory &memory) const
  {
    ContactMemory<0> sliding = {memory.shear};
    Force force = {};
    static_cast<ContactForce &>(force) = evaluate_base(*base, c, sliding);
    memory.shear = sliding.shear;
    return force;
  }
  template <class Memory>
  SpringPart friction_spring(const Contact &c, const Memory &begun, const Memory &memory) const
  {
    return spring_of_base(*base, c, begun.shear, memory.shear);
  }
  template <class Memory>
  ForceParts parts(const Contact &c, const Memory &begun, const Memory &memory,
                   const FullForce &force) const
  {
    return parts_of_base(*base, c, begun.shear, memory.shear, force);
  }
  Real normal_energy(const Contact &c, Real overlap) const
  {
    return energy_of_base(*base, c, overlap);
  }
};
template <bool kHistory, bool kBooks>
struct IsShapeLaw<ShapeLaw<kHistory, kBooks>> : std::true_type {
};

// Returns the law of the settings for grains of any shape. Throws InputError if they cannot have it.
CompiledLaw<CpuBackend> shape_law_for(const EngineSettings &, ShapeWork &);

}    // namespace lsdcd
