// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What is done in a step for all meshes of a wall whose nodes move, together.
#pragma once

#include "engine/engine.h"
#include "host/host.h"
#include "wall/surface/mesh_nodes.h"

#include <vector>

namespace lsdcd {

// Gives the nodes to the first engine of a wall, or those of the last one, which must be there still, to another. Collective.
void give_nodes(Host &host, const std::vector<MeshNodes *> &all, WallEngine *last,
                WallEngine &engine);
// Makes the grids that are due before a candidate search, and then turns the springs of spheres [0, n) with their features. Each process
// has all nodes, and comes to the same grids. Local.
void place_nodes(const std::vector<MeshNodes *> &all, WallEngine &engine, Real cutoff, int n);
// Gives the forces of the last step the range of all processes, by one message, if there are several. Collective. `failed`: the step of
// this process has failed, so that it has no forces. Then the others have none, either, and do not wait for it.
void agree_on_forces(Host &host, const std::vector<MeshNodes *> &all, bool failed);

}    // namespace lsdcd
