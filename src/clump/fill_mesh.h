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

// Returns at most so many spheres that fill the mesh, those that add most first. The same mesh has the same spheres each time.
// There are fewer if no other one adds anything that can be measured, and none if the least radius is too large.
//
// Candidates are the largest spheres inside that touch the surface in a point, for about 6000 points all over it (Ferellec and McDowell,
// Granular Matter 12, 2010), found by shrinking balls (Ma, Bae and Choi, The Visual Computer 28, 2012). The one that adds most
// volume is taken, moved while it adds more, and so on: such greedy coverage has at least 1 - 1/e of the volume that
// the best choice of as many candidates has (Nemhauser, Wolsey and Fisher, Mathematical Programming 14, 1978). Volumes
// are counted on a lattice of about a quarter of a million points in the box of the mesh. With stick_out each sphere is larger, by as much
// as it may leave the mesh, and what it has outside counts against it.
std::vector<Ball> fill_mesh(const InsideMesh &inside, const FillSettings &settings);

}    // namespace lsdcd
