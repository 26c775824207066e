// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The settings of an engine, and those of a step.
#pragma once

#include "host/host_names.h"
#include "law/contact_law.h"
#include "law/law_table.h"
#include "law/wear.h"
#include "motion/surface_motion.h"
#include "rigid/mobility.h"

#include <cstdint>

namespace lsdcd {

enum class Corner { blend, sum };
enum class Side { both, in, out };    // in the order of the keyword's words
enum class Device { automatic, cpu, cuda };

// Where a host has the arrays of its spheres: in double in the memory of the engine's backend; in other memory (of the CPU
// while the engine is on a GPU); or in float in the memory of the backend.
enum class HostArrays { in_place, apart, in_float };

// The largest number of meshes in one wall that move independently.
constexpr int kMaxMeshes = 32;

struct EngineSettings {
  LawTable laws = ContactLaw();
  Corner corner = Corner::blend;
  Side side = Side::both;
  int meshes = 1;           // that move independently; if more than one, `moves` counts as true
  SurfaceMotion surface;    // of each mesh, in the plane of each contact
  bool moves = false;       // set_pose() or StepSettings::surface will be used
  bool contacts = false;    // keep what every contact does to the wall?
  bool bodies = false;      // StepSettings::mobility will be used; contacts are kept, too
  bool nodes = false;       // WallEngine::nodes() will be used; contacts are kept, too
  WearModel wear = WearModel::none;    // read if contacts are kept
  OkaWear oka;                         // read if `wear` is oka
  bool energy_places = false;          // EnergyRecord::dissipated is wanted, if laws record energy
  Real friction_heat =
      0;    // if laws record energy and have heat: the share of the slider's losses that heats the sphere
  Real impact_speed = 0;    // impacts that are faster are recorded (length/time); 0: none are
  Real velocity_unit =
      1;    // force times time over mass, in the unit of velocity; divides energies of impacts
  HostArrays arrays = HostArrays::in_place;
  Device device = Device::automatic;
  int device_rank = 0;    // which of the GPUs this process takes (node-local rank, wrapped)
  HostNames names;        // for errors

  bool wears_by_impact() const { return wear == WearModel::oka; }
  // Returns whether a step looks at contacts that begin, or writes what contacts dissipate.
  bool records_energy() const
  {
    return energy_places || impact_speed > 0 || law().keeps_losses || wears_by_impact();
  }
  // Returns the first law of the table. It is the only one, or has the sub-models of all.
  ContactLaw &law() { return laws.laws.front(); }
  const ContactLaw &law() const { return laws.laws.front(); }
};

// Returns whether candidates are sorted into candidate-mesh pairs (slots), by mesh and by kind of sphere.
inline bool uses_slots(const EngineSettings &s)
{
  return s.meshes > 1 || s.laws.kinds > 1;
}

struct StepSettings {
  std::int64_t number = 0;       // number of the step, for StepDiagnostics
  Real dt = 0;                   // time
  bool update_history = true;    // false in setup: springs act but do not move
  bool looks = false;            // nothing of a contact is stored, not even what a setup stores
  bool synchronous =
      false;    // velocities are of the time of the places, as in setup; else of half a step before
  bool per_sphere = false;      // bring StepResults::touching()
  bool totals = false;          // totals will be asked for: they are summed with this step
  bool contacts = true;         // bring the contacts of settings.contacts
  Real wall_temperature = 0;    // read if the law has heat
  // For each mesh, used instead of wall_temperature and of the settings' surface; valid until collect().
  const Real *mesh_temperature = nullptr;
  const SurfaceMotion *surface = nullptr;
  // For each mesh, the mobility if it is a rigid body, and 0 if it is none; valid until collect().
  const Mobility *mobility = nullptr;
  // For each mesh, how far wear has moved its vertices since the last step (length); empty if wear has moved none. Read only
  // if laws record energy; valid until collect(). Null: wear has moved no mesh.
  const std::vector<Vec3> *receded = nullptr;
};

// When a step does its work, and where.
enum class When {
  in_turn,    // after the host's work on its stream; on a CPU collect() does it
  // In place on a GPU: at once, on a stream of its own, after the work that the host's stream has at begin(). collect() adds
  // forces and torques.
  beside,
  // In place on a GPU: at once, on a stream of its own. submit() adds forces and torques, after the host's work.
  beside_adding_early,
};

}    // namespace lsdcd
