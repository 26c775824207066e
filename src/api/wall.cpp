// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_wall_*
#include "wall/wall.h"

#include "api/c_border.h"
#include "api/call_threads.h"
#include "base/input_words.h"
#include "input/settings.h"
#include "wall/own_memory.h"
#include "wall/shared_material.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

using namespace lsdcd;

namespace {

// The program that calls the library: one process.
class Caller : public Host {
 public:
  explicit Caller(const lsdcd_wall_options &o) : show_(o.show), data_(o.data)
  {
    bool any = false;
    for (int k = 0; k < 3; k++) any |= o.lo[k] != 0 || o.hi[k] != 0 || o.periodic[k] != 0;
    for (int k = 0; k < 3 && any; k++) {
      if (!(o.lo[k] < o.hi[k]) || !std::isfinite(o.hi[k] - o.lo[k]))
        throw ApiError(LSDCD_ERROR_ARGUMENT,
                       "`lsdcd_wall_options`: lo must be below hi along each axis; leave both 0 "
                       "where spheres go anywhere");
      box_.corner[k] = o.lo[k];
      box_.edge[k] = {0, 0, 0};
      box_.edge[k][k] = o.hi[k] - o.lo[k];
      box_.periodic[k] = o.periodic[k] != 0;
    }
    for (int k = 0; k < 3 && !any; k++) box_.face_follows[k][0] = box_.face_follows[k][1] = true;
    if (!(o.margin >= 0) || (box_.any_periodic() && o.margin == 0))
      throw ApiError(LSDCD_ERROR_ARGUMENT,
                     "`lsdcd_wall_options`: margin is " + number_text(o.margin) +
                         "; with a periodic box say how far past a face a sphere may go");
    box_.margin = o.margin;
  }

  void sum(Real *, int) override {}
  void max(Real *, int) override {}
  int max_rank(Real &) override { return 0; }
  void broadcast(void *, std::size_t, int) override {}
  std::vector<Real> gather(const std::vector<Real> &mine) override { return mine; }
  void fail_together(const std::string &error) override
  {
    if (!error.empty()) throw InputError(error);
  }
  std::vector<Real> variables(const std::vector<std::string> &names) override
  {
    check_variables(names);
    return {};
  }
  void check_variables(const std::vector<std::string> &names) override
  {
    if (!names.empty())
      throw InputError(
          "v_" + names.front() +
          ": there are no variables here; give numbers, and change them between steps");
  }
  std::unique_ptr<NodeMemory> node_memory() override { return std::make_unique<OwnMemory>(*this); }
  int rank() const override { return 0; }
  PeriodicBox box() const override { return box_; }
  SphereGroup group() const override { return {"all", false}; }
  Spheres spheres_on_cpu() override { return spheres; }
  std::int64_t tag(int sphere) override { return tags[sphere]; }
  std::int64_t highest_tag() override { return last_tag_; }
  Real radius_of_tag(std::int64_t tag) override
  {
    const auto at = std::find(tags.begin(), tags.end(), tag);
    return at == tags.end() ? 0 : spheres.radius[at - tags.begin()];
  }
  void log(const std::string &text) override { show(0, text); }
  void warn(const std::string &text) override { show(1, text); }

  std::int64_t next_tag() { return ++last_tag_; }

  Spheres spheres;                   // of the step that is under way
  std::vector<std::int64_t> tags;    // by order of coming

 private:
  void show(int warning, const std::string &text)
  {
    if (show_) show_(data_, warning, text.c_str());
  }

  PeriodicBox box_;
  lsdcd_message *show_;
  void *data_;
  std::int64_t last_tag_ = 0;
};

std::vector<std::string> words_of(const char *const *words, std::size_t n)
{
  if (n > 0) need(words, "words");
  std::vector<std::string> all;
  for (std::size_t i = 0; i < n; i++) {
    need(words[i], "words[i]");
    all.push_back(words[i]);
  }
  return all;
}

// A word too few would be read past the end.
void need_words(const std::vector<std::string> &words, const char *what)
{
  if (words.empty())
    throw ApiError(LSDCD_ERROR_ARGUMENT, std::string("there are no words: ") + what);
}

}    // namespace

struct lsdcd_wall {
  Caller caller;
  int threads;
  std::int64_t number = 0;    // of the last step
  Real dt = 0;
  bool begun = false;
  std::vector<Real> kept;    // restored histories, until the first step
  std::unique_ptr<Wall> in;

  explicit lsdcd_wall(const lsdcd_wall_options &o) : caller(o), threads(o.threads) {}
};

namespace {

Spheres spheres_of(const lsdcd_spheres &s, const WallSettings &wall)
{
  Spheres out;
  out.n = static_cast<int>(s.n);
  if (s.n == 0) return out;
  const struct {
    const void *pointer;
    const char *name;
  } needed[] = {{s.x, "x"},       {s.v, "v"},         {s.omega, "omega"},  {s.radius, "radius"},
                {s.mass, "mass"}, {s.force, "force"}, {s.torque, "torque"}};
  for (const auto &one : needed) need(one.pointer, one.name);
  if (wall.law.has_heat()) {
    need(s.temperature, "temperature");
    need(s.heat, "heat");
  }
  if (wall.laws.kinds > 1) {
    need(s.type, "type");
    for (std::size_t i = 0; i < s.n; i++)
      if (s.type[i] < 1)
        throw ApiError(LSDCD_ERROR_ARGUMENT, "type[" + std::to_string(i) + "] is " +
                                                 std::to_string(s.type[i]) + ", below 1");
  }
  const std::ptrdiff_t row = s.row ? s.row : 3;
  out.x = {s.x, row, 1};
  out.v = {s.v, row, 1};
  out.omega = {s.omega, row, 1};
  out.force = {s.force, row, 1};
  out.torque = {s.torque, row, 1};
  out.radius = s.radius;
  out.mass = s.mass;
  out.temperature = s.temperature;
  out.heat_flow = s.heat;
  out.type = s.type;
  return out;
}

// New spheres have numbers of their own; none leave but by lsdcd_wall_renumber().
void count_spheres(lsdcd_wall &wall, std::size_t n)
{
  std::vector<std::int64_t> &tags = wall.caller.tags;
  if (n > 0x7fffffffu)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "n is " + std::to_string(n) + ", more than an int counts");
  if (n < tags.size())
    throw ApiError(LSDCD_ERROR_ARGUMENT, "there are " + std::to_string(n) +
                                             " spheres and there were " +
                                             std::to_string(tags.size()) +
                                             ": say by lsdcd_wall_renumber() which are left");
  while (tags.size() < n) tags.push_back(wall.caller.next_tag());
  wall.in->history().grow(static_cast<int>(n));
}

// Restored numbers: of the wall, then a size and that many for each sphere.
void unpack_kept(lsdcd_wall &wall)
{
  HistoryExchange &history = wall.in->history();
  history.on_host();
  const std::size_t n = static_cast<std::size_t>(wall.kept[0]);
  if (n != wall.caller.tags.size())
    throw ApiError(LSDCD_ERROR_ARGUMENT, "what was restored has " + std::to_string(n) +
                                             " spheres, and this step has " +
                                             std::to_string(wall.caller.tags.size()));
  const Real *at = wall.kept.data() + 1;
  for (std::size_t i = 0; i < n; i++) {
    const int size = static_cast<int>(*at++);
    history.unpack_restart(static_cast<int>(i), at, size);
    at += size;
  }
  wall.kept.clear();
}

void check_mesh(const lsdcd_wall &wall, int mesh, int least)
{
  const int n = static_cast<int>(wall.in->meshes().size());
  if (mesh < least || mesh >= n)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "mesh is " + std::to_string(mesh) + "; this wall has " +
                                             std::to_string(n) + ", counted from 0");
}

}    // namespace

extern "C" {

int lsdcd_wall_make(const char *const *words, size_t n, const lsdcd_wall_options *options,
                    lsdcd_wall **wall)
{
  return guard([&] {
    need(wall, "wall");
    lsdcd_wall_options o = {};
    if (options) o = checked(options, "lsdcd_wall_options");
    check_threads(o.threads);
    const CallThreads threads(o.threads);
    std::vector<std::string> all = words_of(words, n);
    need_words(all, "a contact style, its numbers and `mesh FILE` make a wall");
    auto made = std::make_unique<lsdcd_wall>(o);
    const FilledTokens filled = fill_material(made->caller, all, o.units ? o.units : "si");
    made->in = std::make_unique<Wall>(made->caller, parse_settings(filled.tokens), WallUnits(),
                                      WallPlace(), filled.report, StepClock{o.time, 0, 0, 0});
    made->in->begin_run(0, false);
    *wall = made.release();
  });
}

int lsdcd_wall_step_spheres(lsdcd_wall *wall, const lsdcd_spheres *spheres,
                            const lsdcd_wall_step *step)
{
  return guard([&] {
    need(wall, "wall");
    const lsdcd_spheres given = checked(spheres, "lsdcd_spheres", offsetof(lsdcd_spheres, type));
    const lsdcd_wall_step what = checked(step, "lsdcd_wall_step");
    if (!(what.dt > 0) || !std::isfinite(what.dt))
      throw ApiError(LSDCD_ERROR_ARGUMENT, "dt is " + number_text(what.dt) + ", not above 0");
    if (!(what.reach >= 0))
      throw ApiError(LSDCD_ERROR_ARGUMENT, "reach is " + number_text(what.reach) + ", below 0");
    const Spheres s = spheres_of(given, wall->in->settings());
    const bool came = given.n > wall->caller.tags.size();
    count_spheres(*wall, given.n);
    if (!wall->kept.empty()) unpack_kept(*wall);
    wall->caller.spheres = s;
    wall->dt = what.dt;
    const CallThreads threads(wall->threads);

    StepInput input;
    const bool first = !wall->begun;
    if (!what.setup) wall->number++;
    input.step = {wall->number, what.dt, what.setup ? Step::setup : Step::step};
    input.look = input.new_spheres = first || came || what.setup || what.changed;
    input.box_changes = wall->caller.box().any_follows();
    input.drift.kind = SphereDrift::watched;
    input.drift.distance = what.reach;
    if (what.reach == 0)
      for (int i = 0; i < s.n; i++)
        input.drift.distance = std::max(input.drift.distance, 0.1 * s.radius[i]);
    wall->begun = true;
    try {
      wall->in->begin(s, input);
      wall->in->finish(s);
      // Each step: what was left out must not be known many steps later only.
      wall->in->before_exchange(wall->number, wall->caller.box().any_periodic());
      if (!what.setup && wall->in->files_every() > 0) wall->in->write_due_files();
    } catch (const ProcessError &e) {
      throw InputError(e.what());
    }
  });
}

int lsdcd_wall_renumber(lsdcd_wall *wall, const ptrdiff_t *from, size_t n)
{
  return guard([&] {
    need(wall, "wall");
    if (n > 0) need(from, "from");
    const std::vector<std::int64_t> old = wall->caller.tags;
    std::vector<char> taken(old.size(), 0);
    for (std::size_t i = 0; i < n; i++) {
      if (from[i] == -1) continue;
      if (from[i] < -1 || static_cast<std::size_t>(from[i]) >= old.size() || taken[from[i]]++)
        throw ApiError(LSDCD_ERROR_ARGUMENT,
                       "from[" + std::to_string(i) + "] is " + std::to_string(from[i]) +
                           ": each is a sphere of the last step, from 0 and once, or -1");
    }
    if (!wall->kept.empty())
      throw ApiError(LSDCD_ERROR_ARGUMENT,
                     "spheres keep their order until the step after a restore");
    HistoryExchange &history = wall->in->history();
    std::vector<std::vector<Real>> packed(n);
    if (history.is_kept()) {
      ContactHistory &all = history.on_host();
      for (std::size_t i = 0; i < n; i++) {
        if (from[i] < 0) continue;
        const int k = static_cast<int>(from[i]);
        packed[i].resize(all.packed_size(k));
        all.pack(k, packed[i].data());
      }
      history.grow(static_cast<int>(std::max(n, old.size())));
      for (std::size_t i = 0; i < std::max(n, old.size()); i++) {
        all.clear(static_cast<int>(i));
        if (i < n && !packed[i].empty()) all.unpack(static_cast<int>(i), packed[i].data());
      }
    }
    wall->caller.tags.clear();
    for (std::size_t i = 0; i < n; i++)
      wall->caller.tags.push_back(from[i] < 0 ? wall->caller.next_tag() : old[from[i]]);
    wall->begun = false;    // the next step looks at all
  });
}

int lsdcd_wall_get_totals(lsdcd_wall *wall, int mesh, lsdcd_wall_totals *totals)
{
  return guard([&] {
    need(wall, "wall");
    lsdcd_wall_totals out = checked(totals, "lsdcd_wall_totals");
    check_mesh(*wall, mesh, -1);
    const StepTotals &all = wall->in->totals();
    const MeshTotals t = mesh < 0 ? all.of_all() : all.mesh(mesh);
    for (int k = 0; k < 3; k++) {
      out.force[k] = t.force[k];
      out.torque[k] = t.torque[k];
      out.servo[k] = 0;
    }
    out.contacts = t.contacts;
    out.overlap = t.overlap;
    out.uncertified = t.uncertified;
    out.power = t.power;
    out.energy = t.energy;
    out.worn = 0;
    for (const MeshPart &m : wall->in->meshes())
      if (mesh < 0 || mesh == m.index) out.worn += wall->in->worn(m.index);
    if (mesh >= 0 && wall->in->meshes()[mesh].servo().present) {
      const Servo &s = wall->in->meshes()[mesh].servo();
      out.servo[0] = s.position;
      out.servo[1] = s.velocity;
      out.servo[2] = wall->in->servo_push(mesh);
    }
    copy_out(out, totals);
  });
}

int lsdcd_wall_get_pose(lsdcd_wall *wall, int mesh, double *matrix)
{
  return guard([&] {
    need(wall, "wall");
    need(matrix, "matrix");
    check_mesh(*wall, mesh, 0);
    const WallPose &pose = wall->in->meshes()[mesh].motion.pose();
    for (int k = 0; k < 3; k++)
      for (int d = 0; d < 4; d++) matrix[4 * k + d] = d < 3 ? pose.row[k][d] : pose.shift[k];
  });
}

int lsdcd_wall_change(lsdcd_wall *wall, const char *const *words, size_t n)
{
  return guard([&] {
    need(wall, "wall");
    const std::vector<std::string> all = words_of(words, n);
    need_words(all, "[mesh K] motion ... or [mesh K] servo ...");
    const int taken = wall->in->change(all, {wall->number, wall->dt});
    if (static_cast<std::size_t>(taken) != all.size())
      throw ApiError(LSDCD_ERROR_ARGUMENT, "'" + all[taken] +
                                               "' is no word of [mesh K] motion ... or [mesh K] "
                                               "servo ...");
  });
}

int lsdcd_wall_save(lsdcd_wall *wall, double *numbers, size_t room, size_t *count)
{
  return guard([&] {
    need(wall, "wall");
    need(count, "count");
    if (room > 0) need(numbers, "numbers");
    std::vector<Real> all = wall->in->state();
    all.insert(all.begin(), static_cast<Real>(all.size()));
    const std::size_t n = wall->in->history().is_kept() ? wall->caller.tags.size() : 0;
    all.push_back(static_cast<Real>(n));
    std::vector<Real> packed(1 + wall->in->history().max_packed_size());
    for (std::size_t i = 0; i < n; i++) {
      const int size = wall->in->pack_restart(static_cast<int>(i), packed.data());
      all.push_back(size);
      all.insert(all.end(), packed.begin(), packed.begin() + size);
    }
    *count = all.size();
    std::copy_n(all.begin(), std::min(room, all.size()), numbers);
  });
}

int lsdcd_wall_restore(lsdcd_wall *wall, const double *numbers, size_t count)
{
  return guard([&] {
    need(wall, "wall");
    need(numbers, "numbers");
    if (wall->begun)
      throw ApiError(LSDCD_ERROR_ARGUMENT, "a wall is restored before its first step");
    // Sizes first: nothing is changed where the numbers end early.
    const auto whole = [&](std::size_t at) {
      return at < count && numbers[at] >= 0 && numbers[at] < static_cast<double>(count - at);
    };
    std::size_t at = 0;
    bool good = whole(0);
    if (good) at = 1 + static_cast<std::size_t>(numbers[0]);
    const std::size_t first = at;
    good = good && at < count && numbers[at] >= 0;
    if (good) {
      const double n = numbers[at++];
      for (double i = 0; i < n && good; i++) {
        good = whole(at);
        if (good) at += 1 + static_cast<std::size_t>(numbers[at]);
      }
    }
    if (!good || at != count)
      throw ApiError(LSDCD_ERROR_ARGUMENT,
                     "these are not the numbers that lsdcd_wall_save() wrote, all of them");
    wall->in->restore(numbers + 1, first - 1, {wall->number, wall->dt});
    wall->kept.assign(numbers + first, numbers + count);
    if (!wall->in->history().is_kept()) wall->kept.clear();
  });
}

void lsdcd_wall_free(lsdcd_wall *wall)
{
  delete wall;
}
}
