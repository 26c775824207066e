// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What an engine is made for, and what a step is told.
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

// Where a host has the arrays of its spheres: in double in the memory of the engine's backend, in other memory (of the CPU
// while the engine is on a GPU), or in float in the memory of the backend.
enum class HostArrays { in_place, apart, in_float };

// Meshes that move apart, of one wall.
constexpr int kMaxMeshes = 32;

struct EngineSettings {
  LawTable laws = ContactLaw();
  Corner corner = Corner::blend;
  Side side = Side::both;
  int meshes = 1;           // that move apart; with more than one `moves` counts as true
  SurfaceMotion surface;    // of each mesh, in the plane of each contact
  bool moves = false;       // set_pose() or StepSettings::surface will be used
  bool contacts = false;    // keep what every contact does to the wall
  bool bodies = false;      // StepSettings::mobility will be used; contacts are kept, too
  bool nodes = false;       // WallEngine::nodes() will be used; contacts are kept, too
  WearModel wear = WearModel::none;    // where contacts are kept
  bool energy_places = false;          // where laws book energy, EnergyRecord::dissipated is wanted
  Real friction_heat =
      0;    // where laws book energy and have heat: the share of what the slider loses that is heat of the sphere
  Real impact_speed = 0;    // impacts that are faster are recorded (length/time); 0: none are
  Real velocity_unit =
      1;    // a force times time over a mass, in the unit of velocity: energies of impacts are over it
  HostArrays arrays = HostArrays::in_place;
  Device device = Device::automatic;
  int device_rank = 0;    // which of the GPUs this process takes (node-local rank, wrapped)
  HostNames names;        // for errors

  bool records_energy() const { return energy_places || impact_speed > 0 || law().keeps_losses; }
  // Returns the first law of the table: the only one, or the sub-models of all.
  ContactLaw &law() { return laws.laws.front(); }
  const ContactLaw &law() const { return laws.laws.front(); }
};

// Are candidates sorted into slots, by mesh and by kind of sphere?
inline bool uses_slots(const EngineSettings &s)
{
  return s.meshes > 1 || s.laws.kinds > 1;
}

struct StepSettings {
  std::int64_t number = 0;       // of the step, for StepDiagnostics
  Real dt = 0;                   // time
  bool update_history = true;    // false in setup: springs act but do not move
  bool looks = false;            // nothing of a contact is stored, not even what a setup stores
  bool synchronous =
      false;    // velocities are of the time of the places, as in setup; else of half a step before
  bool per_sphere = false;      // bring StepResults::touching()
  bool totals = false;          // they will be asked for before the next step: summed with this one
  bool contacts = true;         // bring the contacts of settings.contacts
  Real wall_temperature = 0;    // where the law has heat
  // For each mesh, in place of wall_temperature and of the settings' surface; valid until collect().
  const Real *mesh_temperature = nullptr;
  const SurfaceMotion *surface = nullptr;
  // For each mesh, how it gives way where it is a rigid body, and 0 where it is none; valid until collect().
  const Mobility *mobility = nullptr;
  // For each mesh, by how far wear has moved its vertices since the last step (length), none where it has not; read only where
  // laws book energy; valid until collect(). Null: no mesh has moved so.
  const std::vector<Vec3> *receded = nullptr;
};

// When a step does its work, and where.
enum class When {
  in_turn,    // after the host's work on its stream; on a CPU collect() does it
  // In place on a GPU: at once, on a stream of its own, after the host's work on its stream by
  // begin(). collect() adds forces and torques.
  beside,
  // In place on a GPU: at once, on a stream of its own; submit() adds forces and torques, after the host's work.
  beside_adding_early,
};

}    // namespace lsdcd
