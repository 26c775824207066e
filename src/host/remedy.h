// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The words of a host in messages: its names of things, and its ways out of a problem.
#pragma once

#include "base/input_error.h"
#include "base/real.h"

#include <string>

namespace lsdcd {

// The names of a program that calls the library.
struct HostNames {
  const char *sphere = "sphere";
  const char *wall = "this wall";       // the object that the host makes of a wall
  const char *saved = "saved state";    // a wall goes on from it
  const char *margin = "margin";        // spheres may go so far past a periodic face
  const char *units = "the units of the program";
  const char *replay = "replay";      // of snapshots
  const char *record = "snapshot";    // has the spheres of a replay
  Real unset_radius = 0;              // of spheres until one is given; 0: there is none
};

// Problems for which each host has a way out of its own.
enum class Remedy {
  wrap_sooner,           // spheres go too far past a periodic face
  put_clear,             // spheres come to be in the wall
  stay_in_plane,         // a mesh pushes out of the plane z = 0
  give_radii,            // spheres have radius 0
  give_other_radii,      // spheres are too large
  set_radii,             // spheres have the radius of those that were given none
  follow_spheres,        // a mesh leaves the box
  make_room,             // springs of spheres with more than one contact have no memory
  announce_growth,       // radii grew between two choices of candidates
  begin_motion,          // a motion was stopped
  begin_servo,           // a servo was stopped
  give_velocities,       // a motion by inputs has differences for velocities
  give_displacements,    // a motion by inputs adds up velocities
  begin_replay,          // a mesh begins to move after the snapshot
  compute_on_host        // there is no engine for it in the memory that spheres are in
};

// Half a sentence for a program that calls the library.
std::string library_remedy(Remedy remedy);

// An error whose way out the host names.
struct RemedyError : InputError {
  RemedyError(const std::string &what_is_wrong, Remedy way_out) :
      InputError(what_is_wrong + "; " + library_remedy(way_out)), problem(what_is_wrong),
      remedy(way_out)
  {
  }
  std::string problem;
  Remedy remedy;
};

}    // namespace lsdcd
