// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_wall_step_spheres and lsdcd_wall_renumber.
#include "api/call_threads.h"
#include "api/refusals.h"
#include "api/spheres_given.h"
#include "api/wall_handle.h"
#include "base/input_words.h"
#include "base/vector_text.h"
#include "box/outside_box.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

using namespace lsdcd;

namespace {

// Spheres do not leave but by lsdcd_wall_renumber().
void check_count(const lsdcd_wall &wall, std::size_t n)
{
  const std::size_t before = wall.caller.tags.size();
  if (wall.is_restored && before > 0 && n != before)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "what was restored has " + std::to_string(before) +
                                             " spheres, and this step has " + std::to_string(n));
  if (n > 0x7fffffffu)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "n is " + std::to_string(n) + ", more than an int counts");
  if (n < before)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "n is " + std::to_string(n) + ", and it was " +
                                             std::to_string(before) +
                                             ": tell by lsdcd_wall_renumber() which ones are left");
}

// The wishes of this process for a step.
struct StepWanted {
  Spheres spheres;
  lsdcd_wall_step step = {};
  bool look = false;
  Outside outside;
};

// Bodies step by velocity Verlet, so that their velocities are always those of half a step before.
void check_synchronous(const lsdcd_wall &wall, const lsdcd_wall_step &step)
{
  checked_flag(step.synchronous, "synchronous");
  for (const MeshPart &m : wall.in->meshes())
    if (step.synchronous && m.body)
      throw ApiError(
          LSDCD_ERROR_ARGUMENT,
          "synchronous is 1, and " + m.spec.name +
              " is a body, which steps by velocity Verlet: integrate the spheres likewise");
}

// Throws where the words have a v_NAME that the program has given no value.
void check_inputs(const lsdcd_wall &wall)
{
  const InputNames &names = wall.in->spec().inputs;
  if (names.empty()) return;
  for (const int input : wall.in->inputs_read()) {
    const std::size_t k = static_cast<std::size_t>(input);
    if (k >= wall.inputs.size() || !wall.inputs[k])
      throw ApiError(LSDCD_ERROR_ARGUMENT, "v_" + names[k] +
                                               " has no value: give it one before the step, by "
                                               "lsdcd_wall_set_input()");
  }
}

StepWanted step_wanted(lsdcd_wall &wall, const lsdcd_spheres *spheres, const lsdcd_wall_step *step)
{
  StepWanted want;
  const lsdcd_spheres given = checked(spheres, "lsdcd_spheres");
  want.step = checked(step, "lsdcd_wall_step");
  checked_flag(want.step.setup, "setup");
  checked_flag(want.step.changed, "changed");
  check_synchronous(wall, want.step);
  check_inputs(wall);
  if (!wall.in->has_begun()) wall.in->check_start();
  if (!(want.step.dt > 0) || !std::isfinite(want.step.dt))
    throw ApiError(LSDCD_ERROR_ARGUMENT, "dt is " + number_text(want.step.dt) + ", not above 0");
  if (!(want.step.reach >= 0))
    throw ApiError(LSDCD_ERROR_ARGUMENT, "reach is " + number_text(want.step.reach) + ", below 0");
  check_count(wall, given.n);
  const bool has_types = wall.in->laws().kinds > 1;
  want.spheres = spheres_of(given, wall.in->spec().law().has_heat(), has_types);
  if (given.n > 0) check_positions(given, wall.gpu.get());
  if (wall.in->spec().shapes)
    wall.grains.put(given, want.spheres);
  else
    refuse_shapes(given);
  wall.caller.set_spheres(want.spheres);
  const bool came = given.n > wall.caller.tags.size();
  want.look = !wall.begun || came || want.step.setup || want.step.changed;
  if (!want.look && wall.gpu) return want;
  const Spheres s = wall.caller.spheres_on_cpu();
  const Box extents = checked_extents(s);
  if (!wall.outside_warned) want.outside = outside(wall.caller.box(), s, extents);
  if (!want.look) return want;
  check_sizes(s);
  check_motion(s);
  if (has_types) check_types(s);
  wall.largest_radius = 0;
  for (int i = 0; i < s.n; i++) wall.largest_radius = std::max(wall.largest_radius, s.radius[i]);
  return want;
}

// Once. Collective.
void warn_of_outside(lsdcd_wall &wall, const StepWanted &want)
{
  wall.outside_warned = true;
  WallCaller &host = wall.caller;
  Real n = static_cast<Real>(want.outside.n);
  const int from = lowest_rank(host, n > 0);
  host.sum(&n, 1);
  std::string text;
  if (host.rank() == from) {
    const int i = want.outside.first;
    text = "x[" + std::to_string(i) + "]" +
           (host.is_alone() ? "" : " of process " + std::to_string(from)) + ", is at " +
           vector_text(host.spheres_on_cpu().x[i]);
  }
  broadcast_text(host, text, from);
  const Box box = host.box().bounds({0, 0, 0});
  host.warn(number_text(n) + (n == 1 ? " sphere is" : " spheres are") +
            " outside of the box, where the wall may not reach: the first, " + text +
            "; the box has " + extents_text(box) +
            ". Give lo and hi that hold all centres, or neither. This warning is shown once");
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
                            want.outside.n > 0 ? 1. : 0.,
                            wall.poses.number(),
                            -wall.poses.number(),
                            step.synchronous ? 1. : 0.,
                            step.synchronous ? 0. : 1.};
  wall.caller.agree(failure, most);
  if (most[0] != -most[1] || most[2] == most[3] || most[10] == most[11])
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   "dt goes from " + number_text(-most[1]) + " to " + number_text(most[0]) +
                       " over the processes" + (most[2] == most[3] ? ", and some set up" : "") +
                       (most[10] == most[11] ? ", and some are synchronous" : "") +
                       ": dt, setup and synchronous are the same on all");
  if (most[8] != -most[9])
    throw ApiError(
        LSDCD_ERROR_ARGUMENT,
        "poses given by lsdcd_wall_set_pose() differ between the processes, or nodes given by "
        "lsdcd_wall_set_nodes() or inputs by lsdcd_wall_set_input() do: call it on all, in the "
        "same order, with the same numbers");
  want.look = most[4] > 0;
  step.reach = most[5];
  std::vector<std::int64_t> &tags = wall.caller.tags;
  tags.resize(want.spheres.n);
  if (want.look) wall.caller.name_new_spheres(static_cast<std::int64_t>(most[6]));
  if (most[7] > 0) warn_of_outside(wall, want);
  return want;
}

void take_step(lsdcd_wall &wall, const StepWanted &want)
{
  const HostSpheres s = wall.caller.tagged(want.spheres);
  wall.in->history().grow(s.n);
  wall.is_restored = false;
  wall.dt = want.step.dt;
  if (!want.step.setup) wall.number++;
  StepInput input;
  input.step = {wall.number, want.step.dt, want.step.setup ? Step::setup : Step::step,
                want.step.synchronous != 0};
  input.look = input.new_spheres = want.look;
  input.box_changes = wall.caller.box().any_follows();
  for (const std::optional<Real> &value : wall.inputs) input.inputs.push_back(value.value_or(0));
  input.inputs.resize(wall.in->spec().inputs.size());
  input.drift.kind = SphereDrift::watched;
  input.drift.distance = want.step.reach;
  wall.begun = true;
  wall.in->begin(s, input);
  // Each step, as what is left out: it must not be known many steps later only.
  if (wall.caller.box().any_periodic()) wall.in->check_wrapping(s);
  try {
    wall.in->finish(s);
    if (!wall.tells_late()) wall.in->poll_diagnostics(s);
  } catch (const InputError &e) {
    if (!e.is_local || wall.caller.is_alone()) throw;
    wall.late = {LSDCD_ERROR_INPUT, e.what()};
  }
  if (!want.step.setup && wall.in->files_every() > 0) wall.in->write_due_files();
}

}    // namespace

extern "C" {

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
    const StepWanted wanted = agreed(*wall, failure, want);
    try {
      take_step(*wall, wanted);
    } catch (const std::exception &e) {
      wall->failed = e.what();
      throw;
    }
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
    HistoryExchange &history = wall->in->history();
    std::vector<std::vector<Real>> packed(n);
    if (history.is_on()) {
      ContactHistory &all = history.on_cpu();
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
}
