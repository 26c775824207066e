// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The paper's section 4.6: a lion in 1.77 million triangles against the paper's cylinder, by poses,
// and the same of the lion's own triangles, beside CGAL's AABB tree with exact predicates and FCL's
// trees of boxes where these are installed. On one core unless OMP_NUM_THREADS says more. Pairs
// that are not those of CGAL are an error.
#include "bench.h"

#include "bodies/body_collision.h"
#include "bodies/subdivide.h"
#include "study/cylinder.h"
#include "support/real_mesh.h"
#if defined(LSDCD_WITH_CGAL)
#include "support/cgal_collision.h"
#endif
#if defined(LSDCD_WITH_FCL)
#include "fcl_collision.h"
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

using namespace lsdcd;

namespace {

const char *const kUsage =
    "usage: bench_bodies [--device cpu|cuda] [--cell LENGTH] [--edge LENGTH] [--poses N] FOLDER\n"
    "  FOLDER   has data/meshes/lion.off, or gets it from Debian's libcgal-demo\n"
    "  --cell   of the wall's grid; 0.1\n"
    "  --edge   the longest of the divided lion; 0.0625, which makes 1.77 million triangles\n";

struct Words {
  std::string folder;
  Device device = Device::cpu;
  Real cell = 0.1, edge = 0.0625;
  int poses = 10;
};

struct Case {
  const char *name;
  TriangleSoup body;
};

BodyPose pose_of(Real turn, Real off, Real height)
{
  BodyPose pose;
  pose.row[0] = {std::cos(turn), -std::sin(turn), 0};
  pose.row[1] = {std::sin(turn), std::cos(turn), 0};
  pose.shift = {off * std::cos(turn), off * std::sin(turn), height};
  return pose;
}

std::vector<BodyPose> poses_of(int n)
{
  std::vector<BodyPose> poses;
  for (int k = 0; k < n; k++)
    poses.push_back(pose_of(0.7 * k, 39 + 8. * k / n, k % 3 == 0 ? 92 : 50));
  return poses;
}

TriangleSoup divided(const TriangleSoup &whole, Real edge)
{
  TriangleSoup parts;
  parts.source = whole.source;
  for (std::size_t t = 0; t < whole.n_triangles(); t++) {
    const Vec3 *c = &whole.corners[3 * t];
    for_each_piece({{c[0], c[1], c[2]}}, edge, [&](const Triangle &piece) {
      parts.corners.insert(parts.corners.end(), piece.corner, piece.corner + 3);
    });
  }
  return parts;
}

// On one core the time that it works, so that others on the machine do not count.
template <class F>
double milliseconds(const F &f, bool on_cpu = true)
{
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t worked = std::clock();
  f();
  if (on_cpu) return 1e3 * double(std::clock() - worked) / CLOCKS_PER_SEC;
  return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void row(const std::string &what, const std::vector<double> &ms, std::size_t pairs)
{
  const Timing t = timing_of(ms);
  std::printf("| %s | %.3f (%.3f to %.3f) | %zu |\n", what.c_str(), t.median_ms, t.min_ms, t.max_ms,
              pairs);
  std::fflush(stdout);
}

using Pairs = std::vector<std::vector<BodyPair>>;    // by pose

std::size_t count(const Pairs &pairs)
{
  std::size_t n = 0;
  for (const auto &p : pairs) n += p.size();
  return n;
}

Pairs ours(const Words &words, const WeldedMesh &wall, const Case &c, ListKind list_kind,
           const Pairs &expected)
{
  GridSettings settings = collision_grid(c.body, words.cell, list_kind);
  settings.memory_budget = std::size_t(8) << 30;
  const TriangleGrid grid = build_grid(wall, settings);
  const auto collision = make_body_collision(words.device);
  collision->set_wall(grid);
  const bool on_cpu = words.device == Device::cpu;
  const double cut_ms = milliseconds([&] { collision->set_body(c.body); }, on_cpu);
  const bool all = list_kind.is_every();
  if (all)
    std::printf(
        "\nlion %s, %zu triangles in %zu pieces (cut in %.0f ms), wall of %zu triangles, cells "
        "of %g, grid of %.0f MB built in %.2f s, %s\n\n| | ms a pose | pairs in %d poses |\n"
        "| --- | --- | --- |\n",
        c.name, c.body.n_triangles(), collision->n_pieces(), cut_ms, wall.faces.size(),
        double(grid.length), grid.report.bytes / 1e6, grid.report.seconds,
        collision->device().c_str(), words.poses);
  std::vector<double> ms, ms_segments;
  Pairs pairs;
  std::uint64_t uncertain = 0;
  collision->collide(poses_of(words.poses)[0], true);    // warms up
  for (const BodyPose &pose : poses_of(words.poses)) {
    Collision found;
    ms.push_back(milliseconds([&] { found = collision->collide(pose); }, on_cpu));
    ms_segments.push_back(milliseconds([&] { collision->collide(pose, true); }, on_cpu));
    pairs.push_back(found.pairs);
    uncertain += found.uncertain;
  }
  if (all) {
    row("lists of every triangle", ms, count(pairs));
    row("the same with segments", ms_segments, count(pairs));
  } else {
    row(format("the %u nearest: misses %zu, %zu pieces uncertain", list_kind.most(),
               count(expected) - count(pairs), std::size_t(uncertain)),
        ms, count(pairs));
  }
  return pairs;
}

#if defined(LSDCD_WITH_CGAL) || defined(LSDCD_WITH_FCL)
template <class Other>
Pairs theirs(const char *name, Other &other, const Words &words)
{
  std::vector<double> ms;
  Pairs pairs;
  for (const BodyPose &pose : poses_of(words.poses))
    ms.push_back(milliseconds([&] { pairs.push_back(other(pose)); }));
  row(name, ms, count(pairs));
  return pairs;
}
#endif

bool measure(const Words &words, const WeldedMesh &wall, const Case &c)
{
  const Pairs found = ours(words, wall, c, ListKind::every(), {});
  for (const int n : {1, 2, 3}) ours(words, wall, c, ListKind::nearest(n), found);
  bool right = true;
#if defined(LSDCD_WITH_CGAL)
  const CgalCollision tree(wall);
  const auto cgal = [&](const BodyPose &pose) { return tree.collide(c.body, pose); };
  right = theirs("CGAL's tree of the wall, exact predicates", cgal, words) == found;
#else
  std::printf("| CGAL: skipped, not there when this was built (libcgal-dev) | | |\n");
#endif
#if defined(LSDCD_WITH_FCL)
  const FclCollision boxes(wall, c.body);
  const auto fcl = [&](const BodyPose &pose) { return boxes.collide(pose); };
  theirs("FCL's trees of both", fcl, words);
#else
  std::printf("| FCL: skipped, not there when this was built (libfcl-dev) | | |\n");
#endif
  if (!right) std::printf("\nERROR: pairs are not those of CGAL\n");
  return right;
}

bool read_words(int argc, char **argv, Words &words)
{
  for (int k = 1; k < argc; k++) {
    const std::string word = argv[k];
    if (word.compare(0, 2, "--") != 0) {
      words.folder = word;
      continue;
    }
    if (k + 1 == argc) return false;
    const std::string value = argv[++k];
    if (word == "--device" && (value == "cpu" || value == "cuda"))
      words.device = value == "cpu" ? Device::cpu : Device::cuda;
    else if (word == "--cell")
      words.cell = std::atof(value.c_str());
    else if (word == "--edge")
      words.edge = std::atof(value.c_str());
    else if (word == "--poses")
      words.poses = std::atoi(value.c_str());
    else
      return false;
  }
  return !words.folder.empty() && words.cell > 0 && words.edge > 0 && words.poses > 0;
}

}    // namespace

int main(int argc, char **argv)
{
  Words words;
  if (!read_words(argc, argv, words)) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  try {
    TriangleSoup lion = read_real_mesh("lion", words.folder);
    centre(lion, 25);
    const WeldedMesh wall = weld(make_cylinder(CylinderMesh()), 0);
    const Case cases[] = {{"divided", divided(lion, words.edge)}, {"as it is", lion}};
    bool right = true;
    for (const Case &c : cases) right = measure(words, wall, c) && right;
    return right ? 0 : 1;
  } catch (const InputError &e) {
    std::fprintf(stderr, "bench_bodies: %s\n", e.what());
    return 1;
  }
}
