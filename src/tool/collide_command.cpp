// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "backend/threads.h"
#include "base/input_error.h"
#include "base/number_words.h"
#include "tool/load_mesh.h"
#include "tool/mesh_json.h"
#include "tool/number_options.h"
#include "tool/output_file.h"
#include "tool/pair_writer.h"
#include "tool/pose_reader.h"
#include "tool/progress.h"

#include <chrono>
#include <cstdio>
#include <memory>

namespace lsdcd {

namespace {

struct CollideOptions {
  std::string wall, body, poses, output, segments, device = "auto";
  std::vector<double> pose;
  PlacementOptions place, body_place = {"--body-", {}, {}};
  double weld = -1, cell = 0, memory = 0;
  int nearest = 0, threads = 0;
  bool json = false, progress = false;
};

struct CollideTotals {
  std::vector<std::size_t> pairs;    // of each pose
  std::size_t all = 0, colliding = 0, first = 0, most = 0;
  std::uint64_t uncertain = 0;
  double seconds = 0;    // of collisions alone

  void add(const Collision &found)
  {
    const std::size_t n = found.pairs.size();
    if (n > 0 && colliding++ == 0) first = pairs.size();
    if (pairs.empty() || n > pairs[most]) most = pairs.size();
    pairs.push_back(n);
    all += n;
    uncertain += found.uncertain;
  }
};

std::string text_of(const CollideTotals &t, double share)
{
  char text[96];
  std::snprintf(text, sizeof text, "%s, %.0f%%, %.3g a second",
                counted(t.pairs.size(), "pose").c_str(), 100 * share,
                static_cast<double>(t.pairs.size()) / t.seconds);
  return text;
}

// Each pose of the file, or the one of the command line.
template <class Visit>
void each_pose(const CollideOptions &o, const Visit &visit)
{
  if (o.poses.empty()) {
    visit(o.pose.empty() ? BodyPose() : pose_of_numbers(o.pose), 1);
    return;
  }
  PoseReader reader(o.poses);
  BodyPose pose;
  while (reader.read(pose)) visit(pose, reader.share_read());
}

CollideTotals run(const CollideOptions &o, MeshCollision &collision, PairWriter *pairs,
                  PairWriter *segments)
{
  Progress progress(o.progress);
  CollideTotals totals;
  each_pose(o, [&](const BodyPose &pose, double share) {
    const auto asked = std::chrono::steady_clock::now();
    Collision found;
    try {
      found = collision.collide(pose, segments != nullptr);
    } catch (const InputError &e) {
      throw InputError("pose " + std::to_string(totals.pairs.size()) + ": " + e.what());
    }
    totals.seconds += seconds_since(asked);
    if (pairs) pairs->write(totals.pairs.size(), collision, found);
    if (segments) segments->write(totals.pairs.size(), collision, found);
    totals.add(found);
    progress.show(text_of(totals, share));
  });
  if (totals.pairs.empty()) throw InputError(o.poses + ": the file has no poses");
  return totals;
}

void print(const CollideOptions &o, const CollideTotals &t, const MeshCollision &collision)
{
  const std::size_t n = t.pairs.size();
  const GridReport &grid = collision.grid();
  const double ms = 1e3 * t.seconds / static_cast<double>(n);
  if (o.json) {
    nlohmann::json j = {{"poses", n},
                        {"colliding", t.colliding},
                        {"pairs", t.all},
                        {"pairs_of_pose", t.pairs},
                        {"exact", o.nearest == 0},
                        {"uncertain_pieces", t.uncertain},
                        {"triangles", collision.n_triangles()},
                        {"pieces", collision.n_pieces()},
                        {"cell", grid.length},
                        {"grid_bytes", grid.bytes},
                        {"grid_seconds", grid.seconds},
                        {"milliseconds_per_pose", ms},
                        {"device", collision.device()}};
    if (!o.output.empty()) j["output"] = o.output;
    if (!o.segments.empty()) j["segments"] = o.segments;
    print_json(stdout, j);
    return;
  }
  std::printf("%s against %s\n", o.body.c_str(), o.wall.c_str());
  if (n == 1)
    std::printf("  collides    %s\n  pairs       %zu\n", t.all > 0 ? "yes" : "no", t.all);
  else if (t.colliding == 0)
    std::printf("  collides    in none of %zu poses\n", n);
  else
    std::printf("  collides    in %zu of %zu poses, first in pose %zu (from 0)\n"
                "  pairs       %zu in all, most in pose %zu: %zu\n",
                t.colliding, n, t.first, t.all, t.most, t.pairs[t.most]);
  if (o.nearest > 0)
    std::printf("  certain     %s: %s in cells with more than %s\n", t.uncertain > 0 ? "no" : "yes",
                counted(t.uncertain, "piece").c_str(), counted(o.nearest, "triangle").c_str());
  std::printf("  body        %s in %s, for cells of %g\n"
              "  time        %.3g ms a pose; grid %.3g s, %.3g MB; %s\n",
              counted(collision.n_triangles(), "triangle").c_str(),
              counted(collision.n_pieces(), "piece").c_str(), grid.length, ms, grid.seconds,
              1e-6 * static_cast<double>(grid.bytes), collision.device().c_str());
}

void check(const CollideOptions &o)
{
  check_outputs({{"--output", o.output}, {"--segments", o.segments}}, {o.wall, o.body, o.poses});
  try {
    if (!o.pose.empty()) pose_of_numbers(o.pose);
  } catch (const InputError &e) {
    throw_usage_error("--pose", e.what());
  }
  if (!o.poses.empty()) {
    BodyPose first;
    PoseReader(o.poses).read(first);
  }
}

void collide(const CollideOptions &o)
{
#if defined(_OPENMP)
  threads_asked_for() = true;    // a program of one user, not one of many processes
  if (o.threads > 0) omp_set_num_threads(o.threads);
#endif
  check(o);
  std::unique_ptr<PairWriter> pairs, segments;
  if (!o.output.empty()) pairs = open_pairs(o.output);
  if (!o.segments.empty()) segments = open_segments(o.segments);
  const WeldedMesh wall = load_wall(o.wall, o.place, o.weld),
                   body = load_mesh(o.body, o.body_place, o.weld);
  MeshCollisionSettings settings;
  settings.cell = o.cell;
  settings.nearest = o.nearest;
  settings.memory = static_cast<std::size_t>(o.memory * 1048576);
  settings.device = o.device == "cpu"    ? Device::cpu
                    : o.device == "cuda" ? Device::cuda
                                         : Device::automatic;
  MeshCollision collision(wall, body, settings);
  const CollideTotals totals = run(o, collision, pairs.get(), segments.get());
  if (pairs) pairs->commit();
  if (segments) segments->commit();
  print(o, totals, collision);
}

void add_options(Command &command, CollideOptions &o)
{
  command.option("wall", o.wall, "mesh: .stl, .obj, .ply or .off").required();
  command.option("body", o.body, "mesh of the rigid body").required();
  Option one = command.option(
      "--pose", o.pose,
      "where the body is: x y z, x y z qw qx qy qz, or 12 numbers (default: as it is)");
  one.words(3, 12).shows_words("3, 7 or 12 NUMBERS");
  command.option("--poses", o.poses, "file with a pose a line").excludes(one);
  command.option("-o,--output", o.output, "pairs of triangles that meet, to a .csv file");
  command.option("--segments", o.segments,
                 "where they cut each other, to a .csv file or lines for ParaView, .vtp");
  add_placement_options(command, o.place, "wall");
  add_placement_options(command, o.body_place, "body");
  add_weld_option(command, o.weld);
  command.option("--grid", o.cell, "cell length (default: the median edge of the body)")
      .check(above_zero);
  command.option("--nearest", o.nearest, "triangles a cell, which may miss pairs (default: all)")
      .range(1, kMaxNearest);
  command
      .option("--memory", o.memory,
              "memory budget of the grid in MB (default: 1024 beside the mesh)")
      .check(above_zero);
  command.option("--device", o.device, "device that computes")
      .one_of({"auto", "cpu", "cuda"})
      .shows_default();
  command.option("--threads", o.threads, "threads on the CPU (default: OMP_NUM_THREADS, or all)")
      .range(1, 4096);
  command.flag("--progress", o.progress,
               "show the progress even if standard error is not a terminal");
  command.flag("--json", o.json, "print JSON");
}

}    // namespace

void add_collide_command(Command &program)
{
  const auto o = std::make_shared<CollideOptions>();
  Command command =
      program.command("collide", "finds which triangles of a rigid body meet which of a wall");
  add_options(command, *o);
  command.footer(
      "A pose turns the body about the origin of its file by a unit quaternion, w first, and then\n"
      "moves it by x y z; or it is three rows of a rotation matrix, each with its number of the\n"
      "shift. In a file, empty lines, lines that begin with # and a first line of names are "
      "skipped.\n"
      "Triangles that only touch count as a pair. Surfaces count: a body completely inside a\n"
      "closed wall meets nothing.\n"
      "Columns of pairs: pose (from 0), wall_triangle and body_triangle (of the files, from 0; "
      "-1:\n"
      "one without area); of segments also from_x to to_z, nan if both lie in one plane.\n"
      "Example:\n"
      "  lsdcd collide wall.stl body.stl --pose 0 0 1.5 0.7071 0.7071 0 0 -o pairs.csv");
  command.runs([o] { collide(*o); });
}

}    // namespace lsdcd
