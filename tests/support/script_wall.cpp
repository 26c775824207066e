// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "support/script_wall.h"

#include "input/wall_change.h"
#include "input/wall_command.h"
#include "support/fake_host.h"
#include "support/grains.h"
#include "wall/wall.h"

#include <algorithm>
#include <cstdint>

namespace lsdcd {

struct ScriptWall::State {
  FakeHost host;
  std::unique_ptr<Wall> wall;
  std::vector<std::int64_t> tags;
  std::int64_t number = 0;
  Real dt = 0, largest_radius = 0;
};

ScriptWall::ScriptWall(const std::vector<std::string> &words, const std::string &units) :
    in_(std::make_unique<State>())
{
  MaterialsRead read;
  const auto laws = [&](const WallMaterials &materials, const std::vector<MaterialPair> &pairs) {
    return read_laws(in_->host, materials, pairs, units, read);
  };
  in_->host.simulation = wide_box();
  in_->wall = std::make_unique<Wall>(in_->host, parse_wall(words, laws).wall, WallUnits(),
                                     WallBackend(), read.report, StepClock{0, 0, 0, 0});
  in_->wall->begin_run(0, false);
}

ScriptWall::~ScriptWall() = default;

void ScriptWall::step(const lsdcd_spheres &given, const lsdcd_wall_step &step)
{
  HostSpheres spheres;
  spheres.n = static_cast<int>(given.n);
  spheres.x = given.x;
  spheres.v = given.v;
  spheres.omega = given.omega;
  spheres.force = given.force;
  spheres.torque = given.torque;
  spheres.radius = given.radius;
  spheres.mass = given.mass;
  spheres.temperature = given.temperature;
  spheres.heat_flow = given.heat;
  spheres.type = given.type;
  const bool came = given.n > in_->tags.size();
  while (in_->tags.size() < given.n)
    in_->tags.push_back(static_cast<std::int64_t>(in_->tags.size()) + 1);
  spheres.tag = in_->tags.data();
  StepInput input;
  input.look = input.new_spheres = came || step.setup || step.changed;
  for (int i = 0; i < spheres.n && input.look; i++)
    in_->largest_radius = std::max(in_->largest_radius, given.radius[i]);
  if (!step.setup) in_->number++;
  in_->dt = step.dt;
  input.step = {in_->number, step.dt, step.setup ? Step::setup : Step::step, step.synchronous != 0};
  input.drift.kind = SphereDrift::watched;
  input.drift.distance = step.reach > 0 ? step.reach : 0.1 * in_->largest_radius;
  in_->wall->history().grow(spheres.n);
  in_->wall->begin(spheres, input);
  in_->wall->finish(spheres);
  if (!step.setup && in_->wall->files_every() > 0) in_->wall->write_due_files();
}

void ScriptWall::change(const std::vector<std::string> &words)
{
  change_wall(*in_->wall, words, {in_->number, in_->dt});
}

double ScriptWall::worn(int mesh) const
{
  return in_->wall->worn(mesh);
}

double ScriptWall::removed(int mesh) const
{
  return in_->wall->removed(mesh);
}

}    // namespace lsdcd
