// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "grid/triangle_grid.h"
#include "tool/load_mesh.h"
#include "tool/mesh_json.h"
#include "tool/number_options.h"
#include "tool/progress.h"

#include <cstdio>
#include <memory>

namespace lsdcd {

namespace {

struct InspectOptions {
  std::string file;
  PlacementOptions place;
  double weld = -1, radius = 0, length = 0, memory = 0;
  bool json = false, progress = false;
};

nlohmann::json as_json(const ListReport &r)
{
  return {{"bricks", r.bricks},  {"cells", r.cells},          {"entries", r.entries},
          {"mean_list", r.mean}, {"longest_list", r.longest}, {"distance_tests", r.distance_tests}};
}

nlohmann::json as_json(const GridReport &r)
{
  nlohmann::json j = as_json(r.lists);
  j.update({{"length", r.length},
            {"cutoff", r.cutoff},
            {"bytes", r.bytes},
            {"seconds", r.seconds},
            {"device", r.device}});
  return j;
}

void inspect(const InspectOptions &o)
{
  WeldedMesh mesh = load_mesh(o.file, o.place, o.weld);
  if (mesh.report.oriented) note_meetings(mesh, meets_itself(mesh));
  if (o.json)
    print_json(stdout, as_json(mesh.report));
  else
    std::printf("%s\n%s\n", describe(mesh.report, o.file).c_str(),
                verdict_line(mesh.report).c_str());
}

void grid(const InspectOptions &o)
{
  const WeldedMesh mesh = load_wall(o.file, o.place, o.weld);
  StepGridSettings settings;
  settings.length = o.length;
  settings.cutoff = o.radius;
  settings.memory_budget = static_cast<std::size_t>(o.memory * 1048576);
  Progress progress(o.progress);
  settings.progress = [&](const std::string &what, double share) {
    progress.show(progress_text(what, share));
  };
  const StepGrid g = build_grid(mesh, settings);
  progress.clear();
  if (o.json)
    print_json(stdout, as_json(g.report));
  else
    std::printf("%s\n%s\n", describe(mesh.report, o.file).c_str(), describe(g.report).c_str());
}

void add_mesh_options(Command &command, InspectOptions &o)
{
  command.option("file", o.file, "mesh: .stl, .obj, .ply or .off").required();
  add_placement_options(command, o.place, "mesh");
  add_weld_option(command, o.weld);
  command.flag("--json", o.json, "print JSON");
}

}    // namespace

void add_inspect_command(Command &program)
{
  const auto o = std::make_shared<InspectOptions>();
  Command command =
      program.command("inspect", "describes a mesh: facets, welds, holes, folds, area, volume");
  command.footer("Example:\n  lsdcd inspect wall.stl --json");
  add_mesh_options(command, *o);
  command.runs([o] { inspect(*o); });
}

void add_grid_command(Command &program)
{
  const auto o = std::make_shared<InspectOptions>();
  Command command =
      program.command("grid", "estimates the cost of a grid for spheres up to a radius");
  command.footer("Example:\n  lsdcd grid wall.stl --radius 0.005");
  add_mesh_options(command, *o);
  command.option("--radius", o->radius, "largest sphere radius").required().check(above_zero);
  command.option("--grid", o->length, "cell length (default: chosen)").check(above_zero);
  command
      .option("--memory", o->memory,
              "memory budget in MB (default: 1024 beside the mesh's own records)")
      .check(above_zero);
  command.flag("--progress", o->progress,
               "show the progress even if standard error is not a terminal");
  command.runs([o] { grid(*o); });
}

}    // namespace lsdcd
