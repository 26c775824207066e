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

// [mesh K], where K counts from 1. Returns the mesh, from 0. `taken`: how many arguments that is.
int mesh_of(const std::vector<std::string> &arguments, std::size_t meshes, std::size_t &taken)
{
  const std::string n = std::to_string(meshes);
  taken = 0;
  if (arguments[0] != "mesh") {
    if (meshes == 1) return 0;
    throw InputError("fix_modify " + arguments[0] + ": which of the " + n +
                     " meshes? Write fix_modify ID mesh K " + arguments[0] + " ..., with K from 1");
  }
  Real k = 0;
  if (arguments.size() < 2 || !is_number(arguments[1], &k) || k != std::floor(k) || k < 1 ||
      k > static_cast<Real>(meshes))
    throw InputError(
        "fix_modify mesh K motion|servo|body ...: K is the number of a mesh, from 1 to " + n +
        (arguments.size() > 1 ? ", not '" + arguments[1] + "'" : ""));
  taken = 2;
  if (arguments.size() < 3 || !changes(arguments[2]))
    throw InputError("fix_modify mesh " + arguments[1] +
                     ": motion ..., servo ... or body ... must follow" +
                     (arguments.size() < 3 ? "" : ", not '" + arguments[2] + "'"));
  return static_cast<int>(k) - 1;
}

}    // namespace

int change_wall(Wall &wall, const std::vector<std::string> &arguments, const Step &now)
{
  if (arguments[0] != "mesh" && !changes(arguments[0])) return 0;
  std::size_t taken;
  const int mesh = mesh_of(arguments, wall.meshes().size(), taken);
  Tokens w(arguments);
  while (w.at() < taken) w.take();
  std::vector<std::string> inputs = wall.spec().inputs;
  if (w.peek() == "motion") {
    const RigidMotion motion = read_modified_motion(w, inputs);
    wall.set_inputs(inputs);
    wall.set_motion(mesh, motion, now);
  } else if (w.peek() == "body") {
    wall.check_is_body(mesh);
    const BodySpec body =
        read_modified_body(w, wall.spec().meshes[static_cast<std::size_t>(mesh)].body, inputs);
    wall.set_inputs(inputs);
    wall.set_body(mesh, body);
  } else {
    const Servo servo = read_modified_servo(w, inputs);
    wall.set_inputs(inputs);
    wall.set_servo(mesh, servo);
  }
  return static_cast<int>(w.at());
}

}    // namespace lsdcd
