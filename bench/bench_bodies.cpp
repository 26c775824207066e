// The paper's section 4.6: a lion in small triangles against the paper's cylinder, by poses, beside
// CGAL's AABB tree with exact predicates. One core unless OMP_NUM_THREADS says more.
// usage: bench_bodies FOLDER [CELL [POSES]]; the lion is unpacked into FOLDER.
#include "bench.h"

#include "bodies/body_collision.h"
#include "study/cylinder.h"
#include "support/cgal_collision.h"
#include "support/real_mesh.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

using namespace lsdcd;

namespace {

BodyPose pose_of(Real turn, Real off, Real height)
{
  BodyPose pose;
  pose.row[0] = {std::cos(turn), -std::sin(turn), 0};
  pose.row[1] = {std::sin(turn), std::cos(turn), 0};
  pose.shift = {off * std::cos(turn), off * std::sin(turn), height};
  return pose;
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

void row(const char *what, const std::vector<double> &ms, std::size_t pairs)
{
  const Timing t = timing_of(ms);
  std::printf("| %s | %.2f (%.2f to %.2f) | %zu |\n", what, t.median_ms, t.min_ms, t.max_ms, pairs);
}

void measure(const std::string &folder, Real cell, int n_poses, Device device)
{
  TriangleSoup lion = read_real_mesh("lion", folder);
  centre(lion, 25);
  const WallMesh wall = weld(make_cylinder(CylinderMesh()), 0);
  std::vector<BodyPose> poses;
  for (int k = 0; k < n_poses; k++)
    poses.push_back(pose_of(0.7 * k, 39 + 8. * k / n_poses, k % 3 == 0 ? 92 : 50));
  std::size_t expected = 0;
  for (const int n : {kEveryTriangle, 1, 2, 3}) {
    GridSettings settings = collision_grid(lion, cell, n);
    settings.memory_budget = std::size_t(8) << 30;
    const TriangleGrid grid = build_grid(wall, settings);
    const auto ours = make_body_collision(device);
    ours->set_wall(grid);
    const double cut_ms = milliseconds([&] { ours->set_body(lion); });
    std::vector<double> ms;
    std::size_t pairs = 0, uncertain = 0;
    ours->collide(poses[0]);
    for (const BodyPose &pose : poses) {
      Collision found;
      ms.push_back(milliseconds([&] { found = ours->collide(pose); }, device == Device::cpu));
      pairs += found.pairs.size();
      uncertain += found.uncertain;
    }
    if (n == kEveryTriangle) {
      expected = pairs;
      std::printf("lion of %zu triangles in %zu pieces (cut in %.0f ms), wall of %zu triangles, "
                  "cells of %g, grid of %.0f MB built in %.2f s, %s\n\n",
                  lion.n_triangles(), ours->n_pieces(), cut_ms, wall.faces.size(),
                  double(grid.length), grid.report.bytes / 1e6, grid.report.seconds,
                  ours->device().c_str());
      std::printf("| | ms a pose | pairs in %d poses |\n| --- | --- | --- |\n", n_poses);
      row("lists of every triangle", ms, pairs);
    } else {
      row(format("the %d nearest: misses %zu, %zu pieces uncertain", n, expected - pairs, uncertain)
              .c_str(),
          ms, pairs);
    }
  }
  const CgalCollision cgal(wall);
  std::vector<double> ms;
  std::size_t pairs = 0;
  for (const BodyPose &pose : poses)
    ms.push_back(milliseconds([&] { pairs += cgal.collide(lion, pose).size(); }));
  row("CGAL's tree, the lion's own triangles", ms, pairs);
}

}    // namespace

int main(int argc, char **argv)
{
  if (argc < 2 || !has_real_meshes()) {
    std::fprintf(stderr, "usage: %s FOLDER [CELL [POSES]]; needs %s of libcgal-demo\n", argv[0],
                 kRealMeshes);
    return 2;
  }
  std::string why;
  measure(argv[1], argc > 2 ? std::atof(argv[2]) : 0.1, argc > 3 ? std::atoi(argv[3]) : 10,
          cuda_available(&why) ? Device::cuda : Device::cpu);
}
