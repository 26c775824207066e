// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers per triangle, in a file for ParaView and other VTK programs.
#pragma once

#include "engine/loads/load.h"
#include "engine/loads/place_energy.h"
#include "motion/pose.h"
#include "output/feature_rows.h"

#include <string>
#include <vector>

namespace lsdcd {

struct FaceField {
  std::string name;
  std::vector<double> value;    // n_components per face of the mesh
  int n_components = 1;
};

// Stresses are averages over `time`, that of the loads, in force/area times `pressure_unit`;
// `with_wear` adds the volume worn off and its depth, volume over the face's area. Forces on the
// wall are averages in the frame of the mesh, turned to where the pose has it.
std::vector<FaceField> load_fields(const WeldedMesh &mesh, const FeatureRows<Load> &loads,
                                   Real time, double pressure_unit, bool with_wear,
                                   const Pose &pose = {});

// Energy that contacts dissipate, and the number, energy and greatest speed of impacts, each where asked for.
std::vector<FaceField> energy_fields(const WeldedMesh &mesh, const FeatureRows<PlaceEnergy> &places,
                                     bool with_energy, bool with_impacts);

// The mesh as the pose puts it, in a file of VTK's XML format for polygons (.vtp), which appears
// whole or not at all. Throws InputError that names the file.
void write_mesh_fields(const std::string &path, const WeldedMesh &mesh,
                       const std::vector<FaceField> &fields, long long step, double time,
                       const Pose &pose = {});

}    // namespace lsdcd
