// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A step's work for the kernels of a contact law over the spheres near the wall, on any backend.
#pragma once

#include "engine/lists/wall_list.h"
#include "engine/results/result_columns.h"
#include "engine/results/step_counts.h"
#include "engine/step/force_settings.h"
#include "engine/step/law_bytes.h"
#include "engine/step/step_lists.h"

#include <cstdint>

namespace lsdcd {

// Contacts that a kernel has room for on its stack: enough for nearly every sphere. One with more
// takes a scratch memory, which has room for kMaxContacts.
constexpr int kContacts = 8;
constexpr int kMaxContacts = 512;

// What spheres leave in memory that they share in a step. Where one has a single contact its shear
// history and its record have the slot of its own number; with more it takes slots from `shared` on.
struct ContactPool {
  int shared, size;
  int which;             // of the two pools
  int *first, *count;    // of each sphere
  int *slot;             // first one of each near sphere, where there are records
  Spring *springs;
  Real *extra;
  ContactRecord *records;
};

// Memory for the contacts of one sphere that has many: too much for a stack. Whoever holds the lock
// has it.
struct OverflowScratch {
  int locked;
  Touch<kMaxContacts> touch, of_mesh;    // of_mesh: of one after the other, where several are near
  CornerRule<kMaxContacts> rule;
};
constexpr int kOverflowScratches = 8;    // 1 MB each

// Spheres that are near several meshes. Sphere g has slots first[g] to first[g + 1], one for each of
// these meshes in ascending order; all that is of a k is of such a slot.
struct JointSpheres {
  const MeshWork *meshes = nullptr;    // null: there are none in this job
  const int *first = nullptr;
  const int *mesh = nullptr;    // of each slot
  LawsView laws = {};
};

struct LawJob {
  GridView grid = {};
  ForceSettings settings = {};
  const int *near = nullptr;    // sphere of each k; null: sphere k
  int first_slot = 0;           // in the pool, of k = 0; read only where the wall can move
  JointSpheres joint = {};
  WallLists lists = {};    // of each k; none: cells are searched
  StridedView<const Real> x, v, omega;
  Column<const Real> radius, mass, temperature;
  SpringsView springs = {};    // of the last step

  StepCounts *counts = nullptr;
  StridedView<Real> force, torque;    // added to
  Real *heat_flow = nullptr;          // likewise, where the law has heat
  ResultColumns result = {};          // of each k
  Real *heat = nullptr;               // of each k, where the law has heat
  Real *uncertain = nullptr;    // overlap / radius that k's search may miss; null: nothing can be
  ContactPool pool = {};
  OverflowScratch *overflow = nullptr;
  StepLists step_lists = {};
};

LSDCD_FN std::size_t sphere_of(const LawJob &job, std::size_t k)
{
  return job.near ? job.near[k] : k;
}

// Sphere i at x, as the search sees it. `beyond`: does the law act beyond contact? `pull_off`: of
// the law, at a radius of 1.
LSDCD_FN QuerySphere query_sphere_of(const LawJob &job, std::size_t i, const Vec3 &x, Real radius,
                                     bool beyond, Real pull_off)
{
  QuerySphere s = {x, radius, radius, nullptr, 0};
  if (beyond) {
    s.cutoff = cutoff_of(radius, pull_off);
    s.n_springs = job.springs.count[i];
    s.springs = job.springs.pool + (s.n_springs > 0 ? job.springs.first[i] : 0);
  }
  return s;
}

// The same job from slot `first` on.
inline LawJob from_slot(LawJob job, std::size_t first)
{
  job.near += first;
  job.first_slot = static_cast<int>(first);
  if (job.lists.n) job.lists = job.lists.from(first);
  job.result = job.result.from(first);
  if (job.heat) job.heat += first;
  if (job.uncertain) job.uncertain += first;
  if (job.pool.slot) job.pool.slot += first;
  return job;
}

// The part of a job that the spheres decide.
inline LawJob job_of(const GridView &grid, const ForceSettings &settings, const Spheres &spheres)
{
  LawJob job;
  job.grid = grid;
  job.settings = settings;
  job.x = spheres.x;
  job.v = spheres.v;
  job.omega = spheres.omega;
  job.radius = {spheres.radius};
  job.mass = {spheres.mass};
  job.temperature = {spheres.temperature};
  job.force = spheres.force;
  job.torque = spheres.torque;
  job.heat_flow = spheres.heat_flow;
  return job;
}

}    // namespace lsdcd
