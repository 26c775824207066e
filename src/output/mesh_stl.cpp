// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "output/mesh_stl.h"

#include "base/atomic_file.h"
#include "output/file_bytes.h"

#include <algorithm>

namespace lsdcd {

namespace {

// From the rounded corners of the file, so that reading and writing it changes nothing.
Vec3 normal_of(const Vec3 *corner)
{
  const Vec3 n = cross(corner[1] - corner[0], corner[2] - corner[0]);
  return norm_sq(n) > 0 ? (1 / norm(n)) * n : n;
}

// volatile: g++ 12 with -O3 drops the rounding double -> float -> double of two neighbours.
Real rounded(Real x)
{
  const volatile float value = static_cast<float>(x);
  return value;
}

std::string binary(const TriangleSoup &soup)
{
  constexpr std::size_t kHeaderText = 80;
  std::string bytes = "binary STL of lsdcd";    // no "solid", by which text begins
  bytes.resize(kHeaderText, ' ');
  append_number(bytes, static_cast<std::uint32_t>(soup.n_triangles()));
  for (std::size_t c = 0; c < soup.corners.size(); c += 3) {
    append_numbers<float>(bytes, normal_of(&soup.corners[c]));
    for (int k = 0; k < 3; k++) append_numbers<float>(bytes, soup.corners[c + k]);
    bytes.append(2, '\0');    // attributes
  }
  return bytes;
}

std::string text(const TriangleSoup &soup)
{
  std::string bytes = "solid lsdcd\n";
  for (std::size_t c = 0; c < soup.corners.size(); c += 3) {
    append_line(bytes, "facet normal", normal_of(&soup.corners[c]));
    bytes += "outer loop\n";
    for (int k = 0; k < 3; k++) append_line(bytes, "vertex", soup.corners[c + k]);
    bytes += "endloop\nendfacet\n";
  }
  return bytes + "endsolid lsdcd\n";
}

}    // namespace

Vec3 rounded_as_in_stl(const Vec3 &corner)
{
  return {rounded(corner.x), rounded(corner.y), rounded(corner.z)};
}

bool are_floats(const std::vector<Vec3> &points)
{
  return std::all_of(points.begin(), points.end(),
                     [](const Vec3 &x) { return rounded_as_in_stl(x) == x; });
}

std::string stl_bytes(const TriangleSoup &soup)
{
  return are_floats(soup.corners) ? binary(soup) : text(soup);
}

void write_mesh_stl(const std::string &path, const WeldedMesh &mesh, const Pose &pose)
{
  TriangleSoup soup;
  soup.corners.reserve(3 * mesh.faces.size());
  for (const auto &f : mesh.faces)
    for (const int v : f) soup.corners.push_back(rounded_as_in_stl(pose.to_box(mesh.vertices[v])));
  write_whole_file(path, binary(soup));
}

}    // namespace lsdcd
