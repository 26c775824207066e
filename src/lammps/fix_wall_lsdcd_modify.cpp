// Another motion for a mesh: between runs, and from a restart file.

#include "lammps/fix_wall_lsdcd.h"

#include "deck/motion_words.h"

#include <cstring>

using namespace LAMMPS_NS;

int FixWallLsdcd::modify_param(int narg, char **arg)
{
  try {
    if (std::strcmp(arg[0], "servo") == 0)
      return modify_servo(std::vector<std::string>(arg, arg + narg));
    if (std::strcmp(arg[0], "motion") != 0) return 0;
    const lsdcd::ModifiedMotion read =
        lsdcd::read_modified_motion(std::vector<std::string>(arg, arg + narg));
    // It begins where the mesh is; a servo that moves goes on with what it has added to that.
    const bool holds = settings.motion.servo().holds;
    const lsdcd::WallPose placed = holds ? pose : settings.motion.terms_at(clock.now());
    if (holds) settings.motion.servo() = lsdcd::Servo();
    settings.motion.stop();
    settings.motion.begin_from(placed);
    for (const lsdcd::MotionTerm &m : read.terms) settings.motion.add(m);
    settings.motion_tokens = read.text;
    begin_motion();
    make_engine_that_moves();
    if (!settings.brief)
      log(signed_text("motion " + (read.terms.empty() ? "none" : motion_text())));
    return static_cast<int>(read.taken);
  } catch (const lsdcd::InputError &e) {
    refuse(e.what());
  }
}

// Laws for a wall at rest do not know where it is. Collective.
void FixWallLsdcd::make_engine_that_moves()
{
  restart_global = restart_global || settings.motion.any();
  if (!settings.motion.any() || engine_moves) return;
  if (wall->cutoff() > 0) look();
  springs_to_host();
  make_engine();
  if (wall->cutoff() > 0) lsdcd::together(world, true, [&] { engine->set_grid(wall->view()); });
  list_is_old = true;
}

// What a restart file keeps of a motion: a number of numbers, all as doubles.
std::vector<double> FixWallLsdcd::motion_data() const
{
  const double high = static_cast<double>(clock.base);
  std::vector<double> data = {high, static_cast<double>(clock.base - high), double(clock.base_step),
                              double(clock.step), clock.dt};
  for (const lsdcd::WallPose &p :
       {settings.motion.start(), settings.motion.terms_at(clock.now()), pose}) {
    for (const lsdcd::Vec3 &row : p.row) data.insert(data.end(), {row.x, row.y, row.z});
    data.insert(data.end(), {p.shift.x, p.shift.y, p.shift.z});
  }
  const lsdcd::Servo &s = settings.motion.servo();
  data.insert(data.end(), {double(s.present), double(s.turns)});
  for (const lsdcd::Vec3 &v : {s.axis, s.point}) data.insert(data.end(), {v.x, v.y, v.z});
  data.insert(data.end(), {s.position, s.velocity});
  data.push_back(double(settings.motion.terms().size()));
  for (const lsdcd::MotionTerm &m : settings.motion.terms())
    for (const lsdcd::Vec3 &v : {m.displacement, m.speed}) data.insert(data.end(), {v.x, v.y, v.z});
  for (const char c : settings.motion_tokens) data.push_back(c);
  return data;
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
  s.turns = numbers[1] != 0;
  s.axis = {numbers[2], numbers[3], numbers[4]};
  s.point = {numbers[5], numbers[6], numbers[7]};
  s.position = numbers[8];
  s.velocity = numbers[9];
  return s;
}

// The same words go on in the step where they were; with others the mesh stays where it was, and
// these begin there. A servo goes on along the same line, whatever its target is now. Collective.
void FixWallLsdcd::restart_motion(const std::vector<double> &data)
{
  constexpr int kClock = 5, kPose = 12, kServo = kClock + 3 * kPose, kTerms = kServo + 10,
                kOfTerm = 6;
  const std::size_t n_terms = static_cast<std::size_t>(data[kTerms]);
  const std::string tokens(data.begin() + kTerms + 1 + kOfTerm * n_terms, data.end());
  const lsdcd::WallPose first = pose_from(&data[kClock]), placed = pose_from(&data[kClock + kPose]),
                        last = pose_from(&data[kClock + 2 * kPose]);
  const lsdcd::Servo was = servo_from(&data[kServo]);
  lsdcd::Servo &servo = settings.motion.servo();
  const bool same_line = was.position == 0 || servo.has_line_of(was),
             same = same_line && tokens == settings.motion_tokens;
  settings.motion.begin_from(same ? first : same_line ? placed : last);
  if (servo.has_line_of(was)) {
    servo.position = was.position;
    servo.velocity = was.velocity;
  }
  begin_motion();
  if (same) {
    clock.base = lsdcd::Time(data[0]) + lsdcd::Time(data[1]);
    clock.base_step = static_cast<bigint>(data[2]);
    clock.step = static_cast<bigint>(data[3]);
    clock.dt = data[4];
    for (std::size_t i = 0; i < n_terms; i++) {
      const double *v = &data[kTerms + 1 + kOfTerm * i];
      settings.motion.terms()[i].displacement = {v[0], v[1], v[2]};
      settings.motion.terms()[i].speed = {v[3], v[4], v[5]};
    }
    pose = settings.motion.pose_at(clock.now());
  } else if (!tokens.empty()) {
    warn("the restart file was written with the motion '" + tokens + "' and this fix has " +
         (settings.motion.moves() ? "'" + settings.motion_tokens + "', which begins"
                                  : "none: the "
                                    "mesh stays") +
         " where the mesh was; the phase is not carried over");
  }
  if (!same_line)
    warn("the restart file was written with a servo along another line, or this fix has none: the "
         "mesh is where that had it, at " +
         lsdcd::number_text(was.position) + ", and its state is not carried over");
  make_engine_that_moves();
}
