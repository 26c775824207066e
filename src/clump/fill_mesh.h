// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Fills a mesh with overlapping spheres.
#pragma once

#include "clump/ball.h"
#include "clump/inside_mesh.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

struct FillSettings {
  std::size_t most = 1;     // spheres
  Real least_radius = 0;    // length
  Real stick_out = 0;       // by how much of its radius a sphere may leave the mesh; 0 to below 1
};

// Returns at most so many spheres that fill the mesh, the first ones adding most, and the same on all machines for the same mesh. There are
// fewer if no other one adds anything that can be measured, and none if the least radius is too large.
//
// Candidates are the largest spheres inside that touch the surface in a point, for points all over it (Ferellec and McDowell, Granular
// Matter 12, 2010), found as the shrinking balls of Ma, Bae and Choi (The Visual Computer 28, 2012). Of these the one that
// adds most volume is taken, moved while it adds more, and so on: greedy coverage, whose volume is at least 1 - 1/e of what
// the best choice of as many candidates has (Nemhauser, Wolsey and Fisher, Mathematical Programming 14, 1978). Volumes are counted on a lattice of
// about half a million points in the box of the mesh. With stick_out, a sphere is as much larger that it may leave the
// mesh, and adds what it covers inside less what it covers outside.
std::vector<Ball> fill_mesh(const InsideMesh &inside, const FillSettings &settings);

}    // namespace lsdcd
