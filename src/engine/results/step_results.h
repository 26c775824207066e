// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The results of a step: sums, touching spheres, contacts, and counts.
#pragma once

#include "base/vec3.h"
#include "engine/results/sum_unit.h"
#include "geometry/feature_code.h"
#include "law/force_parts.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

// What must be known of the forces of contacts on the nodes of a mesh before they are added.
struct NodeForceRange {
  SummandRange shares;    // components of the shares of contacts; a node has one for each contact
  // kNoSphere less the index of the first sphere with a component that is not finite, or 0.
  std::uint64_t not_finite;
};

// Sums over the spheres of the last step on this process.
struct WallTotals {
  Real energy = 0;            // elastic energy in normal overlaps and tangential springs
  Vec3 force = {0, 0, 0};     // on the mesh
  Vec3 torque = {0, 0, 0};    // on the mesh, about the origin
  std::int64_t contacts = 0;
  std::int64_t uncertified = 0;       // spheres whose answer was not certified exact
  Real largest_uncertain = 0;         // overlap / radius of the deepest contact they may miss
  Real largest_overlap_ratio = 0;     // overlap / radius
  int largest_overlap_sphere = -1;    // index in Spheres, -1 if none touches
  int pad = 0;                        // keeps the struct free of indeterminate bytes
};

// A sphere with a contact, with its numbers as the step has read them, and what its contacts did. Contacts that bear nothing count,
// too.
struct TouchingSphere {
  Vec3 x;
  Real radius, mass;
  Vec3 force;    // sum over its contacts, on the sphere
  Vec3 point;    // mean contact point on the wall, weighted by normal force
  Real heat;     // power into the sphere; 0 where the law has no heat
  int sphere;    // its index in Spheres
  int type;      // 0 if laws do not differ by it
  int n_contacts;
  int pad;    // keeps the struct free of indeterminate bytes
};

// The effect of one contact on the wall in one step.
struct StepContact {
  FeatureCode feature;
  std::uint32_t mesh;    // number in the wall
  Real normal;           // force on the wall, > 0 if the sphere presses
  Real shear;            // size of the force along the wall
  Real wear_power;       // see law/wear.h; 0 without wear
  // The following are in the frame of the mesh.
  Vec3 force;    // on the wall
  Vec3 arm;      // from the closest point to the sphere's centre
};

// The rows of the energy balance in a step. The rows from `damping` on say what becomes of the work; > 0: it is lost.
enum class EnergyRow {
  work,       // of grains and wall on the contacts, by all forces and torques as they are applied
  drive,      // of the wall on the grains, by its motion and that of its surface
  damping,    // dashpots
  slider,     // friction where its limit cuts the spring
  rolling,    // rolling and twisting resistance: dashpot and slider
  twisting,
  adhesion,    // of surfaces that jump into contact, less that of surfaces that let go
  plastic,     // of contacts that yield, and on the adhesive branch of those that have
  lever_arms,    // a wall that turns sees friction at the arm of the radius, the sphere at that of the law
  stiffness,         // springs whose stiffness changes while they are stretched
  turned_springs,    // springs that are transferred or turned
  inserted,          // of contacts that begin in overlap, < 0
  wear,              // as wear moves the wall away from spheres
  held,              // elastic energy now
  seen               // elastic energy of the last step, for contacts that this step has found
};
constexpr int kEnergyRows = static_cast<int>(EnergyRow::seen) + 1;

struct EnergyRows {
  Real of[kEnergyRows] = {};

  LSDCD_FN Real &operator[](EnergyRow row) { return of[static_cast<int>(row)]; }
  LSDCD_FN Real operator[](EnergyRow row) const { return of[static_cast<int>(row)]; }
  LSDCD_FN void add(const EnergyRows &other)
  {
    for (int row = 0; row < kEnergyRows; row++) of[row] += other.of[row];
  }
};

// Returns the energy that all causes dissipate.
LSDCD_FN Real dissipated(const EnergyRows &rows)
{
  return rows[EnergyRow::damping] + rows[EnergyRow::slider] + rows[EnergyRow::rolling] +
         rows[EnergyRow::twisting] + rows[EnergyRow::adhesion] + rows[EnergyRow::plastic];
}

// The energy that is dissipated at a contact of this step, or of the last one.
struct EnergyRecord {
  FeatureCode feature;
  std::uint32_t mesh;    // number in the wall
  Real dissipated;       // energy; 0 if no energy is recorded
  // For a contact that begins by an impact: its energy m v^2/2, and the speed v along the normal. Otherwise 0.
  Real impact, speed;
};
static_assert(kLossCauses ==
                  static_cast<int>(EnergyRow::plastic) - static_cast<int>(EnergyRow::damping) + 1,
              "causes are those of dissipated()");

// A contact of the last step that has ended in this one.
struct EndedContact {
  int sphere;    // its index in Spheres
  int number;    // among those of the sphere
  std::uint32_t mesh;
  int pad;       // keeps the struct free of indeterminate bytes
  Vec3 point;    // of the wall, its place in the last step, in the frame of the mesh
  KeptLosses losses;
};

struct EnergyRecords {
  const EnergyRecord *at = nullptr;
  int n = 0;
};

// Counts of the steps since the host last read them.
struct StepDiagnostics {
  Real deepest = 0;                    // largest overlap / radius
  int deepest_sphere = -1;             // its index in the step in which it occurred
  Real deepest_radius = 0;             // its radius (length), of a host with arrays in float
  int deepest_mesh = 0;                // number in the wall
  std::uint32_t deepest_meshes = 0;    // a bit for each mesh that this sphere touched then
  std::int64_t deepest_step = 0;       // StepSettings::number
  std::int64_t uncertified = 0;
  Real uncertain = 0;    // overlap / radius of the deepest contact that answers may have missed
  // The largest overlap of a grain that is no sphere, divided by the radius of curvature of the grain's shadow across the fold or edge
  // there, if it is more than the grain's least radius of curvature; the index of the grain; and that least radius.
  Real sharpest = 0, sharpest_curvature = 0;
  int sharpest_grain = -1;
  // The numbers of neighbour lists that were made, of features in them, and of searches of cells for spheres without a list. All are 0
  // if cells list the nearest primitives.
  std::int64_t lists = 0, listed = 0, by_cells = 0;
};

// The results of the last step on this process. They stay until the next collect().
class StepResults {
 public:
  virtual ~StepResults() = default;

  // Returns the sums over all meshes.
  virtual const WallTotals &totals() = 0;
  // Returns the sums of one mesh, without largest_overlap_sphere.
  virtual WallTotals mesh_totals(int mesh) = 0;
  // Returns the energy rows of one mesh, if the law keeps_forces. After a setup only `held` and `seen` are set.
  virtual EnergyRows energy(int mesh) = 0;
  // Returns the records that energy_places and impact_speed of EngineSettings ask for, from an engine on a CPU.
  virtual EnergyRecords energy_records() const = 0;
  // Returns the spheres with a contact, after a step with per_sphere.
  const std::vector<TouchingSphere> &touching() const { return touching_; }
  int n_touching() const { return static_cast<int>(touching_.size()); }
  // Returns the contacts, if settings.contacts and step.contacts are set: first those of touching()[0], then of touching()[1] and so
  // on.
  const std::vector<StepContact> &contacts() const { return contacts_; }
  int n_contacts() const { return static_cast<int>(contacts_.size()); }
  // Return what each of these contacts dissipates, and the contacts that the step has ended, sphere after sphere. Both only if laws
  // keep losses.
  const std::vector<KeptLosses> &losses() const { return losses_; }
  const std::vector<EndedContact> &ended() const { return ended_; }

 protected:
  std::vector<TouchingSphere> touching_;
  std::vector<StepContact> contacts_;
  std::vector<KeptLosses> losses_;
  std::vector<EndedContact> ended_;
};

}    // namespace lsdcd
