// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/wall_command.h"

#include "base/input_words.h"
#include "input/granular_words.h"
#include "input/keywords.h"
#include "input/law_words.h"
#include "mesh/io/read_mesh.h"
#include "wall/spec/spec_check.h"

#include <algorithm>

namespace lsdcd {

namespace {

// Words of fix wall/gran and LIGGGHTS, each with the words to use here.
std::string answer_to(const std::string &word, bool granular)
{
  const char *const kMoves =
      "the keywords are motion wiggle Ax Ay Az period, and wiggle x|y|z amplitude period";
  const char *const kServo =
      "the keywords are servo force|torque x|y|z|axis ax ay az TARGET vmax V";
  const char *const kJoint =
      "it goes with body: body density D joint hinge px py pz ax ay az, and so on";
  const char *const kFlat =
      "the wall is a mesh: write mesh FILE in its place, or use fix wall/gran";
  const char *const kBelt =
      "the keywords are surface_vel vx vy vz and surface_angvel wx wy wz [cx cy cz]";
  const char *const kSpeed = "it is not needed: folds are measured, and all of them are walls";
  const char *const kReport =
      "the fix always inspects the mesh and writes the result to the log: leave it out";
  const char *const kWeld = "the keyword for joining corners is weld tol";
  const char *const kDouble =
      "all steps compute in double: delete precision and its value; LIGGGHTS's is weld tol here";
  const char *const kLoads = "see mesh_fields FILE every N, and force and torque in f_ID[1] to "
                             "f_ID[6]";
  const char *const kNumbers = "the contact's numbers stand before mesh, or come from granular "
                               "material FILE NAME; those of a "
                               "mesh, or of atom types, after it: law [types I] STYLE numbers";
  const char *const kTypes =
      "with a material the order is granular material FILE PARTICLE types I NAME on WALL with "
      "KEY VALUE mesh FILE material WALL; numbers of atom types come after mesh FILE: law types I "
      "STYLE numbers";
  const struct {
    const char *word;
    const char *answer;
  } foreign[] = {
      {"target_val", kServo},
      {"vel_max", kServo},
      {"ctrlPV", kServo},
      {"vibrate", kMoves},
      {"move/mesh", "the keywords are motion linear, rotate, wiggle, transrot and variable"},
      {"hinge", kJoint},
      {"slider", kJoint},
      {"planar", kJoint},
      {"ball", kJoint},
      {"joint", kJoint},
      {"zplane", kFlat},
      {"yplane", kFlat},
      {"xplane", kFlat},
      {"zcylinder", kFlat},
      {"region", kFlat},
      {"primitive", kFlat},
      {"velocity", kBelt},
      {"vel", kBelt},
      {"surface_ang_vel", kBelt},
      {"surface_omega", kBelt},
      {"curvature", kSpeed},
      {"curvature_tolerant", kSpeed},
      {"heal", kReport},
      {"verbose", kReport},
      {"element_exclusion_list", kReport},
      {"min_feature_length", kWeld},
      {"precision", kDouble},
      {"stress", kLoads},
      {"reference_point", "the keywords are torque_about x y z"},
      {"type", kNumbers},
      {"types", kTypes},
      {"on", kTypes},
      {"with", kTypes},
      {"material", "it goes with granular material FILE PARTICLE, after mesh FILE"},
      {"shapes", "the atoms of a script say what they are: leave it out"},
      {"model", kNumbers},
      {"file", "the keyword is mesh FILE"},
      {"limitForce", "the word is limit_damping, which comes before mesh"},
      {"rolling_friction", "the keyword is rolling cdt MU, epsd2 MU, epsd MU damping"},
  };
  for (const auto &row : foreign)
    if (word == row.word) return row.answer;
  for (const char *ending : {".stl", ".obj", ".ply", ".off"})
    if (name_ending(word) == ending) return "write mesh before the file";
  for (const std::string &family : granular_families())
    if (word == family)
      return granular || word == "limit_damping" ? "it comes before mesh and other keywords"
                                                 : "it goes with the style granular, before mesh";
  return "";
}

// `quoted`: the word as messages have it.
[[noreturn]] void refuse_keyword(const std::string &word, const std::string &quoted,
                                 const std::vector<Keyword> &rows, bool granular)
{
  const std::string wrong = quoted + " is not a keyword";
  const std::string answer = answer_to(word, granular);
  if (!answer.empty()) throw InputError(wrong + " here: " + answer);
  std::vector<std::string> names;
  for (const Keyword &row : rows) names.push_back(row.name);
  std::vector<std::string> known = granular_families();
  known.insert(granular ? known.end() : known.begin(), names.begin(), names.end());
  const std::string near = nearest(word, known);
  const auto row = std::find(names.begin(), names.end(), near);
  if (is_like(word, near)) {
    const std::string of_family = granular || row == names.end() ? answer_to(near, granular) : "";
    if (!of_family.empty())
      throw InputError(wrong + "; the nearest is '" + near + "': " + of_family);
    // That of motion is of some lines.
    constexpr std::size_t kLongest = 100;
    const std::string syntax = syntax_of(rows[row - names.begin()]);
    throw InputError(wrong + "; the nearest is '" + (syntax.size() > kLongest ? near : syntax) +
                     "'");
  }
  std::string all;
  for (const std::string &name : names) all += (all.empty() ? "" : ", ") + name;
  throw InputError(wrong + "; those are " + all);
}

// A keyword of a mesh belongs to the last mesh before it. If there is one mesh, it may also stand before
// that.
void read_keywords(Tokens &w, WallCommand &command, bool granular, bool of_program)
{
  const std::vector<Keyword> &rows = of_program ? program_keywords() : keywords();
  std::vector<std::string> seen, seen_of_mesh;
  std::string early;    // the first keyword of a mesh before any
  std::vector<MeshSpec> &meshes = command.wall.meshes;
  meshes.resize(1);
  while (!w.done()) {
    const std::string quoted = w.quoted(), word = w.take();
    if (word == "material" && command.materials.are_given()) {
      read_material_of_mesh(w, meshes.size() - 1, meshes.back().file, command.materials);
      continue;
    }
    const Keyword *const found = find_keyword(rows, word);
    if (!found) {
      const Keyword *const of_scripts = find_keyword(keywords(), word);
      if (of_scripts)
        throw InputError(quoted + " is a keyword of scripts: " + of_scripts->answer_to_program);
      refuse_keyword(word, quoted, rows, granular);
    }
    const Keyword &row = *found;
    w.set_context(row.name, syntax_of(row));
    const bool next = word == "mesh" && !meshes.back().file.empty();
    if (next && !early.empty())
      w.fail("there are several meshes, and '" + early +
             "' comes before the first: write the keywords of a mesh after its mesh FILE");
    if (next) {
      meshes.emplace_back();
      seen_of_mesh.clear();
    }
    std::vector<std::string> &given = row.read ? seen : seen_of_mesh;
    if (!row.repeats() && std::count(given.begin(), given.end(), word))
      w.fail("the keyword is given twice");
    given.push_back(word);
    if (row.read) {
      row.read(w, command);
      continue;
    }
    if (word != "mesh" && early.empty() && meshes[0].file.empty()) early = word;
    row.read_of_mesh(w, meshes.back(), command.wall.inputs);
    if (word == "surface_vel" || word == "shear")
      if (std::count(given.begin(), given.end(), "shear") &&
          std::count(given.begin(), given.end(), "surface_vel")) {
        w.set_context("shear", "shear x|y|z v");
        w.fail("surface_vel and shear set the same velocity: give one of them");
      }
  }
}

// Throws InputError where two meshes have one name; without the keyword name a mesh is called by its file, of which there may be several.
void check_names(const std::vector<MeshSpec> &meshes)
{
  for (std::size_t k = 1; k < meshes.size(); k++)
    for (std::size_t i = 0; i < k; i++) {
      const bool named = meshes[k].name != meshes[k].file || meshes[i].name != meshes[i].file;
      if (named && meshes[k].name == meshes[i].name)
        throw InputError("in 'name', meshes " + std::to_string(i + 1) + " and " +
                         std::to_string(k + 1) + " have the same name '" + meshes[k].name +
                         "': give one of them another by the keyword name");
    }
}

// Throws where a script has a word of programs.
void check_script(const WallSpec &wall)
{
  for (const MeshSpec &mesh : wall.meshes)
    if (mesh.motion.is_posed())
      throw InputError(
          "in 'motion', caller is for a program that calls the library and has poses of its own: "
          "in a script write motion variable, or another motion");
}

// Gives a program's wall its values. Throws where it has a word of scripts.
void finish_program(const ProgramWall &program, WallSpec &wall)
{
  program.words.put_into(wall);
  if (program.on_device && wall.device != Device::automatic)
    throw InputError("in 'device', the arrays of the spheres say where the wall computes, which is "
                     "the GPU: leave it out");
  if (program.on_device && wall.shapes)
    throw InputError("in 'shapes', grains that are no spheres have walls for arrays of the host "
                     "alone: leave it out");
  for (MeshSpec &mesh : wall.meshes) {
    mesh.body.has_gravity = true;    // 0 where the words give none: a program has no fix gravity
    if (!mesh.has_nodes) continue;
    if (mesh.node_group != "caller")
      throw InputError("in 'nodes', a program has no groups of atoms: write nodes caller");
    mesh.node_group.clear();
  }
}

}    // namespace

WallCommand parse_wall(const std::vector<std::string> &arguments, const LawsOfMaterials &laws_of,
                       const ProgramWall *program)
{
  WallCommand command;
  WallSpec &wall = command.wall;
  Tokens w(arguments, program ? &program->words.origins() : nullptr);
  const char *const command_name = program ? "wall" : "fix wall/lsdcd";
  if (program && !program->on_device) wall.device = Device::cpu;
  w.set_context(command_name, law_syntax());
  LawOfTypes &law = wall.laws.front();
  const bool has_materials = has_material(arguments);
  if (has_materials)
    read_wall_materials(w, arguments, command.materials);
  else
    read_law(w, law, law_syntax());
  const bool granular = has_materials || !law.law.is_classic();
  read_keywords(w, command, granular, program != nullptr);
  w.set_context(command_name, granular ? granular_syntax() : law_syntax());
  if (wall.meshes[0].file.empty()) w.fail("mesh FILE is missing");
  if (program)
    finish_program(*program, wall);
  else
    check_script(wall);
  check_names(wall.meshes);
  command.materials.pair.coarse_grain = wall.coarse_grain;
  if (has_materials) add_laws(command.materials, laws_of, wall);
  finish_laws(wall);
  check_spec(wall);
  if (program) check_begin(wall);
  return command;
}

std::string wall_help()
{
  std::string help = std::string("fix ID group wall/lsdcd ") + law_syntax() + "\n  " +
                     granular_syntax() + ", of\n" + granular_help() +
                     "  or, with numbers from a file, " + kMaterialSyntax + "\n  keywords\n";
  for (const Keyword &row : keywords()) {
    std::string line = "  " + syntax_of(row);
    line.resize(std::max<std::size_t>(line.size() + 1, 38), ' ');
    line += row.help;
    std::string facts;
    for (const char *fact : {row.unit, row.range})
      if (*fact) facts += std::string(fact) + "; ";
    help += line + " (" + facts + (*row.fallback ? "default " : "required") + row.fallback + ")\n";
  }
  return help;
}

}    // namespace lsdcd
