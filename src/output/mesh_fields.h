// Numbers per triangle, as a file that ParaView and other VTK programs read.
#pragma once

#include "mesh/wall_pose.h"
#include "output/wall_loads.h"

#include <string>
#include <vector>

namespace lsdcd {

struct FaceField {
  std::string name;
  std::vector<double> value;    // one per face of the mesh
};

// Stresses are averages over the time of the loads, in force/area times `pressure_unit`;
// `with_wear` adds the volume worn off and its depth, volume over the face's area.
std::vector<FaceField> load_fields(const WallMesh &mesh, const WallLoads &loads,
                                   double pressure_unit, bool with_wear);

// The mesh as the pose puts it, in a file of VTK's XML format for polygons (.vtp), appears whole or not at all.
// Throws InputError that names the file.
void write_mesh_fields(const std::string &path, const WallMesh &mesh,
                       const std::vector<FaceField> &fields, long long step, double time,
                       const WallPose &pose = {});

// FILE with the step in place of its first '*'.
std::string file_of_step(const std::string &path, long long step);

}    // namespace lsdcd
