// lsdcd: looks at a mesh, its grid and its materials before a simulation does.
#include "base/input_error.h"
#include "grid/triangle_grid.h"
#include "tool/accuracy_command.h"
#include "tool/effects_command.h"
#include "tool/load_mesh.h"
#include "tool/material.h"
#include "tool/tradeoff_command.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>
#include <vector>

using namespace lsdcd;

namespace {

struct Options {
  std::string file;
  std::vector<double> scale;
  double weld = -1, radius = 0, length = 0, memory = 0;
  bool json = false;
};

nlohmann::json as_json(const Vec3 &v)
{
  return {v.x, v.y, v.z};
}

nlohmann::json as_json(const MeshReport &r)
{
  return {{"facets", r.facets},
          {"vertices", r.vertices},
          {"degenerate_facets", r.degenerate_facets},
          {"duplicate_facets", r.duplicate_facets},
          {"edges", r.edges},
          {"open_edges", r.open_edges},
          {"nonmanifold_edges", r.nonmanifold_edges},
          {"misoriented_edges", r.misoriented_edges},
          {"closed", r.closed},
          {"oriented", r.oriented},
          {"weld_tolerance", r.weld_tolerance},
          {"area", r.area},
          {"volume", r.volume},
          {"lo", as_json(r.lo)},
          {"hi", as_json(r.hi)},
          {"smallest_edge", r.smallest_edge},
          {"median_edge", r.median_edge},
          {"largest_edge", r.largest_edge},
          {"smallest_height", r.smallest_height},
          {"largest_fold_degrees", r.largest_fold},
          {"feature_edges", r.feature_edges}};
}

nlohmann::json as_json(const ListReport &r)
{
  return {{"bricks", r.bricks},  {"cells", r.cells},          {"candidates", r.candidates},
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

void inspect(const Options &o)
{
  const WallMesh mesh = load_mesh(o.file, o.scale, o.weld);
  if (o.json)
    std::printf("%s\n", as_json(mesh.report).dump(2).c_str());
  else
    std::printf("%s\n", describe(mesh.report, o.file).c_str());
}

void grid(const Options &o)
{
  const WallMesh mesh = load_mesh(o.file, o.scale, o.weld);
  GridSettings settings;
  settings.length = o.length;
  settings.cutoff = o.radius;
  settings.memory_budget = static_cast<std::size_t>(o.memory * 1048576);
  const TriangleGrid g = build_grid(mesh, settings);
  if (o.json)
    std::printf("%s\n", as_json(g.report).dump(2).c_str());
  else
    std::printf("%s\n%s\n", describe(mesh.report, o.file).c_str(), describe(g.report).c_str());
}

void add_mesh_options(CLI::App *command, Options &o)
{
  command->add_option("file", o.file, "STL file, ASCII or binary")->required();
  command->add_option("--scale", o.scale, "one factor, or three (x y z)")->expected(1, 3);
  command->add_option("--weld", o.weld,
                      "weld corners closer than this (default: 1e-6 of the box diagonal)");
  command->add_flag("--json", o.json, "print JSON");
}

// CLI11 would only say that a command is missing.
void check_command(const CLI::App &app, const std::string &word)
{
  std::string all;
  for (const CLI::App *command : app.get_subcommands({})) {
    if (command->get_name() == word) return;
    all += (all.empty() ? "" : ", ") + command->get_name();
  }
  throw InputError("'" + word + "' is not a command; those are " + all);
}

}    // namespace

int main(int argc, char **argv)
{
  CLI::App app{"lsdcd: looks at the mesh of a `fix wall/lsdcd`, at its grid and at materials"};
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("lsdcd " LSDCD_VERSION " (" LSDCD_COMMIT ")"));
  Options o;
  CLI::App *inspect_command =
      app.add_subcommand("inspect", "what the mesh is: facets, welds, holes, folds, area, volume");
  add_mesh_options(inspect_command, o);
  inspect_command->callback([&] { inspect(o); });

  CLI::App *grid_command =
      app.add_subcommand("grid", "what a grid for spheres up to a radius would cost");
  add_mesh_options(grid_command, o);
  grid_command->add_option("--radius", o.radius, "largest sphere radius")->required();
  grid_command->add_option("--grid", o.length, "cell length (default: chosen)");
  grid_command->add_option("--memory", o.memory,
                           "budget in MB (default: 1024 beside the mesh's own records)");
  grid_command->callback([&] { grid(o); });
  add_material_command(app);
  add_tradeoff_command(app);

  add_accuracy_command(app);
  add_effects_command(app);

  try {
    if (argc > 1 && *argv[1] != '-') check_command(app, argv[1]);
    app.parse(argc, argv);
  } catch (const CLI::ParseError &e) {
    return app.exit(e);
  } catch (const std::exception &e) {
    std::fprintf(stderr, "lsdcd: %s\n", e.what());
    return 1;
  }
  return 0;
}
