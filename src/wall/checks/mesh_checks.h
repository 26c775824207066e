// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Errors and warnings where a mesh does not go with the settings of its wall.
#pragma once

#include "wall/part/mesh_part.h"
#include "wall/spheres/host_spheres.h"

namespace lsdcd {

// Throws InputError, the same on all processes, where side in or out has no meaning for the mesh.
void check_side(const WallSpec &settings, const MeshPart &m);

// Throws InputError, the same on all processes, where a pressure would push faces to both sides.
void check_pressure(const WallSpec &settings, const MeshPart &m);

// Warns of cracks that welding leaves open.
void check_weld(Host &host, const WallSpec &settings, const MeshPart &m);

// In two dimensions spheres feel the mesh where it cuts the plane z = 0. Throws InputError where it
// does not cut it, where it has nodes or wear moves its vertices, and where it would leave that plane; warns of faces that lean there.
// Collective.
void check_plane(Host &host, const WallSpec &settings, const MeshPart &m);

// A gap opens where vertices of a facet without area, which welding has dropped, or on the open edge of another move apart.
// Throws InputError, the same on all processes, where a mesh with nodes has such a facet; warns of those of a mesh
// that wear moves, which keeps their corners, and of vertices on open edges. After both are made.
void check_stays_closed(Host &host, const WallSpec &settings, const MeshPart &m);

// Returns the radius of the largest ball that is in a grain of the group: of a sphere its own, of another grain its shortest
// half-axis (length). A mesh that goes farther in a step may leave a grain behind.
Real largest_within(const HostSpheres &spheres);

// Warns once where a mesh has gone farther in a step than `radius`, that of the largest ball, and grains are where it
// went. Throws InputError where it has gone farther than the diameter, as it may have jumped over one, and it is not the
// program that puts it there. Collective.
void check_way(Host &host, const WallSpec &settings, MeshPart &m, const Step &step, Real radius,
               const SpheresOnCpu &spheres);

// Warns of a surface motion that pushes faces along their normals.
void check_surface_motion(Host &host, const WallSpec &settings, const MeshPart &m);

}    // namespace lsdcd
