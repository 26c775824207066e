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
      refuse("fix_modify mesh K motion|servo ...: K is the number of a mesh, from 1 to " +
             std::to_string(parts.size()) + (narg > 1 ? ", not '" + words[1] + "'" : ""));
    part = &parts[static_cast<std::size_t>(k) - 1];
    words.erase(words.begin(), words.begin() + 2);
    taken = 2;
    if (words.empty() || (words[0] != "motion" && words[0] != "servo"))
      refuse("fix_modify mesh " + std::string(arg[1]) + ": motion ... or servo ... must follow" +
             (words.empty() ? "" : ", not '" + words[0] + "'"));
  }
  const bool servo = words[0] == "servo";
  if (!servo && words[0] != "motion") return 0;
  if (!part)
    refuse("fix_modify " + words[0] + ": which of the " + std::to_string(parts.size()) +
           " meshes? Write fix_modify ID mesh K " + words[0] + " ..., with K from 1");
  try {
    return taken + (servo ? modify_servo(*part, words) : modify_motion(*part, words));
  } catch (const lsdcd::InputError &e) {
    refuse(e.what());
  }
}

int FixWallLsdcd::modify_motion(MeshPart &m, const std::vector<std::string> &words)
{
  const lsdcd::ModifiedMotion read = lsdcd::read_modified_motion(words);
  // It begins where the mesh is; a servo that moves goes on with what it has added to that. Words
  // without terms are of a motion that was stopped: restart files say so.
  lsdcd::WallMotion &motion = m.settings.motion;
  const bool holds = m.servo().holds;
  const lsdcd::WallPose placed = holds ? m.pose : motion.terms_at(m.clock.now());
  if (holds) m.servo().position = 0;
  motion.stop();
  motion.begin_from(placed);
  for (const lsdcd::MotionTerm &term : read.terms) motion.add(term);
  if (motion.moves()) m.settings.motion_tokens = read.text;
  begin_motion(m);
  make_engine_that_moves();
  if (!settings.brief)
    log(signed_text(of(m, "motion " + (read.terms.empty() ? "none" : m.motion_text()))));
  return static_cast<int>(read.taken);
}

// Laws for a wall at rest do not know where it is. Collective.
void FixWallLsdcd::make_engine_that_moves()
{
  if (any_moves() && !engine_moves) make_engine_anew();
}

static lsdcd::WallPose pose_from(const double *numbers)
{
  lsdcd::WallPose p;
  for (int i = 0; i < 3; i++) p.row[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
  p.shift = {numbers[9], numbers[10], numbers[11]};
  return p;
}

static lsdcd::Servo servo_from(const double *numbers)
{
  lsdcd::Servo s;
  s.present = numbers[0] != 0;
  s.holds = numbers[0] == 2;
  s.turns = numbers[1] != 0;
  s.axis = {numbers[2], numbers[3], numbers[4]};
  s.point = {numbers[5], numbers[6], numbers[7]};
  s.position = numbers[8];
  s.velocity = numbers[9];
  return s;
}

// The same words go on in the step where they were; with others the mesh stays where it was, and
// these begin there. A servo goes on along the same line, whatever its target is now. What was
// stopped stays so. Collective.
void FixWallLsdcd::restart_motion(MeshPart &m, const std::vector<double> &data)
{
  constexpr int kClock = 5, kPose = 12, kServo = kClock + 3 * kPose, kTerms = kServo + 10,
                kOfTerm = 6;
  const std::size_t n_terms = static_cast<std::size_t>(data[kTerms]);
  const std::string tokens(data.begin() + kTerms + 1 + kOfTerm * n_terms, data.end());
  const lsdcd::WallPose first = pose_from(&data[kClock]), placed = pose_from(&data[kClock + kPose]),
                        last = pose_from(&data[kClock + 2 * kPose]);
  const lsdcd::Servo was = servo_from(&data[kServo]);
  lsdcd::WallMotion &motion = m.settings.motion;
  lsdcd::Servo &servo = motion.servo();
  const bool same_line = was.position == 0 || servo.has_line_of(was),
             same = same_line && tokens == m.settings.motion_tokens,
             stopped = n_terms == 0 && !tokens.empty();
  motion.begin_from(same ? first : same_line ? placed : last);
  const std::string so =
      " was stopped when the restart file was written, and stays so: fix_modify ";
  if (same && stopped) {
    motion.stop();
    warn(
        of(m, "the motion '" + tokens + "'" + so + "motion starts another from where the mesh is"));
  }
  if (servo.has_line_of(was)) {
    servo.position = was.position;
    servo.velocity = was.velocity;
    servo.holds = was.holds;
    check_limits(m, "read_restart");
    if (servo.holds) warn(of(m, "the servo" + so + "servo lets it go on"));
  }
  begin_motion(m);
  if (same) {
    m.clock.base = lsdcd::Time(data[0]) + lsdcd::Time(data[1]);
    m.clock.base_step = static_cast<bigint>(data[2]);
    m.clock.step = static_cast<bigint>(data[3]);
    m.clock.dt = data[4];
    for (std::size_t i = 0; i < n_terms; i++) {
      const double *v = &data[kTerms + 1 + kOfTerm * i];
      motion.terms()[i].displacement = {v[0], v[1], v[2]};
      motion.terms()[i].speed = {v[3], v[4], v[5]};
    }
    m.pose = motion.pose_at(m.clock.now());
  } else if (motion.moves() ? !tokens.empty() : n_terms > 0) {
    warn(of(m, "the restart file was written with the motion '" + tokens + "' and this fix has " +
                   (motion.moves() ? "'" + m.settings.motion_tokens + "', which begins"
                                   : "none: the mesh stays") +
                   " where the mesh was; the phase is not carried over"));
  }
  if (!same_line)
    warn(of(m, "the restart file was written with a servo along another line, or this fix has "
               "none: the mesh is where that had it, at " +
                   lsdcd::number_text(was.position) + ", and its state is not carried over"));
  make_engine_that_moves();
}
