// A step's work for the loop of a contact law over the spheres near the wall, on any
// backend, whether results are handed back or stay where the spheres are.
#pragma once

#include "engine/narrow/found.h"
#include "engine/results/result_columns.h"
#include "engine/force/wall_force.h"

#include <cstdint>

namespace lsdcd {

// Places for contacts in the kernel: enough for nearly every sphere, and the
// sizes at which a sphere with more is done again.
constexpr int kPlaces = 8;
constexpr int kMorePlaces = 64;
constexpr int kMostPlaces = 512;

// Places for springs and records that a sphere with several contacts has of its own in place.
constexpr int kOwnPlaces = 2;

// Where a step that stays in place puts springs and records. A result has places of its own
// (law_step.h says which); one with more contacts takes all of its places from the shared ones,
// which begin at `shared`.
struct ContactPool {
  int shared, size;
  int which;             // of the two pools
  int *first, *count;    // of each sphere
  int *place;            // of each result, where there are records
  Spring *springs;
  Real *extra;
  ContactRecord *records;
};

constexpr std::uint64_t kNoSphere = std::uint64_t(1) << 32;

// What a step in place counts. The first four are of one choice or step, the others since
// the host looked.
struct StepCounts {
  std::uint32_t n_near;
  int shared_used[2];    // places, of each pool in the last step that wrote it
  int n_crowded;         // spheres whose contacts do not fit into a kernel's places
  int crowd_used;        // contacts of these
  int lost;              // spheres left out for want of memory: an error
  // kNoSphere less the index of the first sphere beyond the grid's reach, or 0: an error.
  std::uint64_t too_large;
  std::uint64_t uncertified;    // answers
  // As ascending bits: the largest overlap / radius, with 1 + the index of its sphere
  // below it, and the largest that an answer which was not certified may have missed.
  std::uint64_t deepest, uncertain;
};

// Room for crowded spheres in a step, and for the contacts of all of them.
constexpr int kCrowded = 4096;
constexpr int kCrowdContacts = 65536;

// Contacts of crowded spheres, found ahead of the law in memory that has room for them.
struct Crowd {
  int most, size;    // spheres, contacts
  int *which;        // near sphere of each
  int *first, *n;    // its contacts, n < 0: they do not fit
  ContactArrays contacts;
  Real *weight;
  struct CrowdLane *lanes;    // room to search in
};

// How a crowded sphere is told in Found::n, from its place among them and back; -1: it does
// not fit there either.
LSDCD_FN int crowded_as(int place)
{
  return place < 0 ? kOverflow : kOverflow - 1 - place;
}
LSDCD_FN int place_of_crowded(int n)
{
  return kOverflow - 1 - n;
}

struct InPlace {
  StepCounts *counts = nullptr;    // null: results are handed back
  Rows<Real> force, torque;        // added to
  Real *heat_flow = nullptr;       // added to where the law has heat
  ResultColumns result = {};
  ContactPool pool = {};
  Crowd crowd = {};
  int crowd_lanes = 0;    // > 0: the crowded spheres, shared among so many calls
};

struct LawJob {
  GridView grid = {};
  ForceSettings settings = {};
  const int *near = nullptr;    // sphere of each k; null: sphere k
  Rows<const Real> x, v, omega;
  Column<const Real> radius, mass, temperature;
  SpringsView springs = {};    // of the last step
  // Of each near sphere, where results are handed back; of one that touches nothing only its
  // n_contacts is written.
  SphereResult *result = nullptr;
  Column<Real> uncertain;    // of each; see keep_uncertain(). Null: nothing can be missed
  SphereSink sink = {};      // of the first one; each has kPlaces for contacts
  InPlace in_place = {};
  Found found = {};    // where contacts are found ahead of the law
};

// Results of near spheres are handed back, all that is known of each in one row.
inline void return_results(LawJob &job, SphereResult *result)
{
  job.result = result;
  if (!result) return;    // of no spheres
  job.uncertain = {&result->uncertain, sizeof(SphereResult) / sizeof(Real)};
}

// Where the result goes of near sphere k, the s-th that is listed as having several contacts.
LSDCD_FN std::size_t result_of_several(const LawJob &job, std::size_t s, std::size_t k)
{
  return job.in_place.counts ? job.found.result_of_several(s) : k;
}

// Sphere i, at x, for the search. `beyond`: does the law act past touch? `pull_off`: of the
// law, at a radius of 1.
LSDCD_FN Searcher searcher_of(const LawJob &job, std::size_t i, const Vec3 &x, Real radius,
                              bool beyond, Real pull_off)
{
  Searcher s = {x, radius, radius, nullptr, 0};
  if (beyond) {
    s.reach = reach_of(radius, pull_off);
    s.n_springs = job.springs.count[i];
    s.springs = job.springs.pool + (s.n_springs > 0 ? job.springs.first[i] : 0);
  }
  return s;
}
LSDCD_FN Searcher searcher_of(const LawJob &job, std::size_t i, bool beyond, Real pull_off)
{
  return searcher_of(job, i, job.x[i], job.radius[i], beyond, pull_off);
}

// The part of a job that spheres in packed arrays decide.
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
  return job;
}

}    // namespace lsdcd
