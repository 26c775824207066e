// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "output/mesh_file.h"

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "mesh/io/read_mesh.h"
#include "mesh/weld_points.h"
#include "output/file_bytes.h"
#include "output/mesh_stl.h"

#include <iterator>

namespace lsdcd {

namespace {

// Calls f with the three vertices of each triangle.
template <class F>
void for_each_triangle(const WeldedPoints &mesh, F f)
{
  for (std::size_t c = 0; c < mesh.corner_point.size(); c += 3)
    f(mesh.corner_point[c], mesh.corner_point[c + 1], mesh.corner_point[c + 2]);
}

std::string obj(const TriangleSoup &soup)
{
  const WeldedPoints mesh = weld_points(soup.corners, 0);
  std::string bytes = "# lsdcd\n";
  for (const Vec3 &x : mesh.points) append_line(bytes, "v", x);
  for_each_triangle(mesh, [&](int a, int b, int c) {    // counted from 1
    bytes += 'f';
    for (const int v : {a, b, c}) bytes += ' ' + std::to_string(v + 1);
    bytes += '\n';
  });
  return bytes;
}

std::string off(const TriangleSoup &soup)
{
  const WeldedPoints mesh = weld_points(soup.corners, 0);
  std::string bytes = "OFF\n" + std::to_string(mesh.points.size()) + ' ' +
                      std::to_string(mesh.corner_point.size() / 3) + " 0\n";
  for (const Vec3 &x : mesh.points) append_line(bytes, "", x);
  for_each_triangle(mesh, [&](int a, int b, int c) {
    bytes += '3';
    for (const int v : {a, b, c}) bytes += ' ' + std::to_string(v);
    bytes += '\n';
  });
  return bytes;
}

std::string ply(const TriangleSoup &soup)
{
  const WeldedPoints mesh = weld_points(soup.corners, 0);
  const bool floats = are_floats(mesh.points);
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment lsdcd\nelement vertex " +
                      std::to_string(mesh.points.size()) + '\n';
  for (const char *axis : {"x\n", "y\n", "z\n"})
    bytes += (floats ? "property float " : "property double ") + std::string(axis);
  bytes += "element face " + std::to_string(mesh.corner_point.size() / 3) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3 &x : mesh.points) {
    if (floats)
      append_numbers<float>(bytes, x);
    else
      append_numbers<double>(bytes, x);
  }
  for_each_triangle(mesh, [&](int a, int b, int c) {
    bytes += '\3';
    for (const int v : {a, b, c}) append_number(bytes, v);
  });
  return bytes;
}

struct Format {
  const char *ending;
  std::string (*bytes_of)(const TriangleSoup &soup);
};

const Format kFormats[] = {
    {".stl", stl_bytes},
    {".obj", obj},
    {".ply", ply},
    {".off", off},
};

const Format &format_of(const std::string &path)
{
  const std::string ending = name_ending(path);
  std::string all;
  for (const Format &f : kFormats) {
    if (ending == f.ending) return f;
    all += (all.empty()                    ? ""
            : &f + 1 == std::end(kFormats) ? " or "
                                           : ", ") +
           std::string(f.ending);
  }
  throw InputError("'" + path + "': the name of a mesh ends with " + all);
}

}    // namespace

void check_mesh_name(const std::string &path)
{
  format_of(path);
}

void write_mesh_file(const std::string &path, const TriangleSoup &soup)
{
  write_whole_file(path, format_of(path).bytes_of(soup));
}

}    // namespace lsdcd
