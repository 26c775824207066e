// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "base/number_words.h"
#include "mesh/io/read_mesh.h"
#include "output/mesh_file.h"
#include "output/mesh_stl.h"
#include "tool/load_mesh.h"
#include "tool/mesh_json.h"
#include "tool/number_options.h"
#include "tool/output_file.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

namespace lsdcd {

namespace {

const std::map<std::string, double> kMetres = {{"m", 1},     {"cm", 1e-2},   {"mm", 1e-3},
                                               {"um", 1e-6}, {"in", 0.0254}, {"ft", 0.3048}};

struct ConvertOptions {
  std::string file, output;
  PlacementOptions place;
  std::string units = "m";
  bool floats = false, json = false;
};

std::string known_unit(const std::string &word)
{
  if (kMetres.count(word)) return "";
  std::string all;
  for (const auto &[unit, metres] : kMetres) all += (all.empty() ? "" : ",") + unit;
  return word + " not in {" + all + "}";
}

// Reads the mesh, scaled and placed as the options say.
ReadMesh read_placed(const ConvertOptions &o)
{
  PlacementOptions place = o.place;
  if (place.scale.empty()) place.scale = {kMetres.at(o.units)};
  const Placement placement = placement_of(place);
  ReadMesh read = read_mesh(o.file);
  placement.apply(read.soup);
  if (o.floats)
    for (Vec3 &corner : read.soup.corners) corner = rounded_as_in_stl(corner);
  return read;
}

void print(const ConvertOptions &o, const ReadMesh &read)
{
  const TriangleSoup &soup = read.soup;
  Vec3 lo = soup.corners.empty() ? Vec3{0, 0, 0} : soup.corners[0], hi = lo;
  for (const Vec3 &corner : soup.corners)
    for (int k = 0; k < 3; k++) {
      lo[k] = std::min(lo[k], corner[k]);
      hi[k] = std::max(hi[k], corner[k]);
    }
  if (o.json) {
    const nlohmann::json all = {{"facets", soup.n_triangles()},
                                {"left_out", read.left_out},
                                {"lo", as_json(lo)},
                                {"hi", as_json(hi)}};
    print_json(stdout, all);
    return;
  }
  std::printf("%s: %s from (%g, %g, %g) to (%g, %g, %g)\n", o.output.c_str(),
              counted(soup.n_triangles(), "facet").c_str(), lo.x, lo.y, lo.z, hi.x, hi.y, hi.z);
  if (read.left_out > 0)
    std::printf("%s of %s %s left out\n",
                counted(read.left_out, "point or line", "points and lines").c_str(), o.file.c_str(),
                read.left_out == 1 ? "is not a facet, and was" : "are not facets, and were");
}

void run(const ConvertOptions &o)
{
  check_mesh_name(o.output);    // before the work
  check_outputs({{"--output", o.output}}, {o.file});
  const ReadMesh read = read_placed(o);
  // No command would read it again.
  if (!read.soup.corners.empty()) checked_diagonal(read.soup);
  write_mesh_file(o.output, read.soup);
  print(o, read);
}

}    // namespace

void add_convert_command(Command &program)
{
  const auto o = std::make_shared<ConvertOptions>();
  Command command = program.command(
      "convert", "writes a mesh in a different format or different units: STL, OBJ, PLY, OFF");
  command.footer(
      "Coordinates keep all their digits. Polygons are cut into triangles. STL is binary if "
      "all\ncorners are floats, else text; PLY is binary, of floats or else of doubles.\n"
      "Example:\n  lsdcd convert wall.obj --units mm -o wall.stl");
  command.option("file", o->file, "mesh, .stl, .obj, .ply or .off").required();
  command.option("-o,--output", o->output, "mesh to write, of the same formats").required();
  Option scale = add_placement_options(command, o->place, "mesh");
  command
      .option("--units", o->units,
              "what a length of 1 is in the file: m, cm, mm, um, in or ft; written in metres")
      .check(known_unit)
      .excludes(scale);
  command.flag("--float", o->floats, "round corners to float, for a binary STL");
  command.flag("--json", o->json, "print JSON");
  command.runs([o] { run(*o); });
}

}    // namespace lsdcd
