// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The arguments of a step's kernels, on any backend, and what kernels count and store beside their results.
#pragma once

#include "backend/atomic.h"
#include "engine/grains.h"
#include "engine/results/result_columns.h"
#include "engine/results/step_counts.h"
#include "engine/step/compiled_law.h"
#include "engine/step/contact_forces.h"

#include <cstdint>

namespace lsdcd {

// Lists of indices into what the step is over, and how many each has. Null: there is no such list.
struct WorkLists {
  // Items for the second kernel of this step: fast_path() has returned false, or they need a list.
  int *found = nullptr, *n_found = nullptr;
  int *n_found_next = nullptr;    // of the next step, to be cleared
  // Items with more than one contact in the last step, and in this one. Most have them for many steps, so that
  // the step begins with these.
  int *last = nullptr, *n_last = nullptr;
  int *next = nullptr, *n_next = nullptr;
  // The newest step that begins with an item, for each item, and the number of this step.
  int *listed_in = nullptr, step = 0;
  void *memory = nullptr;    // of threads on the general path
  std::size_t memory_bytes = 0;
};

// Contacts that a kernel has room for on its stack: enough for nearly every sphere. One with more
// takes a scratch memory, which has room for kMaxContacts.
constexpr int kContacts = 8;

// Memory of a thread on the general path, with one mesh and with several. A CPU has it on the stack. A GPU sets the stack
// of a kernel aside for all threads that it can hold, of which few take that path, so it has this for kMostGeneral
// threads at most instead.
struct GeneralMemory {
  CornerRule<kContacts> rule;
};
struct MultiMeshMemory {
  CornerRule<kContacts> rule;
  WeightedContacts<kContacts> of_mesh;    // of one mesh after the other
};
constexpr unsigned kStepBlock = 128;    // threads of a block
constexpr std::size_t kMostGeneral = 528 * kStepBlock, kFewGeneral = 66 * kStepBlock;

// Memory for the springs and contacts of a step. A sphere with a single contact has the place of its own number; one
// with more contacts reserves places from `shared` on.
struct ContactPool {
  int shared, size;
  int which;             // of the two pools
  int *first, *count;    // of each sphere
  int *first_contact;    // of each candidate, where contacts are kept
  Spring *springs;
  Real *extra;
  StepContact *contacts;
};

// Memory for the contacts of one sphere that has many: too much for a stack. Whoever holds the lock
// has it.
struct OverflowScratch {
  int locked;
  WeightedContacts<kMaxContacts> contacts,
      of_mesh;    // of one mesh after the other
  CornerRule<kMaxContacts> rule;
};
constexpr int kOverflowScratches = 8;    // 1 MB each

// Candidates of more than one mesh. Sphere g owns slots first[g] .. first[g + 1] - 1, one per mesh, ascending. In
// this job k is a slot, not a sphere.
struct MultiMeshSpheres {
  const MeshWork *meshes = nullptr;    // null: there are none in this job
  const int *first = nullptr;
  const int *mesh = nullptr;    // of each slot
  LawsView laws = {};
};

struct StepJob {
  GridView grid = {};
  ForceSettings settings = {};
  const int *candidates = nullptr;    // sphere of each k
  int first_slot =
      0;    // in the pool, of k = 0; read only by laws for walls that move or have several meshes
  MultiMeshSpheres multi_mesh = {};
  FeatureLists lists = {};    // of each k; none: cells are searched
  StridedView<const Real> x, v, omega;
  Column<const Real> radius, mass, temperature;
  SpringsView springs = {};    // of the last step

  StepCounts *counts = nullptr;
  std::uint64_t step = 0;             // since counts were cleared
  StridedView<Real> force, torque;    // added to
  Real *heat_flow = nullptr;          // added to, where the law has heat
  ResultColumns result = {};          // of each k
  Real *heat = nullptr;               // of each k, where the law has heat
  EnergyRows *energy = nullptr;       // of each k with is_booked, where the law books energy
  char *is_booked = nullptr;
  Real *uncertain = nullptr;    // overlap / radius that k's search may miss; null: nothing can be
  ContactPool pool = {};
  OverflowScratch *overflow = nullptr;
  WorkLists work_lists = {};
  EnergyRecordList records = {};    // where the law has them
  // See EngineSettings; 0 where no time passes. Read only where the law books energy.
  Real friction_heat = 0;
};

LSDCD_FN std::size_t sphere_of(const StepJob &job, std::size_t k)
{
  return job.candidates[k];
}

// Returns the query for sphere i at x. `beyond`: does the law act beyond contact? `pull_off`: of the law, at a radius of
// 1.
LSDCD_FN QuerySphere query_sphere_of(const StepJob &job, std::size_t i, const Vec3 &x, Real radius,
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
inline StepJob from_slot(StepJob job, std::size_t first)
{
  job.candidates += first;
  job.first_slot = static_cast<int>(first);
  if (job.lists.n) job.lists = job.lists.from(first);
  job.result = job.result.from(first);
  if (job.heat) job.heat += first;
  if (job.energy) {
    job.energy += first;
    job.is_booked += first;
  }
  if (job.uncertain) job.uncertain += first;
  if (job.pool.first_contact) job.pool.first_contact += first;
  return job;
}

// Returns the part of a job that the spheres decide.
inline StepJob job_of(const GridView &grid, const ForceSettings &settings, const Spheres &spheres)
{
  StepJob job;
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

// Sphere i feels the wall from as far as `cutoff`: an error where the grid does not go there.
LSDCD_FN void check_cutoff(const StepJob &job, std::size_t i, Real cutoff)
{
  if (cutoff > job.grid.cutoff) raise_to(&job.counts->too_large, kNoSphere - i);
}

// Notes overlap / radius of sphere i at a mesh. Returns whether it is the deepest so far.
LSDCD_FN bool record_overlap(const StepJob &job, std::size_t i, std::uint32_t mesh, Real ratio)
{
  using Deepest = DeepestOverlap;
  if (!(ratio > 0)) return false;
  const std::uint64_t begin = Deepest::ratio(ratio);
  if (!raise_to(&job.counts->deepest, begin | std::uint64_t(mesh) << Deepest::kMeshAt | (i + 1)))
    return false;
  raise_to(&job.counts->deepest_step, begin | job.step);
  return true;
}

// Counts a candidate k whose search may have missed a contact; `uncertain`: the overlap of the deepest one, 0 if
// none. Its ratio to the radius is stored, as radii may be elsewhere when it is read.
LSDCD_FN void count_uncertain(const StepJob &job, std::size_t k, Real uncertain, Real radius)
{
  if (!job.uncertain) return;
  const Real ratio = uncertain / radius;
  job.uncertain[k] = ratio;
  if (!(ratio > 0)) return;
  count_one(&job.counts->uncertified);
  raise_to(&job.counts->uncertain, ascending_bits(static_cast<float>(ratio)));
}

// Candidate k, sphere i, touches nothing. Counts of springs that are 0 already are not written.
LSDCD_FN void put_no_contact(const StepJob &job, std::size_t k, std::size_t i)
{
  job.result.n_contacts[k] = 0;
  int *n_springs = job.pool.count;
  if (n_springs && job.settings.stores && n_springs[i] != 0) n_springs[i] = 0;
}

// There is no memory for the contacts of candidate k, sphere i: an error once the CPU reads the counts.
// `counter`: of the memory that was used up. Until then the sphere has no springs, as its old ones are in the
// other pool.
LSDCD_FN void does_not_fit(const StepJob &job, std::size_t k, std::size_t i, int &counter)
{
  fetch_add(&counter, 1);
  put_no_contact(job, k, i);
}

// Clears the counter of places of the other pool: the next step writes there, if this step moves springs.
LSDCD_FN void clear_next(const StepJob &job)
{
  if (job.settings.stores) job.counts->shared_used[1 - job.pool.which] = 0;
}

}    // namespace lsdcd
