// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall as data: its meshes, contact laws, search and outputs.
#pragma once

#include "engine/settings.h"
#include "grid/triangle_grid.h"
#include "law/sub_models.h"
#include "mesh/placement.h"
#include "motion/motion.h"
#include "rigid/body_spec.h"

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

// A file that is written every so many steps; with '*' in its name, one for each of them.
struct FileEvery {
  std::string name;
  int every = 0;    // steps; 0: no file
};

constexpr int kAnyType = std::numeric_limits<int>::max();

// The contact law of a range of types of spheres.
struct LawOfTypes {
  int first_type = 0, last_type = kAnyType;    // both are in the range; there is no type 0
  ContactLaw law;
  std::string name;    // what the log calls it; empty: its sub-models
  // Its numbers as a script gives them, a style or the normal sub-model first; empty: it is of materials.
  std::vector<GivenSubModel> given;
  std::string becomes;    // coarse_grain_text(); empty without

  bool is_of_all() const { return first_type <= 1 && last_type == kAnyType; }
  bool has(int type) const { return first_type <= type && type <= last_type; }
};

// One mesh of a wall.
struct MeshSpec {
  std::string name;    // what messages call it
  // A file, which one process reads, or a mesh in its own frame. Only the first process needs it.
  std::string file;
  std::shared_ptr<const WeldedMesh> mesh;    // null: that of the file
  // Which vertex of `mesh` each vertex of the program became; kNoVertex: none.
  std::shared_ptr<const std::vector<int>> welded_vertex;
  Placement placement;    // from the frame of the file, or of the mesh, to the box
  Real weld = -1;         // length; < 0: cracks (mesh/cracks.h)

  // Laws in place of the wall's: that of a type is the last row that has the type. Empty: the wall's.
  std::vector<LawOfTypes> laws;
  RigidMotion motion;
  BodySpec body;    // in place of terms and servo of the motion
  // The welded vertices are nodes, each of which is where the program puts it, in place of the motion.
  bool has_nodes = false;
  std::string
      node_group;    // of the host's particles that are its nodes; empty: set_nodes() has them from elsewhere
  Real pressure = 0;    // force/area; on its nodes, along the normals of faces
  int pressure_input = kNoInput;
  SurfaceMotion surface;
  int surface_input[6] = {kNoInput, kNoInput, kNoInput,
                          kNoInput, kNoInput, kNoInput};    // of its velocity and angular velocity
  bool has_temperature = false;
  Real temperature = 0;    // where the law has heat
  int temperature_input = kNoInput;
  Real wear_factor = 1;    // how many times what Wear says comes off

  bool torque_about_mesh = false;
  Vec3 torque_about = {0, 0, 0};    // length; a point of the box, or of the mesh
  FileEvery stl;                    // of the mesh where it is
  FileEvery fields;                 // of numbers per triangle
  FileEvery spectrum;               // of the spectrum of impacts
  std::string cache_file;           // of its grid; empty: none

  bool surface_varies() const;
};

// How wear moves the vertices of meshes.
struct WearDeform {
  int every = 0;      // steps; 0: they stay
  Real factor = 1;    // so many times the worn volume is removed
};

// Lengths, times, masses and forces are in the units of the host; pressures in its unit of pressure.
struct WallSpec {
  // At least one row, whose first is of all types. All laws have the same sub-models.
  std::vector<LawOfTypes> laws = std::vector<LawOfTypes>(1);
  std::vector<MeshSpec> meshes;    // 1 to kMaxMeshes
  // Numbers that the host gives in each step, by name. Members of meshes and motions called `input` count
  // from 0 in this list; kNoInput: the number is fixed.
  InputNames inputs;
  Corner corner = Corner::blend;
  Side side = Side::both;
  Device device = Device::automatic;
  Real grid_length = 0;    // length; 0: chosen
  Real rmax = 0;           // length; 0: the largest radius that there is
  int nearest = 0;         // primitives of wall per cell; 0: all
  std::size_t memory_budget = GridSettings().memory_budget;    // bytes, for each mesh
  Wear wear;                    // K and H in pressure units, E90 in length^3 and mass
  WearDeform wear_deform;       // of meshes that recede
  int average_every = 0;        // steps of each mean of MeanLoads; 0: there is none
  bool contacts = false;        // for_contact_rows() will be called
  bool each_contact = false;    // for_contacts() will be called
  bool energy = false;          // what contacts do with energy is recorded (EnergyBooks)
  Real friction_heat = 0;       // the share of the heat of friction that goes into the spheres
  Real impact_speed =
      0;    // length/time; impacts that are faster are recorded (EnergyRecorder); 0: none
  // Laws are of grains so many times as large as those that a script's numbers are of. They are already multiplied.
  Real coarse_grain = 1;
  bool shapes = false;      // grains may be no spheres (Spheres::shapes)
  bool periodic = false;    // meshes are meant to reach past periodic faces
  bool brief = false;       // one line in the log

  // Returns the sub-models, which all laws have.
  const ContactLaw &law() const { return laws.front().law; }
  // Returns how many numbers a sphere has in the contacts array; 0: there is none.
  int contact_columns() const;
  bool wears() const { return wear.model != WearModel::none; }
  bool wears_by_impact() const { return wear.model == WearModel::oka; }
  // Returns whether wear moves the vertices of a mesh.
  bool recedes(const MeshSpec &mesh) const
  {
    return wears() && wear_deform.every > 0 && mesh.wear_factor > 0;
  }
  bool has_loads(const MeshSpec &mesh) const { return wears() || mesh.fields.every > 0; }
  bool has_loads() const;
  // Returns whether there is a place for what becomes of energy at each triangle of the mesh.
  bool has_energy_places(const MeshSpec &mesh) const
  {
    return mesh.fields.every > 0 && (energy || impact_speed > 0);
  }
  // Returns whether what contacts dissipate is wanted by triangle.
  bool has_energy_places() const;
  bool records_energy() const { return has_energy_places() || impact_speed > 0; }
  bool has_bodies() const;
  bool has_nodes() const;
};

// Leaves cohesion out of all laws if it is 0 in all of them, so that it costs nothing.
void leave_out_zero_cohesion(WallSpec &wall);

// Returns the law of each mesh and type of sphere.
LawTable law_table(const WallSpec &wall);

// Returns the law of a mesh with what has no type: the law of all types of the mesh, or of the wall.
const ContactLaw &law_of_all_types(const WallSpec &wall, int mesh);

// Returns whether the torques of all meshes are about the same point in each step.
bool torques_share_a_point(const WallSpec &wall);

// Returns whether two meshes have the same triangles, always at the same place.
bool are_one_mesh(const WallSpec &wall, const MeshSpec &mesh, const WallSpec &other_wall,
                  const MeshSpec &other);

}    // namespace lsdcd
