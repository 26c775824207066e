// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/old_wall_state.h"

#include "input/motion_words.h"
#include "output/mesh_loads.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace lsdcd {

namespace {

constexpr Real kOldFormat = -6;

Pose take_pose(StateReader &in)
{
  Pose p;
  in(p.row, p.shift);
  return p;
}

// "rotate 0 0 0 0 0 1 2, wiggle z 0.1 1": terms with commas between them; the wiggle of a direction is that of
// fix wall/gran.
std::vector<MotionTerm> terms_of(const std::string &text, InputNames &inputs)
{
  MeshSpec mesh;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t comma = std::min(text.find(", ", at), text.size());
    std::istringstream part(text.substr(at, comma - at));
    std::vector<std::string> words;
    for (std::string word; part >> word;) words.push_back(word);
    at = comma + 2;
    const bool is_of_wall_gran = words.size() > 1 && words[0] == "wiggle" &&
                                 (words[1] == "x" || words[1] == "y" || words[1] == "z");
    if (is_of_wall_gran) words.erase(words.begin());
    Tokens w(words);
    w.set_context("motion", kMotionSyntax);
    if (is_of_wall_gran)
      read_wiggle(w, mesh, inputs);
    else
      read_motion(w, mesh, inputs);
  }
  return mesh.motion.terms();
}

// The clock; poses of the start, without the servo, and last; the servo; how many terms there are; values of their
// variables; then a number for each letter of their words. Terms of a motion that was stopped are not counted.
MotionState take_motion(StateReader &in)
{
  MotionState m;
  in(m.clock.base, m.clock.base_step, m.clock.last_step, m.clock.dt);
  m.start = take_pose(in);
  m.placed = take_pose(in);
  m.last = take_pose(in);
  const int servo = in.next<int>();    // none, one, one that holds
  m.servo.present = servo > 0;
  m.servo.holds = servo == 2;
  in(m.servo.turns, m.servo.axis, m.servo.point, m.servo.position, m.servo.velocity);
  std::vector<MotionTerm> values(in.take_count());
  for (MotionTerm &value : values) in(value.displacement, value.speed);
  std::string text;
  while (in.left() > 0) text += static_cast<char>(in.next<int>());
  m.terms = terms_of(text, m.inputs);
  m.stopped = values.empty() && !m.terms.empty();
  if (!m.stopped && values.size() != m.terms.size()) in.fail("has other terms than words");
  for (std::size_t i = 0; i < values.size(); i++) {
    m.terms[i].displacement = values[i].displacement;
    m.terms[i].speed = values[i].speed;
  }
  return m;
}

}    // namespace

WallState read_wall_state(const Real *numbers, std::size_t n)
{
  if (n == 0 || numbers[0] != kOldFormat) return WallState::from({WallState::kKind, numbers, n});
  StateReader in(numbers, n, "the data of the wall");
  WallState all;
  Real format = 0, time = 0;
  in(format, all.history_kind, time);
  all.time = time;
  all.meshes.resize(in.take_count());
  for (MeshState &m : all.meshes) {
    const std::size_t size = in.take_count();
    StateReader motion(in.take_numbers(size), size, "a motion in the data of the wall");
    m.motion = take_motion(motion);
    in(m.loads.time, m.mesh.facets, m.mesh.edges, m.mesh.vertices);
    const std::size_t rows = in.take_count();
    in(m.mesh.fingerprint);
    const Real *const from = in.take_numbers(rows * MeshLoads::kPackedLoad);
    m.loads.rows.assign(from, from + rows * MeshLoads::kPackedLoad);
  }
  return all;
}

}    // namespace lsdcd
