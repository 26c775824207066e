// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/state_keeper.h"

#include "base/number_words.h"
#include "wall/spec/mesh_name.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace lsdcd {

namespace {

// The part that fits a double, exactly.
Real number_of(std::uint64_t fingerprint)
{
  return static_cast<Real>(fingerprint >> 11);
}

MeshIdentity identity_of(const MeshPart &m)
{
  const MeshReport &r = m.grid.report();
  return {static_cast<std::int64_t>(r.facets), static_cast<std::int64_t>(r.edges),
          static_cast<std::int64_t>(r.vertices), number_of(m.grid.mesh_fingerprint())};
}

// Returns a state that save() has made as all processes are to give it.
WallState on_all(Host &host, const WallState &saved)
{
  std::vector<double> numbers = saved.blocks().numbers();
  std::uint64_t n = numbers.size();
  host.broadcast(&n, sizeof n, 0);
  numbers.resize(n);
  host.broadcast(numbers.data(), n * sizeof(double), 0);
  return WallState::from(State(WallState::kKind, numbers.data(), n));
}

}    // namespace

WallState StateKeeper::save(Time time)
{
  WallState all;
  all.history_kind = static_cast<Real>(wall_.law().history_kind());
  all.time = time;
  all.average_every = wall_.average_every;
  for (const MeshPart &m : of_.meshes) {
    MeshState &to = all.meshes.emplace_back();
    to.mesh = identity_of(m);
    to.loads = {of_.loads.time(m.index), of_.loads.gathered(m.index).packed()};
    to.last = {{of_.totals.mesh(m.index), of_.coats.load(m.index)}};
    if (wall_.energy) to.energy = {of_.energy.mesh(m.index)};
    if (wall_.has_energy_places(m.spec)) to.energy_places = of_.records.gathered(m.index).packed();
    if (wall_.impact_speed > 0) to.impacts = of_.records.spectrum(m.index).packed();
    m.surface->save(to);
    m.mover.save(to);
    of_.coats.save(m.index, to, [this](int mesh, FeatureCode feature) {
      return of_.grids.without_image(mesh, feature);
    });
  }
  if (wall_.average_every > 0) {
    const std::vector<MeanLoadState> means = of_.means.save();
    for (std::size_t k = 0; k < means.size(); k++) all.meshes[k].mean = {means[k]};
  }
  return all;
}

// The springs of several meshes tell which mesh they are of by its number alone.
bool StateKeeper::is_restored(const MeshPart &m, const WallState &was) const
{
  const std::size_t k = static_cast<std::size_t>(m.index), there = was.meshes.size();
  const bool one_of_many = of_.meshes.size() > 1 || there > 1;
  return k < there && (!one_of_many || was.meshes[k].mesh == identity_of(m));
}

void StateKeeper::check(const WallState &was) const
{
  for (const MeshPart &m : of_.meshes) {
    if (!is_restored(m, was)) continue;
    const MeshState &of_mesh = was.meshes[static_cast<std::size_t>(m.index)];
    m.mover.check(of_mesh);
    m.surface->check(of_mesh, of_mesh.mesh == identity_of(m));
  }
}

void StateKeeper::restore(const WallState &was, const Step &now)
{
  const std::size_t here = of_.meshes.size(), there = was.meshes.size();
  const std::string saved = host_.names().saved;
  if (is_restored_) go_back(now);
  is_restored_ = true;
  for (std::size_t k = 0; k < std::min(there, here); k++) {
    MeshPart &m = of_.meshes[k];
    m.springs_are_foreign = !(was.meshes[k].mesh == identity_of(m));
    if (is_restored(m, was))
      restore_mesh(m, was, now);
    else
      host_.warn(with_mesh_name(wall_, m.index,
                                "springs, motion, loads and wear start from zero: the " + saved +
                                    " was written with a different mesh in this place"));
  }
  if (wall_.average_every > 0 && was.average_every != wall_.average_every)
    host_.warn("the " + saved + " was written with " +
               (was.average_every > 0 ? "average " + std::to_string(was.average_every)
                                      : std::string("no average")) +
               ", and " + host_.names().wall + " has " + std::to_string(wall_.average_every) +
               ": the first mean is over the steps from now on");
  if (!was.unread.empty())
    host_.warn("the " + saved + " has " + was.unread +
               ", which this version does not know and ignores");
  if (there == here) return;
  const auto meshes = [](std::size_t n) { return counted(n, "mesh", "meshes"); };
  host_.warn("the " + saved + " was written with " + meshes(there) + " and " + host_.names().wall +
             " has " + std::to_string(here) + ": " +
             (there > here ? "springs, motion, loads and wear of those after mesh " +
                                 std::to_string(here) + " are not carried over"
                           : "those after mesh " + std::to_string(there) +
                                 " start without springs, motion, loads and wear"));
}

void StateKeeper::keep_made()
{
  if (is_restored_ || made_) return;
  made_ = std::make_unique<Made>(Made{on_all(host_, save(0)), {}});
  for (const MeshPart &m : of_.meshes) made_->motions.push_back(m.spec.motion);
  for (MeshState &m : made_->state.meshes) m.body.has_begun = false;
}

// What the last state had, and the next one has not, must not stay.
void StateKeeper::go_back(const Step &now)
{
  if (!made_) throw std::logic_error("a wall that is restored again has to keep_made() before");
  for (MeshPart &m : of_.meshes) {
    const std::size_t k = static_cast<std::size_t>(m.index);
    m.springs_are_foreign = false;
    m.spec.motion = made_->motions[k];
    restore_mesh(m, made_->state, now);
  }
}

void StateKeeper::restore_mesh(MeshPart &m, const WallState &all, const Step &now)
{
  const MeshState &was = all.meshes[static_cast<std::size_t>(m.index)];
  m.mover.restore(was, now);
  if (m.surface->restore(was, !m.springs_are_foreign)) of_.grids.follow_surface(m);
  of_.coats.restore(m.index, was);
  if (!was.mean.empty() && all.average_every == wall_.average_every)
    of_.means.restore(m.index, was.mean.front());
  if (!was.energy.empty()) of_.energy.restore(m.index, was.energy.front());
  const bool has_same_places = !m.springs_are_foreign && wall_.has_energy_places(m.spec);
  of_.records.restore(m.index, has_same_places ? was.energy_places : std::vector<Real>(),
                      was.impacts);
  if (!was.last.empty()) of_.totals.restore(m.index, was.last.front().totals);
  if (!wall_.has_loads(m.spec)) return;
  if (m.springs_are_foreign)
    host_.warn("loads and wear begin at zero: the " + std::string(host_.names().saved) +
               " was written with a different mesh");
  else
    of_.loads.restore(m.index, was.loads.time, was.loads.rows);
}

}    // namespace lsdcd
