// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Errors and warnings where a mesh does not go with the settings of its wall.
#pragma once

#include "wall/part/mesh_part.h"
#include "wall/spheres/host_spheres.h"

namespace lsdcd {

// Throws InputError, the same on all processes, if side in or out has no meaning for the mesh.
void check_side(const WallSpec &settings, const MeshPart &m);

// Throws InputError, the same on all processes, if a pressure would push faces to both sides.
void check_pressure(const WallSpec &settings, const MeshPart &m);

// Warns of cracks that welding leaves open.
void check_weld(Host &host, const WallSpec &settings, const MeshPart &m);

// Checks a mesh in two dimensions, where spheres feel it as it cuts the plane z = 0. Throws InputError if the mesh does not cut that plane
// or would leave it, if it has nodes, or if wear moves its vertices; warns of faces that lean in the plane. Collective.
void check_plane(Host &host, const WallSpec &settings, const MeshPart &m);

// Checks that no gap opens in a mesh that changes its shape: one opens if the vertices of a facet without area, which welding has dropped,
// move apart, or a vertex and the open edge on which it lies. Throws InputError, the same on all processes, if a mesh with nodes has such a
// facet. Warns of such facets of a mesh that wear moves, which keeps their corners, and of vertices on open edges. Called after mesh and
// surface are made.
void check_stays_closed(Host &host, const WallSpec &settings, const MeshPart &m);

// Returns the radius of the largest ball that fits in a grain of the group (length): the radius of a sphere, or the shortest half-axis of
// another grain. A mesh that goes farther in a step may leave a grain behind.
Real largest_within(const HostSpheres &spheres);

// Warns once if a mesh has gone farther in a step than `radius`, that of the largest ball, and grains are on its way. Throws InputError if
// it has gone farther than the diameter, so that it may have jumped over a grain, unless the program puts it there. Collective.
void check_way(Host &host, const WallSpec &settings, MeshPart &m, const Step &step, Real radius,
               const SpheresOnCpu &spheres);

// Warns of a surface motion that pushes faces along their normals.
void check_surface_motion(Host &host, const WallSpec &settings, const MeshPart &m);

}    // namespace lsdcd
