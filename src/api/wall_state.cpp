// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_wall_pack, unpack, save and restore: the history of contacts.
#include "api/wall_handle.h"
#include "base/input_words.h"
#include "contact/contact_set.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

using namespace lsdcd;

namespace {

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

// Packed numbers begin with these: the kind of the history, and the number of meshes.
Real packed_kind(const lsdcd_wall &wall)
{
  return static_cast<Real>(wall.in->spec().law().history_kind()) +
         0x1p32 * static_cast<Real>(wall.in->meshes().size());
}

// Where the numbers of each sphere begin: its tag, then what ContactHistory packs.
std::vector<const double *> packed_spheres(const lsdcd_wall &wall, std::size_t n,
                                           const double *numbers, std::size_t count)
{
  const HistoryExchange &history = wall.in->history();
  const std::size_t per_contact = history.is_on() ? history.numbers_per_contact() : 0;
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
                       counted(n, "sphere") + " of such a wall");
  return spheres;
}

// Throws where two spheres would have one name, so that the springs of one of them would be those of the other.
void check_names(const lsdcd_wall &wall, const std::ptrdiff_t *to,
                 const std::vector<const double *> &spheres)
{
  std::map<std::int64_t, std::size_t> given;
  std::vector<char> gets(wall.caller.tags.size(), 0);
  for (std::size_t i = 0; i < spheres.size(); i++) {
    const std::string name = "to[" + std::to_string(i) + "] is ";
    if (gets[to[i]]++)
      throw ApiError(LSDCD_ERROR_ARGUMENT,
                     name + std::to_string(to[i]) + ", as one before it: give each sphere once");
    const auto tag = static_cast<std::int64_t>(spheres[i][0]);
    const auto [before, is_new] = given.emplace(tag, i);
    if (tag != 0 && !is_new)
      throw ApiError(LSDCD_ERROR_ARGUMENT,
                     name + std::to_string(to[i]) + ", and gets what to[" +
                         std::to_string(before->second) +
                         "] gets: `numbers` has one sphere twice; pack each once");
  }
  for (std::size_t k = 0; k < gets.size(); k++) {
    const auto at = given.find(wall.caller.tags[k]);
    if (gets[k] || at == given.end() || at->first == 0) continue;
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   "to[" + std::to_string(at->second) + "] gets what was packed of sphere " +
                       std::to_string(k) +
                       ", which is still there: leave that out by lsdcd_wall_renumber() before");
  }
}

constexpr const char *kSpheres = "springs of spheres", *kStep = "step", *kParts = "parts",
                     *kInputs = "inputs", *kInputNames = "names of inputs";

WallParts parts_of(const lsdcd_wall &wall)
{
  WallParts parts = wall.made;
  for (const std::vector<std::string> &part : set_parts(*wall.in)) parts.push_back(part);
  return parts;
}

// What lsdcd_wall_save() has written.
struct Saved {
  WallState state;
  SphereHistories spheres;
  std::int64_t step = 0;
  WallParts parts;
  // Of the last step, if it had some; the names are one row.
  std::vector<Real> inputs;
  WallParts input_names;
};

// Reads what lsdcd_wall_save() wrote. Throws StateError.
Saved read_saved(const Real *numbers, std::size_t n)
{
  Saved saved;
  const State all(WallState::kKind, numbers, n);
  all.read(kParts, 1, saved.parts);
  all.read(kSpheres, 1, saved.spheres);
  all.read(kStep, 1, saved.step);
  all.find(kInputs, 1, saved.inputs);
  all.find(kInputNames, 1, saved.input_names);
  saved.state = WallState::from(all);
  if (all.numbers().size() != n) throw StateError("the data of the wall are too long");
  for (const std::vector<std::string> &part : saved.parts)
    if (part.size() < 2) throw StateError("the data of the wall have a part without a text");
  for (const std::vector<Real> &sphere : saved.spheres)
    if (sphere.empty()) throw StateError("the data of the wall have a sphere without a number");
  const bool has_names = saved.input_names.size() == 1;
  if (has_names ? saved.input_names.front().size() != saved.inputs.size() : !saved.inputs.empty())
    throw StateError("the data of the wall have inputs without names");
  return saved;
}

// The values of the last step in the order in which the wall has its inputs; 0: there was none of this name.
std::vector<Real> last_inputs(const Saved &saved, const InputNames &names)
{
  std::vector<Real> values(names.size());
  const std::vector<std::string> &was = saved.input_names.front();
  for (std::size_t k = 0; k < names.size(); k++) {
    const auto found = std::find(was.begin(), was.end(), names[k]);
    if (found != was.end()) values[k] = saved.inputs[static_cast<std::size_t>(found - was.begin())];
  }
  return values;
}

// Throws ApiError where the numbers are of no wall, or, without `what_fits`, of another one.
Saved saved_of(const lsdcd_wall &wall, const double *numbers, std::size_t count, bool what_fits)
{
  need(numbers, "numbers");
  if (wall.in->has_begun())
    throw ApiError(LSDCD_ERROR_ARGUMENT, "a wall is restored before its first step");
  Saved saved;
  try {
    saved = read_saved(numbers, count);
  } catch (const StateError &e) {
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   std::string("these are not the numbers that lsdcd_wall_save() wrote, all of "
                               "them: ") +
                       e.what());
  }
  const std::string differ = differences(parts_of(wall), saved.parts);
  if (!what_fits && !differ.empty())
    throw ApiError(LSDCD_ERROR_ARGUMENT, "these are numbers of a different wall: " + differ +
                                             ". Make the wall as it was made, with the motion, "
                                             "servo or body that was set later, or "
                                             "take what fits by lsdcd_wall_restore_what_fits()");
  return saved;
}

// Where one process refuses its numbers all do.
void restore(lsdcd_wall &wall, const double *numbers, std::size_t count, bool what_fits)
{
  Saved saved;
  std::vector<Real> none;
  wall.caller.agree(failure_of([&] { saved = saved_of(wall, numbers, count, what_fits); }), none);
  wall.in->keep_made();
  if (!saved.inputs.empty()) wall.in->restore_inputs(last_inputs(saved, wall.in->spec().inputs));
  wall.in->restore(saved.state, {saved.step, wall.dt});
  wall.number = saved.step;
  wall.in->restore_springs(saved.spheres);
  wall.caller.tags.assign(wall.in->history().is_on() ? saved.spheres.size() : 0, 0);
  wall.is_restored = true;
}

}    // namespace

extern "C" {

int lsdcd_wall_pack(lsdcd_wall *wall, const ptrdiff_t *which, size_t n, double *numbers,
                    size_t room, size_t *count)
{
  return guard_wall(wall, [&] {
    need(count, "count");
    if (n > 0) need(which, "which");
    if (room > 0) need(numbers, "numbers");
    check_spheres(*wall, which, n, "which");
    const bool keeps = wall->in->history().is_on();
    const ContactHistory &history = wall->in->history().on_cpu();
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
    check_spheres(*wall, to, n, "to");
    const std::vector<const double *> spheres = packed_spheres(*wall, n, numbers, count);
    check_names(*wall, to, spheres);
    const bool keeps = wall->in->history().is_on();
    ContactHistory &history = wall->in->history().on_cpu();
    for (std::size_t i = 0; i < n; i++) {
      wall->caller.tags[to[i]] = static_cast<std::int64_t>(spheres[i][0]);
      if (keeps) history.unpack(static_cast<int>(to[i]), spheres[i] + 1);
    }
  });
}

int lsdcd_wall_save(lsdcd_wall *wall, double *numbers, size_t room, size_t *count)
{
  return guard_wall(wall, [&] {
    need(count, "count");
    if (room > 0) need(numbers, "numbers");
    tell_late(*wall);
    SphereHistories spheres(wall->in->history().is_on() ? wall->caller.tags.size() : 0);
    std::vector<Real> packed(1 + wall->in->history().max_packed_size());
    for (std::size_t i = 0; i < spheres.size(); i++) {
      const int size = wall->in->pack_saved(static_cast<int>(i), packed.data());
      spheres[i].assign(packed.begin(), packed.begin() + size);
    }
    State state = wall->in->save().blocks();
    state.add(kSpheres, 1, spheres);
    state.add(kStep, 1, wall->number);
    state.add(kParts, 1, parts_of(*wall));
    const std::vector<Real> &inputs = wall->in->last_inputs();
    if (!inputs.empty()) {    // those of a change since then come behind them
      const auto names = wall->in->spec().inputs.begin();
      state.add(kInputs, 1, inputs);
      state.add(kInputNames, 1,
                WallParts{{names, names + static_cast<std::ptrdiff_t>(inputs.size())}});
    }
    const std::vector<Real> all = state.numbers();
    *count = all.size();
    std::copy_n(all.begin(), std::min(room, all.size()), numbers);
  });
}

int lsdcd_wall_restore(lsdcd_wall *wall, const double *numbers, size_t count)
{
  return guard_wall(wall, [&] { restore(*wall, numbers, count, false); });
}

int lsdcd_wall_restore_what_fits(lsdcd_wall *wall, const double *numbers, size_t count)
{
  return guard_wall(wall, [&] { restore(*wall, numbers, count, true); });
}
}
