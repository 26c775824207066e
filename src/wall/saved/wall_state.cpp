// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/saved/wall_state.h"

#include "engine/loads/load.h"
#include "engine/loads/place_energy.h"
#include "output/feature_rows.h"
#include "output/impact_spectrum.h"

#include <algorithm>

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
  numbers(t.kind, t.velocity, t.amplitude, t.point, t.axis, t.period, t.angle, t.input,
          t.displacement, t.speed);
}

template <class Numbers>
void each_number(Numbers &numbers, TableRows &r)
{
  numbers(r.options.has_axis, r.options.linear, r.options.repeats, r.options.degrees, r.columns,
          r.numbers);
}

// The table of a motion. There is one for each term of that kind, in their order.
struct TableState {
  std::string file;
  TableRows rows;
};

template <class Numbers>
void each_number(Numbers &numbers, TableState &t)
{
  numbers(t.file, t.rows);
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

template <class Numbers>
void each_number(Numbers &numbers, StepLoad &l)
{
  MeshTotals &t = l.totals;
  numbers(t.force, t.torque, t.torque_at_origin, t.couple, t.contacts, t.overlap, t.uncertified,
          t.power, t.energy, l.coat.contacts, l.coat.overlap, l.coat.radius, l.coat.mass);
}

template <class Numbers>
void each_number(Numbers &numbers, Wrench &w)
{
  numbers(w.force, w.torque);
}

template <class Numbers>
void each_number(Numbers &numbers, NodeState &n)
{
  numbers(n.names);
}

template <class Numbers>
void each_number(Numbers &numbers, SurfaceState &s)
{
  numbers(s.vertices, s.pending, s.held, s.removed, s.held_back, s.carried);
}

template <class Numbers>
void each_number(Numbers &numbers, MeanLoad &m)
{
  numbers(m.force, m.torque, m.torque_at_origin);
}

template <class Numbers>
void each_number(Numbers &numbers, MeanLoadState &m)
{
  numbers(m.time, m.sum, m.mean);
}

template <class Numbers>
void each_number(Numbers &numbers, SymmetricMatrix &m)
{
  numbers(m.xx, m.yy, m.zz, m.xy, m.xz, m.yz);
}

template <class Numbers>
void each_number(Numbers &numbers, Quaternion &q)
{
  numbers(q.w, q.v);
}

template <class Numbers>
void each_number(Numbers &numbers, RigidState &s)
{
  numbers(s.home, s.home_turn, s.centre, s.turn, s.velocity, s.momentum, s.coordinate, s.rate);
}

template <class Numbers>
void each_number(Numbers &numbers, JointLoad &j)
{
  numbers(j.reaction, j.stop_force);
}

template <class Numbers>
void each_number(Numbers &numbers, BodyState &b)
{
  numbers(b.present, b.mass.mass, b.mass.centre, b.mass.inertia, b.joint.kind, b.joint.point,
          b.joint.axis, b.state);
}

namespace {

std::vector<TableState> tables_of(const MotionState &motion)
{
  std::vector<TableState> tables;
  for (const MotionTerm &m : motion.terms)
    if (m.table) tables.push_back({m.table_file, m.table->rows()});
  return tables;
}

void put_tables(const std::vector<TableState> &tables, MotionState &motion)
{
  auto next = tables.begin();
  try {
    for (MotionTerm &m : motion.terms) {
      if (m.kind != MotionKind::table) continue;
      if (next == tables.end()) throw StateError("a motion in the data of the wall has no table");
      m.table_file = next->file;
      m.table_options = next->rows.options;
      m.table = std::make_shared<const MotionTable>(
          next->rows, [](std::size_t row) { return "row " + std::to_string(row + 1); });
      ++next;
    }
  } catch (const StateError &) {
    throw;
  } catch (const InputError &e) {
    throw StateError("the table of a motion in the data of the wall: " + std::string(e.what()));
  }
  if (next != tables.end())
    throw StateError("the data of the wall have a table that no motion uses");
}

}    // namespace

State WallState::blocks() const
{
  State all(kKind);
  all.add("history", 1, history_kind);
  all.add("time", 1, time);
  if (average_every > 0) all.add("average", 1, average_every);
  for (const MeshState &m : meshes) {
    State mesh(kKind);
    mesh.add("identity", 1, m.mesh);
    mesh.add("motion", 1, m.motion);
    if (m.motion.moves_when_posed()) {
      mesh.add("velocity of pose", 1, m.motion.velocity);
      mesh.add("spin of pose", 1, m.motion.angular);
    }
    const std::vector<TableState> tables = tables_of(m.motion);
    if (!tables.empty()) mesh.add("tables", 1, tables);
    if (m.loads.time > 0 || !m.loads.rows.empty()) mesh.add("loads", 1, m.loads);
    if (m.body.present) mesh.add("body", 1, m.body);
    if (m.body.present) mesh.add("load of body", 1, m.body.load);
    if (!m.body.of_joint.empty()) mesh.add("load of joint", 1, m.body.of_joint);
    if (!m.nodes.names.empty()) mesh.add("nodes", 1, m.nodes);
    if (!m.nodes.places.empty()) mesh.add("places of nodes", 1, m.nodes.places);
    if (!m.nodes.velocities.empty()) mesh.add("velocities of nodes", 1, m.nodes.velocities);
    if (m.nodes.behind > 0) mesh.add("velocities are behind", 1, m.nodes.behind);
    if (!m.nodes.next.empty()) mesh.add("next places of nodes", 1, m.nodes.next);
    if (!m.nodes.next.empty()) mesh.add("next velocities of nodes", 1, m.nodes.next_velocities);
    if (!m.nodes.forces.empty()) mesh.add("forces on nodes", 1, m.nodes.forces);
    if (!m.coat.empty()) mesh.add("coat", 1, m.coat);
    if (!m.surface.vertices.empty()) mesh.add("shape", 1, m.surface);
    if (!m.mean.empty()) mesh.add("mean", 1, m.mean);
    if (!m.last.empty()) mesh.add("last step", 1, m.last);
    if (!m.energy.empty()) mesh.add("energy", 1, m.energy);
    if (!m.energy_places.empty()) mesh.add("energy of triangles", 1, m.energy_places);
    if (!m.impacts.empty()) mesh.add("impacts", 1, m.impacts);
    all.add("mesh", 1, mesh);
  }
  return all;
}

WallState WallState::from(const State &state)
{
  WallState all;
  state.read("history", 1, all.history_kind);
  state.read("time", 1, all.time);
  state.find("average", 1, all.average_every);
  for (const State &mesh : state.inside("mesh", 1)) {
    MeshState &m = all.meshes.emplace_back();
    mesh.read("identity", 1, m.mesh);
    mesh.read("motion", 1, m.motion);
    mesh.find("velocity of pose", 1, m.motion.velocity);
    mesh.find("spin of pose", 1, m.motion.angular);
    std::vector<TableState> tables;
    mesh.find("tables", 1, tables);
    put_tables(tables, m.motion);
    for (const MotionTerm &term : m.motion.terms)
      for (const int input : term.input)
        if (input != kNoInput && (input < 0 || input >= static_cast<int>(m.motion.inputs.size())))
          throw StateError("a motion in the data of the wall has an input that is not there");
    mesh.find("loads", 1, m.loads);
    mesh.find("body", 1, m.body);
    mesh.find("load of body", 1, m.body.load);
    mesh.find("load of joint", 1, m.body.of_joint);
    mesh.find("nodes", 1, m.nodes);
    mesh.find("places of nodes", 1, m.nodes.places);
    mesh.find("velocities of nodes", 1, m.nodes.velocities);
    mesh.find("velocities are behind", 1, m.nodes.behind);
    mesh.find("next places of nodes", 1, m.nodes.next);
    mesh.find("next velocities of nodes", 1, m.nodes.next_velocities);
    mesh.find("forces on nodes", 1, m.nodes.forces);
    mesh.find("coat", 1, m.coat);
    mesh.find("shape", 1, m.surface);
    mesh.find("mean", 1, m.mean);
    mesh.find("last step", 1, m.last);
    mesh.find("energy", 1, m.energy);
    mesh.find("energy of triangles", 1, m.energy_places);
    mesh.find("impacts", 1, m.impacts);
    const std::size_t n = static_cast<std::size_t>(std::max<std::int64_t>(0, m.mesh.vertices));
    const auto is_of_vertices = [n](const std::vector<Real> &numbers) {
      return numbers.empty() || numbers.size() == 3 * n;
    };
    const NodeState &nodes = m.nodes;
    if ((!nodes.names.empty() && nodes.names.size() != n) || !is_of_vertices(nodes.places) ||
        !is_of_vertices(nodes.velocities) || !is_of_vertices(nodes.next) ||
        nodes.next.size() != nodes.next_velocities.size() || !is_of_vertices(nodes.forces))
      throw StateError("the nodes in the data of the wall are not those of the mesh's vertices");
    const SurfaceState &s = m.surface;
    if (!s.vertices.empty() &&
        (s.vertices.size() != 3 * n || s.pending.size() != 4 * n || s.held.size() != n))
      throw StateError("the worn shape in the data of the wall is not that of the mesh's vertices");
    if (m.loads.rows.size() % FeatureRows<Load>::kPacked != 0)
      throw StateError("the loads in the data of the wall are no whole rows");
    if (m.energy_places.size() % FeatureRows<PlaceEnergy>::kPacked != 0)
      throw StateError("the energies in the data of the wall are no whole rows");
    if (!m.impacts.empty() && m.impacts.size() != ImpactSpectrum::kPacked)
      throw StateError("the impacts in the data of the wall are no spectrum");
    const std::string unread = mesh.unread();
    if (!unread.empty()) all.unread += (all.unread.empty() ? "" : ", ") + unread;
  }
  const std::string unread = state.unread();
  if (!unread.empty()) all.unread += (all.unread.empty() ? "" : ", ") + unread;
  return all;
}

}    // namespace lsdcd
