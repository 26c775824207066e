// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "base/number_words.h"
#include "mesh/io/read_mesh.h"
#include "mesh/measure_mesh.h"
#include "mesh/meets_itself.h"
#include "mesh/repair.h"
#include "output/mesh_file.h"
#include "tool/mesh_json.h"
#include "tool/number_options.h"
#include "tool/output_file.h"
#include "tool/progress.h"

#include <cstdio>
#include <memory>

namespace lsdcd {

namespace {

constexpr int kUnmended = 3;    // an exit code; doc/tool.md

struct RepairOptions {
  std::string file, output;
  double weld = -1;
  bool open = false, json = false, progress = false;
};

nlohmann::json as_json(const RepairReport &r)
{
  nlohmann::json left = nlohmann::json::array();
  for (const Unmended &u : r.left)
    left.push_back({{"what", u.what}, {"count", u.count}, {"place", as_json(u.place)}});
  return {{"welded_corners", r.welded_corners},
          {"degenerate_facets", r.degenerate_facets},
          {"lost_facets", r.lost_facets},
          {"duplicate_facets", r.duplicate_facets},
          {"split_facets", r.split_facets},
          {"junctions", r.junctions},
          {"turned_facets", r.turned_facets},
          {"shells", r.shells},
          {"cavities", r.cavities},
          {"boundaries", r.boundaries},
          {"tolerance", r.tolerance},
          {"welding_moved", r.welding_moved},
          {"splitting_moved", r.splitting_moved},
          {"dropping_moved", r.dropping_moved},
          {"moved", r.moved()},
          {"left", left}};
}

void print(const char *name, const std::string &text)
{
  std::printf("  %-12s%s\n", name, text.c_str());
}

std::string number(Real x)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

void print(const RepairOptions &o, const RepairReport &r)
{
  std::printf("repair %s\n", o.file.c_str());
  print("welded", counted(r.welded_corners, "corner") + " to another's place, " +
                      number(r.welding_moved) + " away at most (tolerance " + number(r.tolerance) +
                      ")");
  print("dropped", counted(r.degenerate_facets, "degenerate facet") + ", " +
                       counted(r.duplicate_facets, "duplicate"));
  if (r.lost_facets > 0)
    print("", counted(r.lost_facets, "line") + " of these that no facet follows any more, " +
                  number(r.dropping_moved) + " from what is left at most");
  print("cut", counted(r.split_facets, "facet") + " at " + counted(r.junctions, "corner") +
                   " of neighbours, " + number(r.splitting_moved) + " away at most");
  print("turned", counted(r.turned_facets, "facet") + "; " + counted(r.shells, "closed shell") +
                      ", " + counted(r.cavities, "of them a cavity", "of them cavities"));
  print("moved", number(r.moved()) + " at most: no point of the old surface or the new is farther "
                                     "from the other");
  for (const Unmended &u : r.left) {
    const std::string boundaries = " in " + counted(r.boundaries, "boundary", "boundaries");
    print("left", std::to_string(u.count) + " " + u.what +
                      (u.what == kOpenEdges ? boundaries : "") + ", the first at (" +
                      number(u.place.x) + ", " + number(u.place.y) + ", " + number(u.place.z) +
                      ")");
  }
  if (r.left.empty()) print("left", "nothing to mend");
}

void add_meetings(RepairedMesh &repaired)
{
  const SelfMeetings meetings = meets_itself(repaired.mesh);
  if (meetings.pairs == 0) return;
  note_meetings(repaired.mesh, meetings);
  Vec3 middle = {0, 0, 0};
  for (const int v : repaired.mesh.faces[meetings.first[0]])
    middle += (1.0 / 3) * repaired.mesh.vertices[v];
  repaired.report.left.push_back(
      {"pairs of facets that cut, overlap or touch", meetings.pairs, middle});
}

// Returns whether all is mended.
bool run(const RepairOptions &o)
{
  check_mesh_name(o.output);    // before the work
  check_outputs({{"--output", o.output}}, {o.file});
  Progress progress(o.progress);
  RepairedMesh repaired =
      repair(read_mesh(o.file).soup, o.weld, [&](const std::string &text) { progress.show(text); });
  progress.show("looking for facets that meet");
  add_meetings(repaired);
  progress.clear();
  write_mesh_file(o.output, repaired.soup);
  const RepairReport &report = repaired.report;
  if (o.json) {
    nlohmann::json all = as_json(report);
    all["mesh"] = as_json(repaired.mesh.report);
    print_json(stdout, all);
  } else {
    print(o, report);
    std::printf("%s\n%s\n", describe(repaired.mesh.report, o.output).c_str(),
                verdict_line(repaired.mesh.report).c_str());
  }
  for (const Unmended &u : report.left)
    if (!(o.open && u.what == kOpenEdges)) return false;
  return true;
}

}    // namespace

void add_repair_command(Command &program, int &exit_code)
{
  const auto o = std::make_shared<RepairOptions>();
  Command command = program.command("repair", "mends a mesh, and reports what it did");
  command.footer(
      "Welds corners, drops degenerate and duplicate facets, cuts facets where corners of\n"
      "neighbours lie on their open edges, and winds them alike, closed shells with normals out,\n"
      "cavities in them with normals in. It fills no holes. It ends with 3 if the mesh is\nwritten "
      "and something is left that it cannot mend: open edges, edges of more than two facets,\n"
      "one-sided parts, facets that meet.\n"
      "Example:\n  lsdcd repair wall.stl -o mended.stl");
  command.option("file", o->file, "mesh: .stl, .obj, .ply or .off").required();
  command
      .option("-o,--output", o->output,
              "mesh to write, .stl, .obj, .ply or .off; STL is binary where all corners are\n"
              "floats, else text with all digits")
      .required();
  command
      .option("--weld", o->weld,
              "corners closer than this to each other, or to an open edge, are on it\n"
              "(default: cracks of 1e-6 of a part)")
      .check(not_below_zero);
  command.flag("--open", o->open,
               "open edges are not an error: ends with 0 if nothing else is left");
  command.flag("--progress", o->progress,
               "show the progress even if standard error is not a terminal");
  command.flag("--json", o->json, "print JSON");
  command.runs([o, &exit_code] {
    if (!run(*o)) exit_code = kUnmended;
  });
}

}    // namespace lsdcd
