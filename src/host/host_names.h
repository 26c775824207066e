// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The words of a host in messages.
#pragma once

#include "base/real.h"

namespace lsdcd {

// The names of things, and what to do about problems for which each host has its own way. Those of a program that calls
// the library stand here; another host replaces them.
struct HostNames {
  const char *sphere = "sphere";
  const char *wall = "this wall";       // the object that the host makes of a wall
  const char *saved = "saved state";    // a wall goes on from it
  const char *margin = "margin";        // spheres may go so far past a periodic face
  const char *units = "the units of the program";
  const char *replay = "replay";      // of snapshots
  const char *record = "snapshot";    // has the spheres of a replay
  Real unset_radius = 0;              // of spheres until one is given; 0: there is none

  // Halves of sentences: what to do where

  // spheres go too far past a periodic face
  const char *wrap_sooner = "wrap spheres sooner, or give a larger margin";
  // spheres come to be in the wall
  const char *put_clear = "put spheres a radius away from the mesh";
  // a mesh pushes out of the plane z = 0
  const char *stay_in_plane = "spheres lose what the faces push along z";
  // spheres have radius 0
  const char *give_radii = "give radii";
  // spheres are too large
  const char *give_other_radii = "give `radius` in the units of the mesh";
  // spheres have the radius of those that were given none
  const char *set_radii = "give `radius` in the units of the mesh";
  // a mesh leaves the box
  const char *follow_spheres = "leave out its bounds";
  // springs of spheres with more than one contact have no memory
  const char *make_room = "give a smaller reach, so that they are selected more often, or restore "
                          "a saved state, which makes room for them";
  // radii grew between two choices of candidates
  const char *announce_growth = "set `changed` in a step with different radii";
  // a motion was stopped
  const char *begin_motion = "start another motion, which begins where the mesh is";
  // a servo was stopped
  const char *begin_servo = "give another servo, which goes on from there";
  // a motion by inputs has differences for velocities
  const char *give_velocities = "give velocities as well";
  // a motion by inputs adds up velocities
  const char *give_displacements = "give displacements as well";
  // a mesh begins to move after the snapshot
  const char *begin_replay = "make the wall with the step in which the motion began";
  // there is no engine for the memory that spheres are in
  const char *compute_on_cpu = "make the wall with `device` cpu";
};

}    // namespace lsdcd
