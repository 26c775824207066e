// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// `lsdcd distance` of very many points: what it takes of time and memory, and a sample of its
// answers against CGAL's tree in long double. Ends with 1 where they differ by more than 1e-13 of
// the diagonal. usage: bench_stream LSDCD FOLDER csv|npy RADIUS POINTS ..., the radius as part of
// the diagonal; the lion of libcgal-demo is unpacked into FOLDER, and points and answers are
// written there.
#include "mesh/welded_mesh.h"
#include "study/spheres.h"
#include "support/real_mesh.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace lsdcd;

namespace {

// In double, squares of small distances would have too few digits.
using Kernel = CGAL::Simple_cartesian<long double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

struct Case {
  std::string tool, folder, mesh, points, answers;
  SphereBox box;
  Real diagonal, radius;
  bool csv;
};

// Once in floats, so that the tool reads the numbers that CGAL gets.
void write_mesh(const TriangleSoup &soup, const std::string &path)
{
  std::FILE *out = std::fopen(path.c_str(), "wb");
  const std::vector<char> head(80, ' ');
  const std::uint32_t n = static_cast<std::uint32_t>(soup.n_triangles());
  std::fwrite(head.data(), 1, head.size(), out);
  std::fwrite(&n, sizeof n, 1, out);
  for (std::uint32_t t = 0; t < n; t++) {
    float numbers[12] = {};
    for (int k = 0; k < 9; k++)
      numbers[3 + k] = static_cast<float>((&soup.corners[3 * t + k / 3].x)[k % 3]);
    const std::uint16_t none = 0;
    std::fwrite(numbers, sizeof numbers, 1, out);
    std::fwrite(&none, sizeof none, 1, out);
  }
  std::fclose(out);
}

void write_points(const Case &c, std::size_t n)
{
  std::FILE *out = std::fopen(c.points.c_str(), "wb");
  if (!c.csv) {
    std::string head =
        "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(n) + ", 3), }";
    head.resize(118 - 1, ' ');
    std::fwrite("\x93NUMPY\x01\x00\x76\x00", 1, 10, out);
    std::fwrite((head + '\n').data(), 1, 118, out);
  }
  for (std::size_t i = 0; i < n; i++) {
    const Sphere s = c.box.sphere(i);
    if (c.csv)
      std::fprintf(out, "%.17g,%.17g,%.17g\n", s.x, s.y, s.z);
    else
      std::fwrite(&s.x, sizeof s.x, 3, out);
  }
  std::fclose(out);
}

struct Cost {
  double seconds, cpu_seconds, peak_mb;
  bool good;
};

Cost run_tool(const Case &c)
{
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {
    char radius[32];
    std::snprintf(radius, sizeof radius, "%.17g", double(c.radius));
    execl(c.tool.c_str(), c.tool.c_str(), "distance", c.mesh.c_str(), c.points.c_str(), "--radius",
          radius, "--device", "cpu", "-o", c.answers.c_str(), static_cast<char *>(nullptr));
    std::perror(c.tool.c_str());
    _exit(127);
  }
  int status = 0;
  rusage use = {};
  wait4(child, &status, 0, &use);
  const auto seconds = [](const timeval &t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          seconds(use.ru_utime) + seconds(use.ru_stime), double(use.ru_maxrss) * 1024 / 1e6,
          status == 0};
}

struct Answer {
  double distance = NAN, closest[3] = {};
};

// The answers of every step-th point, in order.
std::vector<Answer> read_answers(const Case &c, std::size_t n, std::size_t step)
{
  std::vector<Answer> found;
  std::FILE *in = std::fopen(c.answers.c_str(), "rb");
  if (c.csv) {
    char line[400];
    for (std::size_t i = 0; std::fgets(line, sizeof line, in); i++)
      if (i > 0 && (i - 1) % step == 0) {
        Answer a;
        std::sscanf(line, "%lf,%lf,%lf,%lf", &a.distance, &a.closest[0], &a.closest[1],
                    &a.closest[2]);
        found.push_back(a);
      }
  } else {
    // Distance, closest point, triangle, index and feature of a mesh without sides; doc/tool.md.
    constexpr long kHeader = 384, kRecord = 4 * sizeof(double) + 2 * sizeof(std::int32_t) + 1;
    for (std::size_t i = 0; i < n; i += step) {
      Answer a;
      std::fseek(in, kHeader + static_cast<long>(i) * kRecord, SEEK_SET);
      if (std::fread(&a, sizeof a, 1, in) == 1) found.push_back(a);
    }
  }
  std::fclose(in);
  return found;
}

// Largest difference from CGAL over the diagonal; infinite where one alone finds something. A
// closest point need not be the only one: it must be as far from the point as CGAL's is, and on
// the mesh.
double compare(const Case &c, const Tree &tree, const std::vector<Answer> &found, std::size_t step)
{
  long double most = 0;
  for (std::size_t k = 0; k < found.size(); k++) {
    const Sphere s = c.box.sphere(k * step);
    const long double exact = std::sqrt(tree.squared_distance({s.x, s.y, s.z}));
    const bool near = exact < static_cast<long double>(c.radius);
    const Answer &a = found[k];
    if (near != std::isfinite(a.distance)) return HUGE_VAL;
    if (!near) continue;
    const Kernel::Point_3 point(s.x, s.y, s.z), closest(a.closest[0], a.closest[1], a.closest[2]);
    most = std::max({most, std::fabs(a.distance - exact),
                     std::fabs(std::sqrt(CGAL::squared_distance(point, closest)) - exact),
                     std::sqrt(tree.squared_distance(closest))});
  }
  return static_cast<double>(most) / double(c.diagonal);
}

bool measure(const Case &c, const Tree &tree, std::size_t n)
{
  write_points(c, n);
  const Cost cost = run_tool(c);
  if (!cost.good) return false;
  constexpr std::size_t kSample = 100000;
  const std::size_t step = std::max<std::size_t>(1, n / kSample);
  const std::vector<Answer> found = read_answers(c, n, step);
  const double difference = compare(c, tree, found, step);
  std::printf("| %zu | %s | %.1f | %.1f | %.2f | %.0f | %zu | %.2g |\n", n, c.csv ? "csv" : "npy",
              cost.seconds, cost.cpu_seconds, double(n) / cost.cpu_seconds / 1e6, cost.peak_mb,
              found.size(), difference);
  std::fflush(stdout);
  std::remove(c.points.c_str());
  std::remove(c.answers.c_str());
  // The lion's triangles are up to 0.1 diagonals long and 15 times as long as high: where numbers
  // of up to 0.2 diagonals are rounded to 1.1e-16 of them, normals are off by some 4 * 15 of that,
  // and distances and points by 1.3e-15 diagonals. Formulas that lose 70 times more fail.
  return found.size() == (n + step - 1) / step && difference <= 1e-13;
}

}    // namespace

int main(int argc, char **argv)
{
  if (argc < 6 || !has_real_meshes()) {
    std::fprintf(stderr,
                 "usage: %s LSDCD FOLDER csv|npy RADIUS POINTS ...; needs %s of libcgal-demo\n",
                 argv[0], kRealMeshes);
    return argc < 6 ? 2 : 77;
  }
  Case c;
  c.tool = argv[1];
  c.folder = argv[2];
  c.csv = std::strcmp(argv[3], "csv") == 0;
  const TriangleSoup given = read_real_mesh("lion", c.folder);
  c.mesh = c.folder + "/lion.stl";
  c.points = c.folder + (c.csv ? "/points.csv" : "/points.npy");
  c.answers = c.folder + (c.csv ? "/answers.csv" : "/answers.npy");
  write_mesh(given, c.mesh);
  const TriangleSoup soup = read_stl(c.mesh);
  Vec3 lo = soup.corners[0], hi = lo;
  for (const Vec3 &x : soup.corners)
    for (int k = 0; k < 3; k++) lo[k] = fmin(lo[k], x[k]), hi[k] = fmax(hi[k], x[k]);
  c.diagonal = norm(hi - lo);
  c.radius = std::atof(argv[4]) * c.diagonal;
  c.box = {lo, hi, 1, 1};
  Triangles triangles;
  for (std::size_t t = 0; t < soup.n_triangles(); t++) {
    Kernel::Point_3 at[3];
    for (int k = 0; k < 3; k++) {
      const Vec3 &x = soup.corners[3 * t + k];
      at[k] = {x.x, x.y, x.z};
    }
    triangles.emplace_back(at[0], at[1], at[2]);
  }
  const Tree tree(triangles.cbegin(), triangles.cend());
  std::printf("| points | files | seconds | of processors | million points a second of one | peak "
              "memory, MB | compared | largest difference / diagonal |\n"
              "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  bool good = true;
  for (int i = 5; i < argc; i++)
    good &= measure(c, tree, static_cast<std::size_t>(std::atof(argv[i])));
  return good ? 0 : 1;
}
