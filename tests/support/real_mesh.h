// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Real meshes of CGAL's documentation (Debian's libcgal-demo), unpacked when they are asked for.
#pragma once

#include "base/input_error.h"
#include "mesh/triangle_soup.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace lsdcd {

constexpr const char *kRealMeshes = "/usr/share/doc/libcgal-dev/data.tar.gz";

inline bool has_real_meshes()
{
  return std::filesystem::exists(kRealMeshes);
}

// Reads a mesh of triangles alone; `folder` is where it is unpacked.
inline TriangleSoup read_real_mesh(const std::string &name, const std::string &folder)
{
  const std::string in_archive = "data/meshes/" + name + ".off", path = folder + "/" + in_archive;
  if (!std::filesystem::exists(path)) {
    std::filesystem::create_directories(folder);
    const std::string command =
        std::string("tar xzf '") + kRealMeshes + "' -C '" + folder + "' " + in_archive;
    if (std::system(command.c_str()) != 0) throw InputError(command + " failed");
  }
  std::ifstream in(path);
  std::string word;
  std::size_t n_vertices = 0, n_faces = 0, n_edges = 0;
  in >> word >> n_vertices >> n_faces >> n_edges;
  std::vector<Vec3> p(n_vertices);
  for (Vec3 &x : p) in >> x.x >> x.y >> x.z;
  TriangleSoup soup;
  soup.source = name;
  for (std::size_t f = 0; f < n_faces; f++) {
    std::size_t n = 0, v[3] = {0, 0, 0};
    in >> n >> v[0] >> v[1] >> v[2];
    if (!in || n != 3) throw InputError(path + " is not all triangles");
    in.ignore(1000, '\n');
    for (std::size_t k : v) soup.corners.push_back(p.at(k));
  }
  return soup;
}

// Its box's centre to the origin, and its longest side to `size`.
inline void centre(TriangleSoup &soup, Real size)
{
  Vec3 lo = soup.corners[0], hi = lo;
  for (const Vec3 &x : soup.corners)
    for (int k = 0; k < 3; k++) lo[k] = fmin(lo[k], x[k]), hi[k] = fmax(hi[k], x[k]);
  const Real longest = fmax(hi.x - lo.x, fmax(hi.y - lo.y, hi.z - lo.z));
  for (Vec3 &x : soup.corners) x = (size / longest) * (x - Real(0.5) * (lo + hi));
}

}    // namespace lsdcd
