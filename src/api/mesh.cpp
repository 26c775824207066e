// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_mesh_*
#include "api/c_border.h"
#include "api/objects.h"
#include "base/input_words.h"
#include "mesh/io/read_mesh.h"
#include "mesh/weld_map.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

using namespace lsdcd;

namespace {

// All of a mesh but what became of vertices as given. `corner_vertex` becomes the vertex of each corner.
std::shared_ptr<ApiMesh> welded(const TriangleSoup &soup, double weld_tolerance,
                                std::vector<int> &corner_vertex)
{
  if (std::isnan(weld_tolerance) || weld_tolerance > std::numeric_limits<double>::max())
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   "`weld` is not finite: give a length, or -1 for the default");
  auto mesh = std::make_shared<ApiMesh>();
  mesh->mesh = weld(soup, weld_tolerance, corner_vertex);
  mesh->welded_face = faces_of_facets(mesh->mesh, corner_vertex);
  mesh->report = describe(mesh->mesh.report, soup.source);
  return mesh;
}

void check_number(std::size_t n, const std::string &name)
{
  if (n == 0) throw ApiError(LSDCD_ERROR_ARGUMENT, "`" + name + "` is 0: a mesh has triangles");
  constexpr std::size_t kMax = std::numeric_limits<int>::max() / 3;
  if (n > kMax)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "`" + name + "` is " + std::to_string(n) +
                                             "; a mesh has at most " + std::to_string(kMax));
}

TriangleSoup soup_of(const double *corners, std::size_t n)
{
  check_number(n, "n_triangles");
  TriangleSoup soup;
  soup.source = "from corners";
  soup.corners.reserve(3 * n);
  for (std::size_t k = 0; k < 3 * n; k++) {
    const Vec3 p = {corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]};
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw InputError("triangle " + std::to_string(k / 3) + " (from 0): a corner is not finite");
    soup.corners.push_back(p);
  }
  return soup;
}

template <class T>
TriangleSoup soup_of(const T *vertices, std::size_t n_vertices, const std::uint32_t *faces,
                     std::size_t n)
{
  check_number(n, "n_faces");
  TriangleSoup soup;
  soup.source = "from faces";
  soup.rounding.step = std::numeric_limits<T>::epsilon();
  soup.corners.reserve(3 * n);
  for (std::size_t k = 0; k < 3 * n; k++) {
    const std::size_t v = faces[k];
    const auto refuse = [&](const std::string &text) {
      throw InputError("face " + std::to_string(k / 3) + " (from 0) has the vertex " +
                       std::to_string(v) + text);
    };
    if (v >= n_vertices) refuse("; there are " + std::to_string(n_vertices) + ", numbered from 0");
    for (int a = 0; a < 3; a++)
      if (!std::isfinite(vertices[3 * v + a]))
        refuse(std::string(", whose ") + "xyz"[a] + " is " + number_text(vertices[3 * v + a]) +
               "; coordinates are finite");
    soup.corners.push_back({vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]});
  }
  return soup;
}

// Copies rows of an array of the mesh, if it is asked for.
template <class T, std::size_t kColumns>
void copy_rows(const std::vector<std::array<T, kColumns>> &rows, std::uint32_t *to)
{
  if (!to) return;
  for (const auto &row : rows)
    for (const T x : row) *to++ = static_cast<std::uint32_t>(x);
}
template <class T>
void copy_numbers(const std::vector<T> &numbers, std::uint32_t *to)
{
  if (!to) return;
  for (const T x : numbers) *to++ = static_cast<std::uint32_t>(x);
}

}    // namespace

extern "C" {

int lsdcd_mesh_read(const char *file, double weld, lsdcd_mesh **mesh)
{
  return guard([&] {
    need(mesh, "mesh");
    need(file, "file");
    const ReadMesh read = read_mesh(file);
    std::vector<int> corner_vertex;
    auto made = welded(read.soup, weld, corner_vertex);
    made->welded_vertex = read.vertices.empty()
                              ? std::move(corner_vertex)
                              : vertices_at(read.vertices, read.soup.corners, corner_vertex);
    made->file = file;
    *mesh = new lsdcd_mesh{std::move(made)};
  });
}

int lsdcd_mesh_from_corners(const double *corners, size_t n_triangles, double weld,
                            lsdcd_mesh **mesh)
{
  return guard([&] {
    need(mesh, "mesh");
    need(corners, "corners");
    std::vector<int> corner_vertex;
    auto made = welded(soup_of(corners, n_triangles), weld, corner_vertex);
    made->welded_vertex = std::move(corner_vertex);
    *mesh = new lsdcd_mesh{std::move(made)};
  });
}

int lsdcd_mesh_from_faces(const void *vertices, int type, size_t n_vertices, const uint32_t *faces,
                          size_t n_faces, double weld, lsdcd_mesh **mesh)
{
  return guard([&] {
    need(mesh, "mesh");
    need(vertices, "vertices");
    need(faces, "faces");
    check_type(type);
    if (n_vertices > LSDCD_NONE)
      throw ApiError(LSDCD_ERROR_ARGUMENT, "`n_vertices` is " + std::to_string(n_vertices) +
                                               "; faces number at most " +
                                               std::to_string(LSDCD_NONE));
    std::vector<int> corner_vertex;
    auto made =
        welded(type == LSDCD_FLOAT
                   ? soup_of(static_cast<const float *>(vertices), n_vertices, faces, n_faces)
                   : soup_of(static_cast<const double *>(vertices), n_vertices, faces, n_faces),
               weld, corner_vertex);
    made->welded_vertex.assign(n_vertices, kNoVertex);
    for (std::size_t k = 0; k < corner_vertex.size(); k++)
      made->welded_vertex[faces[k]] = corner_vertex[k];
    *mesh = new lsdcd_mesh{std::move(made)};
  });
}

int lsdcd_mesh_get_arrays(const lsdcd_mesh *mesh, const lsdcd_mesh_arrays *arrays)
{
  return guard([&] {
    need(mesh, "mesh");
    const lsdcd_mesh_arrays to = checked(arrays, "lsdcd_mesh_arrays");
    const WeldedMesh &m = mesh->in->mesh;
    if (double *at = to.vertices)
      for (const Vec3 &v : m.vertices)
        for (int a = 0; a < 3; a++) *at++ = v[a];
    copy_rows(m.faces, to.faces);
    copy_rows(m.face_edges, to.face_edges);
    copy_numbers(m.face_facet, to.triangle);
    copy_rows(m.edges, to.edges);
    copy_numbers(m.edge_first, to.edge_first);
    copy_numbers(m.edge_face, to.edge_faces);
    copy_numbers(mesh->in->welded_vertex, to.welded_vertex);
    copy_numbers(mesh->in->welded_face, to.welded_face);
  });
}

int lsdcd_mesh_get_facts(const lsdcd_mesh *mesh, lsdcd_mesh_facts *facts)
{
  return guard([&] {
    need(mesh, "mesh");
    lsdcd_mesh_facts f = checked(facts, "lsdcd_mesh_facts");
    const WeldedMesh &m = mesh->in->mesh;
    f.triangles = m.report.facets;
    f.faces = m.faces.size();
    f.edges = m.edges.size();
    f.vertices = m.vertices.size();
    f.given_vertices = mesh->in->welded_vertex.size();
    f.open_edges = m.report.open_edges;
    f.meeting_pairs = m.report.meeting_pairs;
    f.closed = m.report.closed;
    f.oriented = m.report.oriented;
    f.area = m.report.area;
    f.volume = m.report.volume;
    for (int k = 0; k < 3; k++) {
      f.lo[k] = m.report.lo[k];
      f.hi[k] = m.report.hi[k];
    }
    copy_out(f, facts);
  });
}

const char *lsdcd_mesh_report(const lsdcd_mesh *mesh)
{
  return mesh ? mesh->in->report.c_str() : "";
}

void lsdcd_mesh_free(lsdcd_mesh *mesh)
{
  delete mesh;
}

}    // extern "C"
