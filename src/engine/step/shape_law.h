// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Contact laws for grains that may be no spheres, and what a step knows of such grains, on a CPU.
#pragma once

#include "backend/atomic.h"
#include "contact/near_features.h"
#include "engine/grains.h"
#include "engine/results/step_counts.h"
#include "engine/step/compiled_law.h"
#include "law/contact.h"
#include "shape/shapes_made.h"
#include "tree/triangle_tree.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace lsdcd {

struct CpuBackend;

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
  // The largest overlap / GrainContact::limit as DeepestOverlap::ratio(), and the index of the grain + 1.
  std::uint64_t sharpest = 0;
  std::deque<LawBytes> laws;    // of spheres, for ShapeLaw: their addresses stay

  bool is_sphere(std::size_t i) const { return !rows || rows[i].is_sphere(); }
};

// A law of spheres, called through a pointer, with the arm of a grain beside the spring of each contact. So steps of shapes are
// compiled twice, with springs and without, and not for each law.
template <bool kHistory_>
struct ShapeLaw {
  static constexpr bool kHistory = kHistory_;
  static constexpr int kVectors = kHistory ? 1 : 0, kScalars = 0, kExtra = 3 * kVectors;
  static constexpr bool kBeyondContact = false, kContactTorque = false, kHeat = false;
  static constexpr bool kMidpoint = false;

  const LawBytes *base;    // one of work->laws
  ContactForce (*evaluate_base)(const LawBytes &base, const Contact &, ContactMemory<0> &);
  bool reads_radius;    // does it read Contact::radius?
  ShapeWork *work;

  bool stores(int) const { return true; }
  template <class Memory>
  ContactForce evaluate(const Contact &c, Memory &memory) const
  {
    ContactMemory<0> sliding = {memory.shear};
    const ContactForce force = evaluate_base(*base, c, sliding);
    memory.shear = sliding.shear;
    return force;
  }
};

// Returns the law of the settings for grains of any shape: InputError where they cannot have it.
CompiledLaw<CpuBackend> shape_law_for(const EngineSettings &, ShapeWork &);

}    // namespace lsdcd
