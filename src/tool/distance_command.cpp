// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "backend/threads.h"
#include "base/number_words.h"
#include "mesh/winding_number.h"
#include "tool/answer_writer.h"
#include "tool/load_mesh.h"
#include "tool/mesh_json.h"
#include "tool/number_options.h"
#include "tool/output_file.h"
#include "tool/point_answers.h"
#include "tool/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <future>
#include <memory>

namespace lsdcd {

namespace {

struct DistanceOptions {
  std::string mesh, points, output, device = "auto";
  PlacementOptions place;
  double weld = -1;
  double radius = 0;    // 0: any distance
  std::size_t block = 1 << 18;
  int threads = 0;
  bool estimate_sides = false, json = false, progress = false;
};

struct DistanceTotals {
  std::size_t points = 0, found = 0, inside = 0;
  double nearest = HUGE_VAL, farthest = 0;    // of those found
  double seconds = 0, query_seconds = 0;

  void add(const AnswerBlock &a)
  {
    for (const double d : a.distance) {
      if (!std::isfinite(d)) continue;
      found++;
      nearest = std::min(nearest, d);
      farthest = std::max(farthest, d);
    }
    points += a.distance.size();
    inside += std::count(a.side.begin(), a.side.end(), -1);
  }
};

std::string text_of(const DistanceTotals &t, double share, double seconds)
{
  char text[96];
  std::snprintf(text, sizeof text, "%s, %.0f%%, %.2f million/s", counted(t.points, "point").c_str(),
                100 * share, 1e-6 * static_cast<double>(t.points) / seconds);
  return text;
}

// With more than one thread a block is read and another one written while a third is answered.
DistanceTotals stream(const DistanceOptions &o, PointReader &reader, PointAnswers &answers)
{
  const auto start = std::chrono::steady_clock::now();
  const auto writer = open_answers(o.output, reader.has_ids(), answers.sides);
  Progress progress(o.progress);
  const auto how = threads() > 1 ? std::launch::async : std::launch::deferred;
  PointBlock blocks[3];
  AnswerBlock answered[2];
  DistanceTotals totals;
  const auto read = [&](int k) {
    return std::async(how, [&, k] {
      reader.read(blocks[k % 3], o.block);
      return reader.share_read();
    });
  };
  std::future<double> reading = read(0);
  std::future<void> writing;
  for (int k = 0;; k++) {
    const PointBlock &points = blocks[k % 3];
    AnswerBlock &found = answered[k % 2];
    const double share = reading.get();
    if (points.size() == 0) break;
    reading = read(k + 1);
    const auto asked = std::chrono::steady_clock::now();
    answers.answer(points, found);
    totals.query_seconds += seconds_since(asked);
    if (writing.valid()) writing.get();
    writing = std::async(how, [&writer, &b = points, &a = found] { writer->write(b, a); });
    totals.add(found);
    progress.show(text_of(totals, share, seconds_since(start)));
  }
  if (writing.valid()) writing.get();
  if (totals.points == 0) throw InputError(o.points + ": the file has no points");
  writer->commit();
  totals.seconds = seconds_since(start);
  return totals;
}

void print(const DistanceOptions &o, const DistanceTotals &t, const PointAnswers &answers,
           const WeldedMesh &mesh)
{
  // Messages do not go between the answers.
  std::FILE *const to = o.output == "-" ? stderr : stdout;
  const double rate = t.seconds > 0 ? static_cast<double>(t.points) / t.seconds : 0;
  if (o.json) {
    nlohmann::json j = {{"points", t.points},
                        {"found", t.found},
                        {"sides", answers.sides == SideKind::exact},
                        {"seconds", t.seconds},
                        {"query_seconds", t.query_seconds},
                        {"points_per_second", rate},
                        {"grid_bytes", answers.report.bytes},
                        {"grid_seconds", answers.report.seconds},
                        {"device", answers.report.device},
                        {"output", o.output}};
    if (o.radius > 0)
      j["radius"] = o.radius;
    else
      j["radius"] = nullptr;
    if (answers.sides == SideKind::exact) j["inside"] = t.inside;
    if (answers.sides == SideKind::estimated) j["estimated_inside"] = t.inside;
    if (t.found > 0) j.update({{"nearest", t.nearest}, {"farthest", t.farthest}});
    print_json(to, j);
    return;
  }
  std::fprintf(to, "%s: %s\n  found       %zu", o.output.c_str(),
               counted(t.points, "point").c_str(), t.found);
  if (o.radius > 0) std::fprintf(to, " nearer than %g", o.radius);
  std::fprintf(to, "\n");
  if (t.found > 0) std::fprintf(to, "  distances   %g to %g\n", t.nearest, t.farthest);
  if (answers.sides == SideKind::exact)
    std::fprintf(to, "  inside      %zu\n", t.inside);
  else if (answers.sides == SideKind::estimated)
    std::fprintf(to, "  inside      %zu, estimated, not certified: the mesh has no inside: %s\n",
                 t.inside, why_no_inside(mesh).c_str());
  else
    std::fprintf(to, "  sides       none: the mesh has no inside: %s, or --estimate-sides\n",
                 why_no_inside(mesh).c_str());
  std::fprintf(
      to, "  time        %.3g s, of which queries %.3g s; %.3g points per second; grid %.3g s\n",
      t.seconds, t.query_seconds, rate, answers.report.seconds);
}

void distance(const DistanceOptions &o)
{
#if defined(_OPENMP)
  threads_asked_for() = true;    // a program of one user, not one of many processes
  if (o.threads > 0) omp_set_num_threads(o.threads);
#endif
  if (o.output != "-") check_outputs({{"--output", o.output}}, {o.mesh, o.points});
  const auto reader = open_points(o.points);
  open_answers(o.output, false,
               SideKind::none);    // throws before the work if it cannot be written
  const WeldedMesh mesh = load_wall(o.mesh, o.place, o.weld);
  Progress progress(o.progress);
  const auto answers = make_point_answers(
      mesh, o.radius, o.device, o.estimate_sides,
      [&](const std::string &what, double share) { progress.show(progress_text(what, share)); });
  progress.clear();
  print(o, stream(o, *reader, *answers), *answers, mesh);
}

}    // namespace

void add_distance_command(Command &program)
{
  const auto o = std::make_shared<DistanceOptions>();
  Command command = program.command(
      "distance", "computes distance, closest point, triangle, feature and side of many points");
  command.option("mesh", o->mesh, "mesh: .stl, .obj, .ply or .off").required();
  command
      .option("points", o->points,
              "lines of numbers (x y z first, or named), .npy (n, 3), or LAMMPS text dump; -: "
              "standard input")
      .required();
  command.option("-o,--output", o->output, "file to write, .csv or .npy; -: CSV to standard output")
      .required();
  command
      .option("--radius,--cutoff", o->radius,
              "points at this distance or farther count as infinitely far (default: no limit)")
      .check(above_zero);
  add_placement_options(command, o->place, "mesh");
  add_weld_option(command, o->weld);
  command.option("--device", o->device, "device that computes")
      .one_of({"auto", "cpu", "cuda"})
      .shows_default();
  command.option("--threads", o->threads, "threads on the CPU (default: OMP_NUM_THREADS, or all)")
      .range(1, 4096);
  command.option("--block", o->block, "points in memory at once")
      .range(std::size_t(1), std::size_t(1) << 26)
      .shows_default();
  command.flag("--estimate-sides", o->estimate_sides,
               "estimate sides of a mesh that is not closed, by winding numbers, not certified");
  command.flag("--progress", o->progress,
               "show the progress even if standard error is not a terminal");
  command.flag("--json", o->json, "print JSON");
  command.footer(
      "One line or record per point, in the order of the points; rows of a dump begin with "
      "timestep\n"
      "and id.\n"
      "Columns: distance (inf: nothing found), closest point (then the point itself), triangle (of "
      "the\n"
      "file, from 0), feature (face, edge, vertex, none; in .npy 0, 1, 2, -1) and its index in "
      "the\n"
      "welded mesh, and, where the mesh is closed, side (1 outside and on the mesh, -1 inside, at "
      "any\n"
      "distance), else with --estimate-sides estimated_side and winding, how often the mesh winds "
      "round\n"
      "the point: probably inside where the nearest whole number is not 0.\n"
      "Example:\n  lsdcd distance wall.stl points.csv --radius 0.01 -o distances.csv");
  command.runs([o] { distance(*o); });
}

}    // namespace lsdcd
