// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The arguments of a step's kernels, on any backend, and what kernels count and store in addition to their results.
#pragma once

#include "backend/atomic.h"
#include "engine/grains.h"
#include "engine/results/result_columns.h"
#include "engine/results/step_counts.h"
#include "engine/step/compiled_law.h"
#include "engine/step/contact_forces.h"

#include <cstdint>

namespace lsdcd {

// Lists of indices of the step's items, and their lengths. Null: there is no such list.
struct WorkLists {
  // Items for the second kernel of this step: fast_path() has returned false for them, or they need a list.
  int *found = nullptr, *n_found = nullptr;
  int *n_found_next = nullptr;    // of the next step, to be cleared
  // Items with more than one contact, in the last step and in this one. Most of them stay so for many steps, so the step
  // begins with them.
  int *last = nullptr, *n_last = nullptr;
  int *next = nullptr, *n_next = nullptr;
  // For each item the newest step that begins with it, and the number of this step.
  int *listed_in = nullptr, step = 0;
  void *memory = nullptr;    // of threads on the general path
  std::size_t memory_bytes = 0;
};

// The number of contacts for which a kernel has space on its stack: enough for nearly every sphere. A sphere with more
// takes a scratch memory, which has space for kMaxContacts.
constexpr int kContacts = 8;

// Memory of a thread on the general path, with one mesh and with several. A CPU has it on the stack. A GPU reserves the
// stack of a kernel for all threads that it can hold, of which few take that path; therefore it has this memory
// separately, for at most kMostGeneral threads.
struct GeneralMemory {
  CornerRule<kContacts> rule;
};
struct MultiMeshMemory {
  CornerRule<kContacts> rule;
  WeightedContacts<kContacts> of_mesh;    // of one mesh after the other
};
constexpr unsigned kStepBlock = 128;    // threads of a block
constexpr std::size_t kMostGeneral = 528 * kStepBlock, kFewGeneral = 66 * kStepBlock;

// Memory for the springs and contacts of a step. A sphere with a single contact has the place of its own number; a sphere
// with more contacts reserves places from `shared` on.
struct ContactPool {
  int shared, size;
  int which;             // index of the pool, 0 or 1
  int *first, *count;    // of each sphere
  int *first_contact;    // of each candidate, if contacts are kept
  Spring *springs;
  Real *extra;
  StepContact *contacts;
};

// Memory for the contacts of one sphere that has too many for a stack. It belongs to the thread that holds the lock.
struct OverflowScratch {
  int locked;
  WeightedContacts<kMaxContacts> contacts,
      of_mesh;    // of one mesh after the other
  CornerRule<kMaxContacts> rule;
};
constexpr int kOverflowScratches = 8;    // 1 MB each

// Candidates of more than one mesh. Sphere g has the candidate-mesh pairs (slots) first[g] .. first[g + 1] - 1, one for
// each mesh, ascending. In a job with these, k is a candidate-mesh pair and not a sphere.
struct MultiMeshSpheres {
  const MeshWork *meshes = nullptr;    // null: there are none in this job
  const int *first = nullptr;
  const int *mesh = nullptr;    // of each candidate-mesh pair
  LawsView laws = {};
};

struct StepJob {
  GridView grid = {};
  ForceSettings settings = {};
  const int *candidates = nullptr;    // sphere of each k
  int first_slot =
      0;    // in the pool, of k = 0; read only by laws for walls that move or have several meshes
  MultiMeshSpheres multi_mesh = {};
  FeatureLists lists = {};    // of each k; empty: cells are searched
  StridedView<const Real> x, v, omega;
  Column<const Real> radius, mass, temperature;
  SpringsView springs = {};    // of the last step

  StepCounts *counts = nullptr;
  std::uint64_t step = 0;             // since counts were cleared
  StridedView<Real> force, torque;    // added to
  Real *heat_flow = nullptr;          // added to, if the law has heat
  ResultColumns result = {};          // of each k
  Real *heat = nullptr;               // of each k, if the law has heat
  EnergyRows *energy = nullptr;       // of each k with is_booked, if the law records energy
  char *is_booked = nullptr;
  Real *uncertain = nullptr;    // overlap / radius that k's search may miss; null: it can miss none
  ContactPool pool = {};
  OverflowScratch *overflow = nullptr;
  WorkLists work_lists = {};
  EnergyRecordList records = {};    // if the law has them
  // See EngineSettings; 0 if no time passes. Read only if the law records energy.
  Real friction_heat = 0;
};

LSDCD_FN std::size_t sphere_of(const StepJob &job, std::size_t k)
{
  return job.candidates[k];
}

// Returns the query for sphere i at x.
template <class Law>
LSDCD_FN QuerySphere query_sphere_of(const StepJob &job, [[maybe_unused]] const Law &law,
                                     [[maybe_unused]] std::size_t i, const Vec3 &x, Real radius)
{
  QuerySphere s = {x, radius, radius, nullptr, 0};
  if constexpr (Law::kBeyondContact) {
    Contact c = {};
    c.radius = radius;
    s.cutoff = radius + law.gap(c);
    if (!law.needs_touch()) s.radius = s.cutoff;
    s.n_springs = job.springs.count[i];
    s.springs = job.springs.pool + (s.n_springs > 0 ? job.springs.first[i] : 0);
  }
  return s;
}

// Returns the same job from candidate-mesh pair `first` on.
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

// Returns the part of a job that depends on the spheres.
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

// Notes an error if sphere i, which feels the wall from a distance of `cutoff`, reaches beyond the grid.
LSDCD_FN void check_cutoff(const StepJob &job, std::size_t i, Real cutoff)
{
  if (cutoff > job.grid.cutoff) raise_to(&job.counts->too_large, kNoSphere - i);
}

// Notes the overlap / radius of sphere i at a mesh. Returns whether it is the deepest so far.
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

// Counts candidate k, whose search may have missed a contact. `uncertain`: the overlap of the deepest such contact, 0 if
// there is none. Its ratio to the radius is stored, because radii may be elsewhere when it is read.
LSDCD_FN void count_uncertain(const StepJob &job, std::size_t k, Real uncertain, Real radius)
{
  if (!job.uncertain) return;
  const Real ratio = uncertain / radius;
  job.uncertain[k] = ratio;
  if (!(ratio > 0)) return;
  count_one(&job.counts->uncertified);
  raise_to(&job.counts->uncertain, ascending_bits(static_cast<float>(ratio)));
}

// Stores that candidate k, sphere i, touches nothing. Counts of springs that are 0 already are not written.
LSDCD_FN void put_no_contact(const StepJob &job, std::size_t k, std::size_t i)
{
  job.result.n_contacts[k] = 0;
  int *n_springs = job.pool.count;
  if (n_springs && job.settings.stores && n_springs[i] != 0) n_springs[i] = 0;
}

// Notes that there is no memory for the contacts of candidate k, sphere i, which is an error once the CPU reads the
// counts. `counter`: that of the memory that was used up. Until then the sphere has no springs, because its old ones are
// in the other pool.
LSDCD_FN void does_not_fit(const StepJob &job, std::size_t k, std::size_t i, int &counter)
{
  fetch_add(&counter, 1);
  put_no_contact(job, k, i);
}

// Clears the counter of places of the other pool, to which the next step writes if this step moves springs.
LSDCD_FN void clear_next(const StepJob &job)
{
  if (job.settings.stores) job.counts->shared_used[1 - job.pool.which] = 0;
}

}    // namespace lsdcd
