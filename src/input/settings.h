// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Input words of fix wall/lsdcd -> WallSettings. One row per keyword.
#pragma once

#include "engine/wall_engine.h"
#include "mesh/placement.h"
#include "motion/motion.h"
#include "output/mesh_image.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lsdcd {

// A file that is written every so many steps; with '*' in its name, one for each of them.
struct FileEvery {
  std::string name;
  int every = 0;    // steps; 0: no file
};

constexpr int kAnyType = 2147483647;

// The law of a mesh in place of the wall's, or that of some atom types with it.
struct LawOfMesh {
  std::string types;                           // as written: "2", "1*3"; empty: all
  int first_type = 1, last_type = kAnyType;    // the range
  ContactLaw law;
  std::string name;    // as WallSettings::law_name
};

// One mesh of a wall: what may differ from mesh to mesh.
struct MeshSettings {
  std::string file;
  Placement placement;
  std::string placement_tokens;    // for the log: "scale 0.001, move 0 0 1"
  Real weld = -1;                  // length; < 0: kDefaultWeld of the diagonal
  bool has_temperature = false;
  Real temperature = 0;                // where the law has heat
  std::string temperature_variable;    // name of a variable; empty: none
  SurfaceMotion surface;
  std::string surface_variable[6];    // in place of its velocity and angular velocity; empty: none
  RigidMotion motion;
  std::string motion_tokens;    // "rotate 0 0 0 0 0 1 2, linear 1 0 0"
  std::string servo_tokens;     // "force z 100 vmax 0.1"
  bool torque_about_mesh = false;
  Vec3 torque_about = {0, 0, 0};    // length; a point of the box, or of the mesh
  FileEvery stl;                    // of the mesh where it is
  FileEvery fields;                 // of numbers per triangle
  std::string cache_file;           // empty: none
  std::vector<LawOfMesh> laws;
  Real wear_factor = 1;    // how many times what Wear says comes off

  bool surface_varies() const
  {
    for (const std::string &name : surface_variable)
      if (!name.empty()) return true;
    return false;
  }
};

// The same file, which is always at the same place.
bool are_one_mesh(const MeshSettings &a, const MeshSettings &b);

struct WallSettings {
  std::vector<MeshSettings> meshes;
  ContactLaw law;          // NULLs resolved; hertz stiffnesses still in pressure units
  std::string law_name;    // its style; with `granular`, all its words
  LawTable laws;           // of all meshes; empty: they all have `law`
  Real grid_length = 0;    // length; 0: auto
  Real rmax = 0;           // length; 0: auto
  int nearest = 0;         // primitives of wall per cell; 0: all
  std::size_t memory_budget = GridSettings().memory_budget;    // bytes, for each mesh
  Corner corner = Corner::blend;
  Side side = Side::both;
  Precision precision = Precision::double_;
  Wear wear;    // K and H in pressure units
  Device device = Device::automatic;
  bool contacts = false;
  bool periodic = false;
  bool brief = false;    // one line in the log
  Draw draw = Draw::edges;
  int draw_type = 1;    // atom type whose colour the mesh takes
  bool cut = false;     // dump image leaves out centres with dot(normal, x) > offset
  Vec3 cut_normal = {0, 0, 0};
  Real cut_offset = 0;

  // `kind`: see LawTable.
  const ContactLaw &law_of(int mesh, int kind) const
  {
    return laws.is_empty() ? law : laws.laws[mesh * laws.kinds + kind];
  }
  // How far from its centre a sphere can feel a mesh.
  Real cutoff(Real radius) const
  {
    return cutoff_of(radius, laws.is_empty() ? law.pull_off() : largest_pull_off(laws));
  }

  // Numbers of a sphere in the contacts array; 0 without it.
  int contact_columns() const { return contacts ? 8 + law.has_heat() : 0; }
  bool wears() const { return wear.model != WearModel::none; }
  bool has_loads(const MeshSettings &mesh) const { return wears() || mesh.fields.every > 0; }
  bool has_loads() const
  {
    for (const MeshSettings &mesh : meshes)
      if (has_loads(mesh)) return true;
    return false;
  }
};

// `words` begin with FSTYLE. Throws InputError that names the word, what was
// expected and the syntax.
WallSettings parse_settings(const std::vector<std::string> &tokens);

// The command with every keyword, its unit, range and default; several lines.
std::string settings_help();

}    // namespace lsdcd
