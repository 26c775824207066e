// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The header of 0.9.0 as it was, which is never changed.
//
// lsdcd.h for C++17: objects that free themselves, errors as exceptions. It is only a header over the C
// library. lsdcd.h says what functions do and which threads may call them.
#ifndef LSDCD_HPP
#define LSDCD_HPP

#include "lsdcd.h"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace lsdcd {
inline namespace cpp_api {    // the library has a Wall, too, which these names must not meet

class Error : public std::runtime_error {
 public:
  explicit Error(int code) : Error(code, lsdcd_last_error()) {}
  Error(int code, const std::string &text) : std::runtime_error(text), code_(code) {}
  int code() const noexcept { return code_; }    // LSDCD_ERROR_*

 private:
  int code_;
};

// What a long call does now, and how much of that is done, from 0 to 1; see lsdcd_progress. True cancels the call,
// which throws LSDCD_ERROR_CANCELLED; what this throws, the call throws.
using Progress = std::function<bool(const char *what, double done)>;

namespace c {
inline void check(int code)
{
  if (code != LSDCD_OK) throw Error(code);
}
// call(options) with a listener in its options, whose copy they are.
template <class Options, class Call>
void check_with(const Progress &progress, Options options, const Call &call)
{
  if (!progress) return check(call(options));
  struct Told {
    const Progress &progress;
    std::exception_ptr thrown;    // which must not pass through C
  } told = {progress, nullptr};
  options.data = &told;
  options.progress = [](void *data, const char *what, double done) {
    Told &to = *static_cast<Told *>(data);
    try {
      return to.progress(what, done) ? 1 : 0;
    } catch (...) {
      to.thrown = std::current_exception();
      return 1;
    }
  };
  const int code = call(options);
  if (told.thrown) std::rethrow_exception(told.thrown);
  check(code);
}
template <auto kFree>
struct Free {
  template <class T>
  void operator()(T *handle) const
  {
    kFree(handle);
  }
};
template <class T>
constexpr int type_of()
{
  static_assert(std::is_same_v<T, float> || std::is_same_v<T, double>, "float or double");
  return std::is_same_v<T, float> ? LSDCD_FLOAT : LSDCD_DOUBLE;
}
}    // namespace c

using MeshFacts = lsdcd_mesh_facts;
using GridFacts = lsdcd_grid_facts;

// The welded mesh, whose numbers features have; see lsdcd_mesh_arrays.
struct MeshArrays {
  std::vector<double> vertices;                                // 3 numbers each
  std::vector<std::uint32_t> faces, face_edges, triangle;      // 3, 3 and 1 of each face
  std::vector<std::uint32_t> edges, edge_first, edge_faces;    // 2 vertices of each edge; its faces
};

class Mesh {
 public:
  explicit Mesh(const std::string &file, double weld = -1)
  {
    lsdcd_mesh *made = nullptr;
    c::check(lsdcd_mesh_read(file.c_str(), weld, &made));
    handle_.reset(made);
  }
  // Nine numbers a triangle.
  explicit Mesh(const std::vector<double> &corners, double weld = -1)
  {
    lsdcd_mesh *made = nullptr;
    if (corners.size() % 9 != 0)
      throw Error(LSDCD_ERROR_ARGUMENT, "lsdcd::Mesh: there are " + std::to_string(corners.size()) +
                                            " corners' numbers, which is not nine a triangle");
    c::check(lsdcd_mesh_from_corners(corners.data(), corners.size() / 9, weld, &made));
    handle_.reset(made);
  }

  // Vertices x y z x y z of float or double; faces, three numbers of vertices from 0 each.
  template <class T>
  Mesh(const std::vector<T> &vertices, const std::vector<std::uint32_t> &faces, double weld = -1)
  {
    lsdcd_mesh *made = nullptr;
    if (vertices.size() % 3 != 0 || faces.size() % 3 != 0)
      throw Error(LSDCD_ERROR_ARGUMENT,
                  "lsdcd::Mesh: there are " + std::to_string(vertices.size()) +
                      " numbers of vertices and " + std::to_string(faces.size()) +
                      " of faces, which is not three each");
    c::check(lsdcd_mesh_from_faces(vertices.data(), c::type_of<T>(), vertices.size() / 3,
                                   faces.data(), faces.size() / 3, weld, &made));
    handle_.reset(made);
  }

  MeshArrays arrays() const
  {
    const MeshFacts f = facts();
    MeshArrays a;
    a.vertices.resize(3 * f.vertices);
    a.faces.resize(3 * f.faces);
    a.face_edges.resize(3 * f.faces);
    a.triangle.resize(f.faces);
    a.edges.resize(2 * f.edges);
    a.edge_first.resize(f.edges + 1);
    a.edge_faces.resize(3 * f.faces);
    const lsdcd_mesh_arrays to = {sizeof to,           a.vertices.data(),  a.faces.data(),
                                  a.face_edges.data(), a.triangle.data(),  a.edges.data(),
                                  a.edge_first.data(), a.edge_faces.data()};
    c::check(lsdcd_mesh_get_arrays(get(), &to));
    return a;
  }
  MeshFacts facts() const
  {
    MeshFacts f = {};
    f.size = sizeof f;
    c::check(lsdcd_mesh_get_facts(get(), &f));
    return f;
  }
  std::string report() const { return lsdcd_mesh_report(get()); }
  const lsdcd_mesh *get() const { return handle_.get(); }

 private:
  std::unique_ptr<lsdcd_mesh, c::Free<lsdcd_mesh_free>> handle_;
};

// All that is 0 has its default. Without a cutoff distances at any range are found.
struct GridOptions : lsdcd_grid_options {
  explicit GridOptions(double largest = 0) : lsdcd_grid_options()
  {
    size = sizeof(lsdcd_grid_options);
    cutoff = largest;
  }
};

// A query of n points; T: float or double, of all arrays of numbers. Set the arrays of the answers that you
// want. Members are those of lsdcd_query, which it becomes.
template <class T>
struct Query {
  Query(const T *first, std::size_t count) : n(count), points(first) {}

  std::size_t n;
  int threads = 0;
  const T *points;
  std::ptrdiff_t points_row = 0, points_column = 0;
  const T *radii = nullptr;
  std::ptrdiff_t radii_step = 0;
  double radius = 0;
  T *distance = nullptr;
  std::ptrdiff_t distance_step = 0;
  T *closest = nullptr;
  std::ptrdiff_t closest_row = 0, closest_column = 0;
  T *normal = nullptr;
  std::ptrdiff_t normal_row = 0, normal_column = 0;
  std::uint32_t *triangle = nullptr, *feature = nullptr;
  std::int8_t *side = nullptr;
  std::uint8_t *status = nullptr;
  T *winding = nullptr;
  std::ptrdiff_t winding_step = 0;
  bool estimate_sides = false;

  operator lsdcd_query() const
  {
    lsdcd_query q = {};
    q.size = sizeof q;
    q.n = n;
    q.type = c::type_of<T>();
    q.threads = threads;
    q.points = points;
    q.points_row = points_row;
    q.points_column = points_column;
    q.radii = radii;
    q.radii_step = radii_step;
    q.radius = radius;
    q.distance = distance;
    q.distance_step = distance_step;
    q.closest = closest;
    q.closest_row = closest_row;
    q.closest_column = closest_column;
    q.normal = normal;
    q.normal_row = normal_row;
    q.normal_column = normal_column;
    q.triangle = triangle;
    q.feature = feature;
    q.side = side;
    q.status = status;
    q.winding = winding;
    q.winding_step = winding_step;
    q.estimate_sides = estimate_sides;
    return q;
  }
};

// Of sphere i: first[i] up to before first[i + 1]; see lsdcd_contacts.
template <class T>
struct Contacts {
  std::vector<std::size_t> first;
  std::vector<T> point, normal;    // 3 numbers each
  std::vector<T> distance, overlap, weight;
  std::vector<std::uint32_t> triangle, feature;

  void resize(std::size_t n)
  {
    point.resize(3 * n);
    normal.resize(3 * n);
    for (std::vector<T> *numbers : {&distance, &overlap, &weight}) numbers->resize(n);
    triangle.resize(n);
    feature.resize(n);
  }
};

class Grid {
 public:
  Grid(const Mesh &mesh, const lsdcd_grid_options &options, const Progress &progress = {})
  {
    lsdcd_grid *made = nullptr;
    c::check_with(progress, options, [&](const lsdcd_grid_options &o) {
      return lsdcd_grid_build(mesh.get(), &o, &made);
    });
    handle_.reset(made);
  }
  explicit Grid(const Mesh &mesh, double cutoff = 0) : Grid(mesh, GridOptions(cutoff)) {}

  GridFacts facts() const
  {
    GridFacts f = {};
    f.size = sizeof f;
    c::check(lsdcd_grid_get_facts(get(), &f));
    return f;
  }
  std::string report() const { return lsdcd_grid_report(get()); }

  void query(const lsdcd_query &q, const Progress &progress = {}) const
  {
    c::check_with(progress, q,
                  [&](const lsdcd_query &asked) { return lsdcd_query_host(get(), &asked); });
  }

  // Of points x y z x y z; infinite beyond the radius, 0: the cutoff, or none.
  template <class T>
  std::vector<T> distances(const std::vector<T> &points, double radius = 0) const
  {
    if (points.size() % 3 != 0)
      throw Error(LSDCD_ERROR_ARGUMENT, "lsdcd::Grid: there are " + std::to_string(points.size()) +
                                            " points' numbers, which is not three a point");
    std::vector<T> out(points.size() / 3);
    Query<T> q(points.data(), out.size());
    q.radius = radius;
    q.distance = out.data();
    query(q);
    return out;
  }

  // All contacts of spheres with centres x y z x y z; radii: of each, or one of all.
  template <class T>
  Contacts<T> contacts(const std::vector<T> &centres, const std::vector<T> &radii, int threads = 0,
                       const Progress &progress = {}) const
  {
    const std::size_t n = centres.size() / 3;
    if (centres.size() % 3 != 0 || (radii.size() != n && radii.size() != 1))
      throw Error(LSDCD_ERROR_ARGUMENT, "lsdcd::Grid: there are " + std::to_string(centres.size()) +
                                            " numbers of centres and " +
                                            std::to_string(radii.size()) +
                                            " radii, which is not three and one a sphere");
    Contacts<T> out;
    out.first.resize(n + 1);
    lsdcd_contacts c = {};
    c.size = sizeof c;
    c.n = n;
    c.type = c::type_of<T>();
    c.threads = threads;
    c.points = centres.data();
    c.first = out.first.data();
    const std::vector<T> same(radii.size() == n ? 0 : n, radii.empty() ? T(0) : radii[0]);
    c.radii = radii.size() == n ? radii.data() : same.data();
    c.contacts = n;    // mostly enough
    do {
      c.room = c.contacts;
      out.resize(c.room);
      c.point = out.point.data();
      c.normal = out.normal.data();
      c.distance = out.distance.data();
      c.overlap = out.overlap.data();
      c.weight = out.weight.data();
      c.triangle = out.triangle.data();
      c.feature = out.feature.data();
      c::check_with(progress, c, [&](lsdcd_contacts &asked) {
        const int code = lsdcd_contacts_host(get(), &asked);
        c.contacts = asked.contacts;
        return code;
      });
    } while (c.contacts > c.room);
    out.resize(c.contacts);
    return out;
  }
  const lsdcd_grid *get() const { return handle_.get(); }

 private:
  std::unique_ptr<lsdcd_grid, c::Free<lsdcd_grid_free>> handle_;
};

// A grid on the CUDA device that is current, for arrays there.
class Stream {
 public:
  explicit Stream(const Grid &grid, void *cuda_stream = nullptr)
  {
    lsdcd_stream *made = nullptr;
    c::check(lsdcd_stream_open(grid.get(), cuda_stream, &made));
    handle_.reset(made);
  }
  void query(const lsdcd_query &q) { c::check(lsdcd_query_stream(handle_.get(), &q)); }

 private:
  std::unique_ptr<lsdcd_stream, c::Free<lsdcd_stream_free>> handle_;
};

// All that is 0 has its default.
struct BodyOptions : lsdcd_body_options {
  BodyOptions() : lsdcd_body_options() { size = sizeof(lsdcd_body_options); }
};
using BodyFacts = lsdcd_body_facts;

// Pair i: triangles wall[i] and body[i], by their numbers in the meshes, and the segment that they
// share, x y z x y z, not numbers where they lie in one plane.
struct BodyPairs {
  std::vector<std::uint32_t> wall, body;
  std::vector<double> segments;    // where asked for
  std::size_t uncertain = 0;       // pieces where `nearest` may have missed pairs
  explicit operator bool() const { return !wall.empty(); }
};

// A pose as a matrix, 12 numbers: rows of R, each with its t behind it. body.collide(Matrix{numbers})
struct Matrix {
  const double *numbers;
};

// A rigid body against a wall, for a sequence of poses.
class Body {
 public:
  Body(const Mesh &wall, const Mesh &mesh, const lsdcd_body_options &options = BodyOptions(),
       const Progress &progress = {})
  {
    make(wall.get(), mesh, options, progress);
  }
  // Against the wall of another body, which both then share.
  Body(const Body &same_wall, const Mesh &mesh)
  {
    BodyOptions options;
    options.same_wall = same_wall.get();
    make(nullptr, mesh, options, {});
  }

  BodyFacts facts() const
  {
    BodyFacts f = {};
    f.size = sizeof f;
    c::check(lsdcd_body_get_facts(get(), &f));
    return f;
  }

  // `position`: 3 numbers; `quaternion`: 4, w x y z.
  bool collides(const double *position, const double *quaternion = nullptr, int threads = 0)
  {
    return any_of(posed(position, quaternion, threads));
  }
  bool collides(Matrix matrix, int threads = 0) { return any_of(posed(matrix, threads)); }
  BodyPairs collide(const double *position, const double *quaternion = nullptr,
                    bool segments = false, int threads = 0)
  {
    return pairs_of(posed(position, quaternion, threads), segments);
  }
  BodyPairs collide(Matrix matrix, bool segments = false, int threads = 0)
  {
    return pairs_of(posed(matrix, threads), segments);
  }
  const lsdcd_body *get() const { return handle_.get(); }
  lsdcd_body *get() { return handle_.get(); }

 private:
  void make(const lsdcd_mesh *wall, const Mesh &mesh, const lsdcd_body_options &options,
            const Progress &progress)
  {
    lsdcd_body *made = nullptr;
    c::check_with(progress, options, [&](const lsdcd_body_options &o) {
      return lsdcd_body_make(wall, mesh.get(), &o, &made);
    });
    handle_.reset(made);
  }
  bool any_of(lsdcd_collision c)
  {
    c::check(lsdcd_collide(handle_.get(), &c));
    return c.collides != 0;
  }
  BodyPairs pairs_of(lsdcd_collision c, bool segments)
  {
    BodyPairs out;
    // Once where the room of the last pose is enough.
    do {
      c.room = room_ = c.pairs > room_ ? c.pairs : room_;
      out.wall.resize(c.room);
      out.body.resize(c.room);
      out.segments.resize(segments ? 6 * c.room : 0);
      c.wall_triangle = out.wall.data();
      c.body_triangle = out.body.data();
      c.segment = segments ? out.segments.data() : nullptr;
      c::check(lsdcd_collide(handle_.get(), &c));
    } while (c.pairs > c.room);
    out.wall.resize(c.pairs);
    out.body.resize(c.pairs);
    out.segments.resize(segments ? 6 * c.pairs : 0);
    out.uncertain = c.uncertain;
    return out;
  }
  static lsdcd_collision posed(const double *position, const double *quaternion, int threads)
  {
    lsdcd_collision c = {};
    c.size = sizeof c;
    c.position = position;
    c.quaternion = quaternion;
    c.threads = threads;
    return c;
  }
  static lsdcd_collision posed(Matrix matrix, int threads)
  {
    lsdcd_collision c = posed(nullptr, nullptr, threads);
    c.matrix = matrix.numbers;
    return c;
  }
  std::unique_ptr<lsdcd_body, c::Free<lsdcd_body_free>> handle_;
  std::size_t room_ = 1024;    // pairs
};

// All that is 0 has its default.
struct WallOptions : lsdcd_wall_options {
  WallOptions() : lsdcd_wall_options() { size = sizeof(lsdcd_wall_options); }
};

// Words of fix wall/lsdcd; spheres in arrays of the caller, of the host or a GPU (lsdcd_wall_options), step by step.
class Wall {
 public:
  explicit Wall(const std::vector<std::string> &words, const lsdcd_wall_options *options = nullptr)
  {
    lsdcd_wall *made = nullptr;
    const std::vector<const char *> all = pointers(words);
    c::check(lsdcd_wall_make(all.data(), all.size(), options, &made));
    handle_.reset(made);
  }

  void step(const lsdcd_spheres &spheres, const lsdcd_wall_step &step)
  {
    c::check(lsdcd_wall_step_spheres(get(), &spheres, &step));
  }
  void renumber(const std::vector<std::ptrdiff_t> &from)
  {
    c::check(lsdcd_wall_renumber(get(), from.data(), from.size()));
  }
  // What the contacts of these spheres keep, for unpack() by another process.
  std::vector<double> pack(const std::vector<std::ptrdiff_t> &which)
  {
    return numbers([&](double *to, std::size_t room, std::size_t *count) {
      return lsdcd_wall_pack(get(), which.data(), which.size(), to, room, count);
    });
  }
  void unpack(const std::vector<std::ptrdiff_t> &to, const std::vector<double> &numbers)
  {
    c::check(lsdcd_wall_unpack(get(), to.data(), to.size(), numbers.data(), numbers.size()));
  }
  lsdcd_wall_totals totals(int mesh = -1)
  {
    lsdcd_wall_totals t = {};
    t.size = sizeof t;
    c::check(lsdcd_wall_get_totals(get(), mesh, &t));
    return t;
  }
  void change(const std::vector<std::string> &words)
  {
    const std::vector<const char *> all = pointers(words);
    c::check(lsdcd_wall_change(get(), all.data(), all.size()));
  }
  std::vector<double> save()
  {
    return numbers([&](double *to, std::size_t room, std::size_t *count) {
      return lsdcd_wall_save(get(), to, room, count);
    });
  }
  void restore(const std::vector<double> &numbers)
  {
    c::check(lsdcd_wall_restore(get(), numbers.data(), numbers.size()));
  }
  lsdcd_wall *get() { return handle_.get(); }

 private:
  // What a function writes where there is room: once for how many, once for the numbers.
  template <class Write>
  static std::vector<double> numbers(const Write &write)
  {
    std::size_t count = 0;
    c::check(write(nullptr, 0, &count));
    std::vector<double> all(count);
    c::check(write(all.data(), count, &count));
    return all;
  }
  static std::vector<const char *> pointers(const std::vector<std::string> &words)
  {
    std::vector<const char *> all;
    for (const std::string &word : words) all.push_back(word.c_str());
    return all;
  }
  std::unique_ptr<lsdcd_wall, c::Free<lsdcd_wall_free>> handle_;
};

}    // namespace cpp_api
}    // namespace lsdcd

#endif
