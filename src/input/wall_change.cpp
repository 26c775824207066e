// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/wall_change.h"

#include "base/input_words.h"
#include "input/body_words.h"
#include "input/motion_words.h"
#include "input/servo_words.h"

#include <cmath>

namespace lsdcd {

namespace {

bool changes(const std::string &word)
{
  return word == "motion" || word == "servo" || word == "body";
}

// Returns the mesh, from 0, that `mesh K` means: its number, from 1, or its name. Programs have names alone, as their calls count from 0.
int mesh_of(const std::vector<std::string> &arguments, const std::vector<MeshSpec> &meshes,
            bool of_program = false)
{
  const std::string begins =
      of_program ? "mesh NAME motion|servo|body ...: NAME is the name of a mesh"
                 : "fix_modify mesh K motion|servo|body|names ...: K is the number of a "
                   "mesh, from 1 to " +
                       std::to_string(meshes.size()) + ", or its name";
  if (arguments.size() < 2) throw InputError(begins);
  const std::string &given = arguments[1];
  Real k = 0;
  if (!of_program && is_number(given, &k)) {
    if (k != std::floor(k) || k < 1 || k > static_cast<Real>(meshes.size()))
      throw InputError(begins + ", not '" + given + "'");
    return static_cast<int>(k) - 1;
  }
  int found = -1;
  for (std::size_t mesh = 0; mesh < meshes.size(); mesh++) {
    if (meshes[mesh].name != given) continue;
    if (found >= 0)
      throw InputError("fix_modify mesh " + given + ": meshes " + std::to_string(found + 1) +
                       " and " + std::to_string(mesh + 1) + " are called so: give " +
                       (of_program ? "" : "the number of one, or ") + "names by the keyword name");
    found = static_cast<int>(mesh);
  }
  if (found >= 0) return found;
  std::vector<std::string> names;
  for (const MeshSpec &mesh : meshes) names.push_back(mesh.name);
  throw InputError(begins + ", not '" + given + "': " + nearest_or_all(given, names));
}

}    // namespace

int change_wall(Wall &wall, const std::vector<std::string> &arguments, const Step &now,
                const ProgramWords *program)
{
  if (arguments[0] != "mesh" && !changes(arguments[0])) return 0;
  const std::vector<MeshSpec> &meshes = wall.spec().meshes;
  const std::size_t taken = arguments[0] == "mesh" ? 2 : 0;
  if (!taken && meshes.size() > 1)
    throw InputError("fix_modify " + arguments[0] + ": which of the " +
                     std::to_string(meshes.size()) + " meshes? Write " +
                     (program ? "mesh NAME " : "fix_modify ID mesh K ") + arguments[0] + " ..." +
                     (program ? "" : ", with K from 1, or the name of a mesh"));
  const int mesh = taken ? mesh_of(arguments, meshes, program != nullptr) : 0;
  if (arguments.size() <= taken || !changes(arguments[taken]))
    throw InputError("fix_modify mesh " + arguments[1] + ": motion ..., servo ...," +
                     (program ? " or body ..." : " body ... or names ...") + " must follow" +
                     (arguments.size() <= taken ? "" : ", not '" + arguments[taken] + "'"));
  const MeshSpec &of = meshes[static_cast<std::size_t>(mesh)];
  if (program && of.motion.is_posed() && !of.body.present)    // a body poses its mesh by itself
    throw InputError("mesh '" + of.name +
                     "' has poses of the program, which alone move it: lsdcd_wall_set_pose()");
  Tokens w(arguments, program ? &program->origins() : nullptr);
  while (w.at() < taken) w.take();
  const InputNames before = wall.spec().inputs;
  InputNames inputs = before;
  // Once all is read; `set` refuses before it changes anything.
  const auto change = [&](const auto &set) {
    if (program && !w.done())
      throw InputError(w.quoted() + " is not expected behind the change of a mesh");
    wall.set_inputs(inputs);
    try {
      set();
    } catch (...) {
      wall.set_inputs(before);
      throw;
    }
  };
  if (w.peek() == "motion") {
    RigidMotion motion = read_modified_motion(w, inputs);
    if (program) program->put_into(motion);
    change([&] { wall.set_motion(mesh, motion, now); });
  } else if (w.peek() == "body") {
    wall.check_is_body(mesh);
    const BodySpec body = read_modified_body(w, of.body, inputs);
    change([&] { wall.set_body(mesh, body); });
  } else {
    const Servo servo = read_modified_servo(w, inputs);
    change([&] { wall.set_servo(mesh, servo); });
  }
  return static_cast<int>(w.at());
}

bool asks_for_names(const Wall &wall, std::vector<std::string> &arguments, int &mesh)
{
  mesh = -1;
  const std::size_t at = arguments[0] == "mesh" ? 2 : 0;
  if (arguments.size() <= at || arguments[at] != "names") return false;
  if (at) mesh = mesh_of(arguments, wall.spec().meshes);
  arguments.erase(arguments.begin(), arguments.begin() + static_cast<std::ptrdiff_t>(at));
  return true;
}

}    // namespace lsdcd
