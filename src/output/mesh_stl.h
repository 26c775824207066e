// The mesh where it is, as an STL file that read_stl() and other programs read.
#pragma once

#include "mesh/wall_mesh.h"
#include "mesh/wall_pose.h"

#include <string>

namespace lsdcd {

// Binary; corners rounded to float, in the winding of the mesh. It appears whole or not at all.
// Throws InputError that names the file.
void write_mesh_stl(const std::string &path, const WallMesh &mesh, const WallPose &pose = {});

// A corner as that file has it: of floats.
Vec3 rounded_as_in_stl(const Vec3 &corner);

}    // namespace lsdcd
