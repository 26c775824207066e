// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/wall_state.h"

#include "output/mesh_loads.h"

namespace lsdcd {

const char *const WallState::kKind = "wall";

// Members in the order of the file.

template <class Numbers>
void each_number(Numbers &numbers, StepClock &c)
{
  numbers(c.base, c.base_step, c.last_step, c.dt);
}

template <class Numbers>
void each_number(Numbers &numbers, Pose &p)
{
  numbers(p.row, p.shift);
}

template <class Numbers>
void each_number(Numbers &numbers, Servo &s)
{
  numbers(s.present, s.holds, s.turns, s.axis, s.point, s.position, s.velocity);
}

template <class Numbers>
void each_number(Numbers &numbers, MotionTerm &t)
{
  numbers(t.kind, t.velocity, t.amplitude, t.point, t.axis, t.period, t.input, t.displacement,
          t.speed);
}

template <class Numbers>
void each_number(Numbers &numbers, MotionState &m)
{
  numbers(m.clock, m.start, m.placed, m.last, m.servo, m.stopped, m.terms, m.inputs);
}

template <class Numbers>
void each_number(Numbers &numbers, MeshIdentity &m)
{
  numbers(m.facets, m.edges, m.vertices, m.fingerprint);
}

template <class Numbers>
void each_number(Numbers &numbers, LoadState &l)
{
  numbers(l.time, l.rows);
}

State WallState::blocks() const
{
  State all(kKind);
  all.add("history", 1, history_kind);
  all.add("time", 1, time);
  for (const MeshState &m : meshes) {
    State mesh(kKind);
    mesh.add("identity", 1, m.mesh);
    mesh.add("motion", 1, m.motion);
    if (m.loads.time > 0 || !m.loads.rows.empty()) mesh.add("loads", 1, m.loads);
    all.add("mesh", 1, mesh);
  }
  return all;
}

WallState WallState::from(const State &state)
{
  WallState all;
  state.read("history", 1, all.history_kind);
  state.read("time", 1, all.time);
  for (const State &mesh : state.inside("mesh", 1)) {
    MeshState &m = all.meshes.emplace_back();
    mesh.read("identity", 1, m.mesh);
    mesh.read("motion", 1, m.motion);
    mesh.find("loads", 1, m.loads);
    if (m.loads.rows.size() % MeshLoads::kPackedLoad != 0)
      throw StateError("the loads in the data of the wall are no whole rows");
    const std::string unread = mesh.unread();
    if (!unread.empty()) all.unread += (all.unread.empty() ? "" : ", ") + unread;
  }
  const std::string unread = state.unread();
  if (!unread.empty()) all.unread += (all.unread.empty() ? "" : ", ") + unread;
  return all;
}

}    // namespace lsdcd
