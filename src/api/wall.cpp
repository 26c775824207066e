// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_wall_*
#include "wall/wall.h"

#include "api/c_border.h"
#include "api/call_threads.h"
#include "api/device_memory.h"
#include "api/wall_caller.h"
#include "backend/cuda_available.h"
#include "base/input_words.h"
#include "engine/step/law_job.h"
#include "input/settings.h"
#include "mesh/outside_box.h"
#include "wall/shared_material.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

using namespace lsdcd;

namespace {

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
  WallCaller caller;
  std::unique_ptr<GpuArrays> gpu;    // that has the arrays of spheres; null: the host has
  int threads;
  std::int64_t number = 0;    // of the last step
  Real dt = 0;
  bool begun = false;         // since spheres were numbered anew, too
  Real largest_radius = 0;    // of this process, in the last step that looked
  Failure late;               // of this process, which all are told in the next call
  std::vector<Real> kept;     // restored histories, until the first step
  bool outside_told = false;
  std::unique_ptr<Wall> in;

  explicit lsdcd_wall(const lsdcd_wall_options &o) : caller(o), threads(o.threads) {}

  // A step does not wait for other processes, nor for a GPU, to know of errors.
  bool tells_late() const { return gpu || !caller.is_alone(); }
};

namespace {

// What every function of a wall does: its GPU is current.
template <class Body>
int guard_wall(lsdcd_wall *wall, const Body &body) noexcept
{
  return guard([&] {
    need(wall, "wall");
    if (wall->gpu)
      wall->gpu->run(body);
    else
      body();
  });
}

// Before anything is read or written there.
void check_places(const lsdcd_spheres &s, const GpuArrays *gpu)
{
  const struct {
    const void *pointer;
    const char *name;
  } given[] = {{s.x, "x"},           {s.v, "v"},       {s.omega, "omega"},
               {s.radius, "radius"}, {s.mass, "mass"}, {s.force, "force"},
               {s.torque, "torque"}, {s.type, "type"}, {s.temperature, "temperature"},
               {s.heat, "heat"}};
  const DeviceMemory device;
  for (const auto &one : given) {
    if (!one.pointer) continue;
    if (!gpu && device.only_there(one.pointer))
      throw ApiError(LSDCD_ERROR_DEVICE,
                     std::string("the array `") + one.name +
                         "` is in a GPU's memory: make the wall with device LSDCD_CUDA");
    try {
      if (gpu) gpu->check(one.pointer, one.name, "the wall");
    } catch (const InputError &e) {
      throw ApiError(LSDCD_ERROR_DEVICE,
                     std::string(e.what()) + ": make the wall where the arrays of spheres are");
    }
  }
}

// Numbers of spheres: `width` of them in each row.
struct Rows {
  const double *at;
  const char *name;
  std::ptrdiff_t row, width;
};

// Do n rows of each have a number in common? Rows of one array may lie between those of another.
bool share_memory(const Rows &a, const Rows &b, std::ptrdiff_t n)
{
  constexpr std::ptrdiff_t kNumber = sizeof(double);
  const auto first = reinterpret_cast<std::intptr_t>(a.at),
             second = reinterpret_cast<std::intptr_t>(b.at);
  if (a.row == b.row) {
    const std::ptrdiff_t row = kNumber * a.row, apart = second - first;
    if (apart >= n * row || -apart >= n * row) return false;
    const std::ptrdiff_t behind = (apart % row + row) % row;
    return behind < kNumber * a.width || row - behind < kNumber * b.width;
  }
  if (a.row < b.row) return share_memory(b, a, n);
  // The numbers of b have no gaps. Which row of a is the first that ends behind where they begin?
  const std::ptrdiff_t row = kNumber * a.row, width = kNumber * a.width;
  const std::ptrdiff_t k = second < first + width ? 0 : (second - first - width) / row + 1;
  return k < n && first + k * row < second + n * kNumber;
}

// Arrays that are written have memory of their own: forces that are torques, too, are neither.
void check_apart(const lsdcd_spheres &s, std::ptrdiff_t row)
{
  const Rows all[] = {{s.force, "force", row, 3},
                      {s.torque, "torque", row, 3},
                      {s.heat, "heat", 1, 1},
                      {s.x, "x", row, 3},
                      {s.v, "v", row, 3},
                      {s.omega, "omega", row, 3},
                      {s.radius, "radius", 1, 1},
                      {s.mass, "mass", 1, 1},
                      {s.temperature, "temperature", 1, 1}};
  constexpr std::size_t kWritten = 3, kAll = sizeof all / sizeof all[0];
  for (std::size_t i = 0; i < kWritten; i++)
    for (std::size_t j = i + 1; j < kAll; j++)
      if (all[i].at && all[j].at && share_memory(all[i], all[j], static_cast<std::ptrdiff_t>(s.n)))
        throw ApiError(LSDCD_ERROR_ARGUMENT, std::string("`") + all[i].name + "` and `" +
                                                 all[j].name +
                                                 "` share memory: give each an array of its own");
}

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
  if (wall.laws.kinds > 1) need(s.type, "type");
  const std::ptrdiff_t row = s.row ? s.row : 3;
  if (row < 3 && s.n > 1)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "row is " + std::to_string(row) +
                                             ": vectors of 3 numbers need 3 or more, 0 is 3");
  check_apart(s, s.n > 1 ? row : 3);
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

void check_types(const Spheres &s, const WallSettings &wall)
{
  for (int i = 0; wall.laws.kinds > 1 && i < s.n; i++)
    if (s.type[i] < 1)
      throw ApiError(LSDCD_ERROR_ARGUMENT, "type[" + std::to_string(i) + "] is " +
                                               std::to_string(s.type[i]) + ", below 1");
}

[[noreturn]] void refuse_sphere(const char *name, int i, const std::string &what)
{
  throw ApiError(LSDCD_ERROR_ARGUMENT,
                 std::string(name) + "[" + std::to_string(i) + "] is " + what);
}

// Nothing touches a radius below 0, and a mass of 0 has no damping.
void check_sizes(const Spheres &s)
{
  for (int i = 0; i < s.n; i++) {
    if (!(s.radius[i] >= 0) || !std::isfinite(s.radius[i]))
      refuse_sphere("radius", i, number_text(s.radius[i]) + "; it is 0 or more, and finite");
    if (!(s.mass[i] > 0) || !std::isfinite(s.mass[i]))
      refuse_sphere("mass", i, number_text(s.mass[i]) + "; it is above 0, and finite");
  }
}

std::string place_text(const Vec3 &x)
{
  return number_text(x.x) + " " + number_text(x.y) + " " + number_text(x.z);
}

// Nothing touches a place that is no number. In each step, so with a few operations for each sphere.
Box checked_extents(const Spheres &s)
{
  Box around = {kNoLimit.hi, kNoLimit.lo};
  Vec3 zero = {0, 0, 0};    // unless one is no number
  for (int i = 0; i < s.n; i++) {
    const Vec3 x = s.x[i];
    zero += 0 * x;
    around.lo = {std::min(around.lo.x, x.x), std::min(around.lo.y, x.y),
                 std::min(around.lo.z, x.z)};
    around.hi = {std::max(around.hi.x, x.x), std::max(around.hi.y, x.y),
                 std::max(around.hi.z, x.z)};
  }
  for (int i = 0; i < s.n && !(norm_sq(zero) == 0); i++)
    if (!(norm_sq(0 * s.x[i]) == 0))
      refuse_sphere("x", i,
                    place_text(s.x[i]) +
                        ", which is no place: a shorter dt, or softer contacts, may help");
  return around;
}

// How many centres are outside of a box that neither repeats nor follows them, and the first.
struct Outside {
  std::size_t n = 0;
  int first = 0;
};

Outside outside(const PeriodicBox &box, const Spheres &s, const Box &extents)
{
  Outside found;
  Box room = kNoLimit;
  bool all_in = true;
  for (int k = 0; k < 3; k++) {
    if (box.periodic[k] || box.follows(k)) continue;
    room.lo[k] = box.corner[k];
    room.hi[k] = box.corner[k] + box.edge[k][k];
    all_in = all_in && extents.lo[k] >= room.lo[k] && extents.hi[k] <= room.hi[k];
  }
  for (int i = all_in ? -1 : s.n - 1; i >= 0; i--) {
    const Vec3 x = s.x[i];
    if (overlap(Box{x, x}, room)) continue;
    found.n++;
    found.first = i;
  }
  return found;
}

// Spheres do not leave but by lsdcd_wall_renumber().
void check_count(const lsdcd_wall &wall, std::size_t n)
{
  const std::size_t before = wall.caller.tags.size();
  if (n > 0x7fffffffu)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "n is " + std::to_string(n) + ", more than an int counts");
  if (n < before)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "there are " + std::to_string(n) +
                                             " spheres and there were " + std::to_string(before) +
                                             ": say by lsdcd_wall_renumber() which are left");
  if (!wall.kept.empty() && wall.kept[0] != static_cast<Real>(n))
    throw ApiError(LSDCD_ERROR_ARGUMENT, "what was restored has " + number_text(wall.kept[0]) +
                                             " spheres, and this step has " + std::to_string(n));
}

// Restored numbers: of the wall, then a size and that many for each sphere.
void unpack_kept(lsdcd_wall &wall)
{
  HistoryExchange &history = wall.in->history();
  history.on_host();
  const int n = static_cast<int>(wall.kept[0]);
  const Real *at = wall.kept.data() + 1;
  for (int i = 0; i < n; i++) {
    const int size = static_cast<int>(*at++);
    history.unpack_restart(i, at, size);
    at += size;
  }
  wall.kept.clear();
}

// What this process wants of a step.
struct StepWanted {
  Spheres spheres;
  lsdcd_wall_step step = {};
  bool look = false;
  Outside outside;
};

StepWanted step_wanted(lsdcd_wall &wall, const lsdcd_spheres *spheres, const lsdcd_wall_step *step)
{
  StepWanted want;
  const lsdcd_spheres given = checked(spheres, "lsdcd_spheres", offsetof(lsdcd_spheres, type));
  want.step = checked(step, "lsdcd_wall_step");
  if (!(want.step.dt > 0) || !std::isfinite(want.step.dt))
    throw ApiError(LSDCD_ERROR_ARGUMENT, "dt is " + number_text(want.step.dt) + ", not above 0");
  if (!(want.step.reach >= 0))
    throw ApiError(LSDCD_ERROR_ARGUMENT, "reach is " + number_text(want.step.reach) + ", below 0");
  check_count(wall, given.n);
  want.spheres = spheres_of(given, wall.in->settings());
  if (given.n > 0) check_places(given, wall.gpu.get());
  wall.caller.set_spheres(want.spheres);
  const bool came = given.n > wall.caller.tags.size();
  want.look = !wall.begun || came || want.step.setup || want.step.changed;
  if (!want.look && wall.gpu) return want;
  const Spheres s = wall.caller.spheres_on_cpu();
  const Box extents = checked_extents(s);
  if (!wall.outside_told) want.outside = outside(wall.caller.box(), s, extents);
  if (!want.look) return want;
  check_sizes(s);
  check_types(s, wall.in->settings());
  wall.largest_radius = 0;
  for (int i = 0; i < s.n; i++) wall.largest_radius = std::max(wall.largest_radius, s.radius[i]);
  return want;
}

// Once. Collective.
void warn_of_outside(lsdcd_wall &wall, const StepWanted &want)
{
  wall.outside_told = true;
  WallCaller &host = wall.caller;
  Real n = static_cast<Real>(want.outside.n), some = n > 0;
  host.sum(&n, 1);
  const int from = host.max_rank(some);
  std::string text;
  if (host.rank() == from) {
    const int i = want.outside.first;
    text = "x[" + std::to_string(i) + "]" +
           (host.is_alone() ? "" : " of process " + std::to_string(from)) + ", is at " +
           place_text(host.spheres_on_cpu().x[i]);
  }
  broadcast_text(host, text, from);
  const Box box = host.box().bounds({0, 0, 0});
  host.warn(number_text(n) + (n == 1 ? " sphere is" : " spheres are") +
            " outside of the box, where the wall may not reach: the first, " + text +
            "; the box has " + extents_text(box) +
            ". Give lo and hi that hold all centres, or neither. Shown once");
}

// The same on all processes.
StepWanted agreed(lsdcd_wall &wall, const Failure &failure, StepWanted want)
{
  lsdcd_wall_step &step = want.step;
  const Real reach = step.reach > 0 ? step.reach : 0.1 * wall.largest_radius;
  std::vector<Real> most = {step.dt,
                            -step.dt,
                            step.setup ? 1. : 0.,
                            step.setup ? 0. : 1.,
                            want.look ? 1. : 0.,
                            reach,
                            static_cast<Real>(wall.caller.highest_tag()),
                            want.outside.n > 0 ? 1. : 0.};
  wall.caller.agree(failure, most);
  if (most[0] != -most[1] || most[2] == most[3])
    throw ApiError(LSDCD_ERROR_ARGUMENT, "dt goes from " + number_text(-most[1]) + " to " +
                                             number_text(most[0]) + " over the processes" +
                                             (most[2] == most[3] ? ", and some set up" : "") +
                                             ": dt and setup are the same on all");
  want.look = most[4] > 0;
  step.reach = most[5];
  std::vector<std::int64_t> &tags = wall.caller.tags;
  tags.resize(want.spheres.n);
  if (want.look) wall.caller.name_new_spheres(static_cast<std::int64_t>(most[6]));
  if (most[7] > 0) warn_of_outside(wall, want);
  return want;
}

// What the last step has noted of spheres, where it was not told at once.
void note_late(lsdcd_wall &wall)
{
  if (!wall.tells_late() || wall.late.code != LSDCD_OK) return;
  wall.late = failure_of([&] { wall.in->poll_diagnostics(wall.number); });
}

// Throws it on all processes. Collective.
void tell_late(lsdcd_wall &wall)
{
  if (!wall.tells_late()) return;
  note_late(wall);
  std::vector<Real> none;
  wall.caller.agree(wall.late, none);
}

void take_step(lsdcd_wall &wall, const StepWanted &want)
{
  const Spheres &s = want.spheres;
  wall.in->history().grow(s.n);
  if (!wall.kept.empty()) unpack_kept(wall);
  wall.dt = want.step.dt;
  if (!want.step.setup) wall.number++;
  StepInput input;
  input.step = {wall.number, want.step.dt, want.step.setup ? Step::setup : Step::step};
  input.look = input.new_spheres = want.look;
  input.box_changes = wall.caller.box().any_follows();
  input.drift.kind = SphereDrift::watched;
  input.drift.distance = want.step.reach;
  wall.begun = true;
  wall.in->begin(s, input);
  // Each step, as what is left out: it must not be known many steps later only.
  if (wall.caller.box().any_periodic()) wall.in->check_wrapping();
  try {
    wall.in->finish(s);
    if (!wall.tells_late()) wall.in->poll_diagnostics(wall.number);
  } catch (const ProcessError &e) {
    if (wall.caller.is_alone()) throw InputError(e.what());
    wall.late = {LSDCD_ERROR_INPUT, e.what()};
  }
  if (!want.step.setup && wall.in->files_every() > 0) wall.in->write_due_files();
}

void check_order_is_free(const lsdcd_wall &wall)
{
  if (!wall.kept.empty())
    throw ApiError(LSDCD_ERROR_ARGUMENT, "spheres keep their order until the step after a restore");
}

void check_spheres(const lsdcd_wall &wall, const std::ptrdiff_t *spheres, std::size_t n,
                   const char *name)
{
  const std::ptrdiff_t there = static_cast<std::ptrdiff_t>(wall.caller.tags.size());
  for (std::size_t i = 0; i < n; i++)
    if (spheres[i] < 0 || spheres[i] >= there)
      throw ApiError(LSDCD_ERROR_ARGUMENT, std::string(name) + "[" + std::to_string(i) + "] is " +
                                               std::to_string(spheres[i]) + "; there are " +
                                               std::to_string(there) + " spheres, from 0");
}

// With which packed numbers begin: what contacts keep, and on how many meshes.
Real packed_kind(const lsdcd_wall &wall)
{
  return static_cast<Real>(wall.in->settings().law.history_kind()) +
         0x1p32 * static_cast<Real>(wall.in->meshes().size());
}

// Where the numbers of each sphere begin: its tag, then what ContactHistory packs.
std::vector<const double *> packed_spheres(const lsdcd_wall &wall, std::size_t n,
                                           const double *numbers, std::size_t count)
{
  const HistoryExchange &history = wall.in->history();
  const std::size_t per_contact = history.is_kept() ? history.numbers_per_contact() : 0;
  const double meshes = static_cast<double>(wall.in->meshes().size());
  std::vector<const double *> spheres;
  bool good = count > 0 && numbers[0] == packed_kind(wall);
  std::size_t at = 1;
  for (std::size_t i = 0; i < n && good; i++) {
    good = count - at >= 2 && numbers[at] >= 0 && numbers[at] < 0x1p53;
    if (!good) break;
    const double contacts = numbers[at + 1];
    good = contacts >= 0 && contacts <= (per_contact ? kMaxContacts : 0) &&
           contacts == std::floor(contacts) &&
           static_cast<std::size_t>(contacts) * per_contact <= count - at - 2;
    if (!good) break;
    spheres.push_back(numbers + at);
    at += 2;
    for (int k = 0; k < static_cast<int>(contacts); k++, at += per_contact)
      good &= numbers[at] >= 0 && numbers[at] < 0x1p32 * meshes;
  }
  if (!good || at != count)
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   "these are not the numbers that lsdcd_wall_pack() wrote for " +
                       std::to_string(n) + " spheres of such a wall");
  return spheres;
}

// Where the arrays of spheres are.
WallPlace place_of(const lsdcd_wall_options &o, const GpuArrays *gpu)
{
  if (!gpu) return {};
  const auto make = [stream = o.stream, device = gpu->device()](const EngineSettings &settings) {
    if (settings.device != Device::automatic)
      throw InputError("the keyword device is for arrays of the host: leave it out, as the wall "
                       "computes where the arrays of its spheres are");
    return make_cuda_engine_in_place(settings, device, stream);
  };
  return {make, true};
}

std::unique_ptr<GpuArrays> gpu_of(const lsdcd_wall_options &o)
{
  if (o.device != LSDCD_CPU && o.device != LSDCD_CUDA)
    refuse_option("lsdcd_wall_options", "device is neither LSDCD_CPU nor LSDCD_CUDA");
  if (o.device == LSDCD_CPU && o.stream)
    refuse_option("lsdcd_wall_options", "stream is given, but device is LSDCD_CPU");
  if (o.device == LSDCD_CPU) return nullptr;
  std::string why;
  if (!cuda_available(&why))
    throw ApiError(LSDCD_ERROR_DEVICE, "CUDA: " + why + "; use LSDCD_CPU, with arrays of the host");
  return make_gpu_arrays(o.stream);
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
    if (options) o = checked(options, "lsdcd_wall_options", offsetof(lsdcd_wall_options, host));
    check_threads(o.threads);
    const CallThreads threads(o.threads);
    std::vector<std::string> all = words_of(words, n);
    need_words(all, "a contact style, its numbers and `mesh FILE` make a wall");
    auto made = std::make_unique<lsdcd_wall>(o);
    made->gpu = gpu_of(o);
    made->caller.gpu = made->gpu.get();
    const FilledTokens filled = fill_material(made->caller, all, o.units ? o.units : "si");
    made->in = std::make_unique<Wall>(made->caller, parse_settings(filled.tokens), WallUnits(),
                                      place_of(o, made->gpu.get()), filled.report,
                                      StepClock{o.time, 0, 0, 0});
    made->caller.wall = made->in.get();
    made->in->begin_run(0, false);
    *wall = made.release();
  });
}

int lsdcd_wall_step_spheres(lsdcd_wall *wall, const lsdcd_spheres *spheres,
                            const lsdcd_wall_step *step)
{
  return guard_wall(wall, [&] {
    const CallThreads threads(wall->threads);
    note_late(*wall);
    StepWanted want;
    Failure failure = wall->late;
    if (failure.code == LSDCD_OK)
      failure = failure_of([&] { want = step_wanted(*wall, spheres, step); });
    take_step(*wall, agreed(*wall, failure, want));
  });
}

int lsdcd_wall_renumber(lsdcd_wall *wall, const ptrdiff_t *from, size_t n)
{
  return guard_wall(wall, [&] {
    if (n > 0) need(from, "from");
    note_late(*wall);    // of spheres by the numbers that they have
    const std::vector<std::int64_t> old = wall->caller.tags;
    std::vector<char> taken(old.size(), 0);
    for (std::size_t i = 0; i < n; i++) {
      if (from[i] == -1) continue;
      if (from[i] < -1 || static_cast<std::size_t>(from[i]) >= old.size() || taken[from[i]]++)
        throw ApiError(LSDCD_ERROR_ARGUMENT,
                       "from[" + std::to_string(i) + "] is " + std::to_string(from[i]) +
                           ": each is a sphere of the last step, from 0 and once, or -1");
    }
    check_order_is_free(*wall);
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
    for (std::size_t i = 0; i < n; i++) wall->caller.tags.push_back(from[i] < 0 ? 0 : old[from[i]]);
    wall->begun = false;    // the next step looks at all
  });
}

int lsdcd_wall_pack(lsdcd_wall *wall, const ptrdiff_t *which, size_t n, double *numbers,
                    size_t room, size_t *count)
{
  return guard_wall(wall, [&] {
    need(count, "count");
    if (n > 0) need(which, "which");
    if (room > 0) need(numbers, "numbers");
    check_order_is_free(*wall);
    check_spheres(*wall, which, n, "which");
    const bool keeps = wall->in->history().is_kept();
    const ContactHistory &history = wall->in->history().on_host();
    std::vector<Real> all = {packed_kind(*wall)}, packed(1);
    for (std::size_t i = 0; i < n; i++) {
      const int k = static_cast<int>(which[i]);
      packed.assign(keeps ? history.packed_size(k) : 1, 0);
      if (keeps) history.pack(k, packed.data());
      all.push_back(static_cast<Real>(wall->caller.tags[k]));
      all.insert(all.end(), packed.begin(), packed.end());
    }
    *count = all.size();
    std::copy_n(all.begin(), std::min(room, all.size()), numbers);
  });
}

int lsdcd_wall_unpack(lsdcd_wall *wall, const ptrdiff_t *to, size_t n, const double *numbers,
                      size_t count)
{
  return guard_wall(wall, [&] {
    need(numbers, "numbers");
    if (n > 0) need(to, "to");
    check_order_is_free(*wall);
    check_spheres(*wall, to, n, "to");
    const std::vector<const double *> spheres = packed_spheres(*wall, n, numbers, count);
    const bool keeps = wall->in->history().is_kept();
    ContactHistory &history = wall->in->history().on_host();
    for (std::size_t i = 0; i < n; i++) {
      wall->caller.tags[to[i]] = static_cast<std::int64_t>(spheres[i][0]);
      if (keeps) history.unpack(static_cast<int>(to[i]), spheres[i] + 1);
    }
  });
}

int lsdcd_wall_get_totals(lsdcd_wall *wall, int mesh, lsdcd_wall_totals *totals)
{
  return guard_wall(wall, [&] {
    lsdcd_wall_totals out = checked(totals, "lsdcd_wall_totals");
    check_mesh(*wall, mesh, -1);
    tell_late(*wall);
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
  return guard_wall(wall, [&] {
    need(matrix, "matrix");
    check_mesh(*wall, mesh, 0);
    const Pose &pose = wall->in->meshes()[mesh].motion.pose();
    for (int k = 0; k < 3; k++)
      for (int d = 0; d < 4; d++) matrix[4 * k + d] = d < 3 ? pose.row[k][d] : pose.shift[k];
  });
}

int lsdcd_wall_change(lsdcd_wall *wall, const char *const *words, size_t n)
{
  return guard_wall(wall, [&] {
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
  return guard_wall(wall, [&] {
    need(count, "count");
    if (room > 0) need(numbers, "numbers");
    tell_late(*wall);
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
  return guard_wall(wall, [&] {
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
  if (wall && wall->gpu)
    guard_wall(wall, [&] {
      wall->gpu->wait();
      wall->in.reset();
    });
  delete wall;
}
}
