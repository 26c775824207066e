// Another motion for a mesh: between runs, and from a restart file.

#include "lammps/fix_wall_lsdcd.h"

#include "deck/motion_words.h"

#include <cstring>

using namespace LAMMPS_NS;

int FixWallLsdcd::modify_param(int narg, char **arg)
{
  if (std::strcmp(arg[0], "motion") != 0) return 0;
  try {
    const lsdcd::ModifiedMotion read =
        lsdcd::read_modified_motion(std::vector<std::string>(arg, arg + narg));
    // It begins where the mesh is.
    settings.motion.stop();
    settings.motion.begin_from(pose);
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
  for (const lsdcd::WallPose &p : {settings.motion.start(), pose}) {
    for (const lsdcd::Vec3 &row : p.row) data.insert(data.end(), {row.x, row.y, row.z});
    data.insert(data.end(), {p.shift.x, p.shift.y, p.shift.z});
  }
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

// The same words go on in the step where they were; with others the mesh stays where it was, and
// these begin there. Collective.
void FixWallLsdcd::restart_motion(const std::vector<double> &data)
{
  constexpr int kClock = 5, kPose = 12, kTerms = kClock + 2 * kPose, kOfTerm = 6;
  const std::size_t n_terms = static_cast<std::size_t>(data[kTerms]);
  const std::string tokens(data.begin() + kTerms + 1 + kOfTerm * n_terms, data.end());
  const lsdcd::WallPose first = pose_from(&data[kClock]), last = pose_from(&data[kClock + kPose]);
  const bool same = tokens == settings.motion_tokens;
  settings.motion.begin_from(same ? first : last);
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
  make_engine_that_moves();
}
