// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Another motion for a mesh: between runs, and from a restart file.

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_words.h"
#include "input/motion_words.h"

#include <cmath>

using namespace LAMMPS_NS;

// [mesh K] motion|servo ..., where K counts from 1.
int FixWallLsdcd::modify_param(int narg, char **arg)
{
  std::vector<std::string> words(arg, arg + narg);
  MeshPart *part = several() ? nullptr : &parts.front();
  int taken = 0;
  if (words[0] == "mesh") {
    double k = 0;
    if (narg < 2 || !lsdcd::is_number(words[1], &k) || k != std::floor(k) || k < 1 ||
        k > parts.size())
      fatal("fix_modify mesh K motion|servo ...: K is the number of a mesh, from 1 to " +
            std::to_string(parts.size()) + (narg > 1 ? ", not '" + words[1] + "'" : ""));
    part = &parts[static_cast<std::size_t>(k) - 1];
    words.erase(words.begin(), words.begin() + 2);
    taken = 2;
    if (words.empty() || (words[0] != "motion" && words[0] != "servo"))
      fatal("fix_modify mesh " + std::string(arg[1]) + ": motion ... or servo ... must follow" +
            (words.empty() ? "" : ", not '" + words[0] + "'"));
  }
  const bool servo = words[0] == "servo";
  if (!servo && words[0] != "motion") return 0;
  if (!part)
    fatal("fix_modify " + words[0] + ": which of the " + std::to_string(parts.size()) +
          " meshes? Write fix_modify ID mesh K " + words[0] + " ..., with K from 1");
  try {
    return taken + (servo ? modify_servo(*part, words) : modify_motion(*part, words));
  } catch (const lsdcd::InputError &e) {
    fatal(e.what());
  }
}

int FixWallLsdcd::modify_motion(MeshPart &m, const std::vector<std::string> &words)
{
  const lsdcd::ModifiedMotion read = lsdcd::read_modified_motion(words);
  m.motion.change(read, step_now());
  motion_has_changed(m);
  if (!settings.brief)
    log(with_fix_id(of(m, "motion " + (read.terms.empty() ? "none" : m.motion.text(m.bounds(0))))));
  return static_cast<int>(read.taken);
}

int FixWallLsdcd::modify_servo(MeshPart &m, const std::vector<std::string> &words)
{
  const lsdcd::ModifiedServo read = lsdcd::read_modified_servo(words);
  m.motion.change(read);
  m.servo_controller.begin_anew();
  servo_radius = 0;    // a run without setup looks then
  motion_has_changed(m);
  show_servo();
  if (!settings.brief) log(with_fix_id(of(m, "servo " + read.text)));
  return static_cast<int>(read.taken);
}

// Laws for a wall at rest do not know where it is. Collective.
void FixWallLsdcd::motion_has_changed(const MeshPart &m)
{
  schedule.expire();
  check_motion(m);
  if (any_moves() && !engine_moves) make_engine_anew();
}
