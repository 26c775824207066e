// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd.h for C++17: objects that free themselves, errors as exceptions. It is only a header over the C
// library. lsdcd.h says what functions do and which threads may call them.
#ifndef LSDCD_HPP
#define LSDCD_HPP

#include "lsdcd.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
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

// `what` a long call does now, and the share of it that is done, from 0 to 1; see lsdcd_progress. True cancels the call,
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
  std::vector<std::uint32_t> welded_vertex, welded_face;    // of each vertex and triangle as given
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
    a.welded_vertex.resize(f.given_vertices);
    a.welded_face.resize(f.triangles);
    const lsdcd_mesh_arrays to = {sizeof to,           a.vertices.data(),   a.faces.data(),
                                  a.face_edges.data(), a.triangle.data(),   a.edges.data(),
                                  a.edge_first.data(), a.edge_faces.data(), a.welded_vertex.data(),
                                  a.welded_face.data()};
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
  T *signed_distance = nullptr;    // < 0 inside
  std::ptrdiff_t signed_distance_step = 0;
  T *barycentric = nullptr;
  std::ptrdiff_t barycentric_row = 0, barycentric_column = 0;

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
    q.signed_distance = signed_distance;
    q.signed_distance_step = signed_distance_step;
    q.barycentric = barycentric;
    q.barycentric_row = barycentric_row;
    q.barycentric_column = barycentric_column;
    return q;
  }
};

// The contacts of sphere i are first[i] up to before first[i + 1]; see lsdcd_contacts.
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

// Grains that are ellipsoids or superellipsoids, packed; see lsdcd_shapes. half_axes and exponents are of each grain, or of one
// that all are like; without exponents they are ellipsoids, without quaternions not turned.
struct Shapes {
  std::vector<double> centres, half_axes, exponents, quaternions;
};

// The contacts of grain i are first[i] up to before first[i + 1]; see lsdcd_shapes.
struct ShapeContacts {
  std::vector<std::size_t> first;
  std::vector<double> point, of_grain, normal;    // 3 numbers each
  std::vector<double> overlap;
  std::vector<std::uint32_t> triangle, feature;

  void resize(std::size_t n)
  {
    for (std::vector<double> *numbers : {&point, &of_grain, &normal}) numbers->resize(3 * n);
    overlap.resize(n);
    triangle.resize(n);
    feature.resize(n);
  }
};

// The signed distance of each grain, and where it is.
struct ShapeDistances {
  std::vector<double> distance;
  std::vector<double> closest, of_grain, normal;    // 3 numbers each
  std::vector<std::uint32_t> triangle, feature;
};

using ShapeFacts = lsdcd_shape_facts;
// exponents: n1 and n2; none: 2, an ellipsoid.
inline ShapeFacts shape_facts(const std::vector<double> &half_axes,
                              const std::vector<double> &exponents = {})
{
  if (half_axes.size() != 3 || (!exponents.empty() && exponents.size() != 2))
    throw Error(LSDCD_ERROR_ARGUMENT,
                "lsdcd::shape_facts: give three half-axes, and two exponents or none");
  ShapeFacts f = {};
  f.size = sizeof f;
  c::check(
      lsdcd_shape_get_facts(half_axes.data(), exponents.empty() ? nullptr : exponents.data(), &f));
  return f;
}

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

  // The distances of points x y z x y z; infinite beyond the radius, 0: the cutoff, or none.
  template <class T>
  std::vector<T> distances(const std::vector<T> &points, double radius = 0) const
  {
    std::vector<T> out(number_of(points));
    Query<T> q(points.data(), out.size());
    q.radius = radius;
    q.distance = out.data();
    query(q);
    return out;
  }
  // The same, < 0 inside. The mesh has sides, or `estimate_sides` is true; see lsdcd_query.
  template <class T>
  std::vector<T> signed_distances(const std::vector<T> &points, double radius = 0,
                                  bool estimate_sides = false) const
  {
    std::vector<T> out(number_of(points));
    Query<T> q(points.data(), out.size());
    q.radius = radius;
    q.signed_distance = out.data();
    q.estimate_sides = estimate_sides;
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
    fill(c, out, progress, lsdcd_contacts_host, [&] {
      c.point = out.point.data();
      c.normal = out.normal.data();
      c.distance = out.distance.data();
      c.overlap = out.overlap.data();
      c.weight = out.weight.data();
      c.triangle = out.triangle.data();
      c.feature = out.feature.data();
    });
    return out;
  }
  // All contacts of grains of shape.
  ShapeContacts shape_contacts(const Shapes &grains, int threads = 0,
                               const Progress &progress = {}) const
  {
    lsdcd_shapes s = asked_of(grains, threads);
    ShapeContacts out;
    out.first.resize(s.n + 1);
    s.first = out.first.data();
    s.contacts = s.n;    // mostly enough
    fill(s, out, progress, lsdcd_shapes_host, [&] {
      s.point = out.point.data();
      s.of_grain = out.of_grain.data();
      s.normal = out.normal.data();
      s.overlap = out.overlap.data();
      s.triangle = out.triangle.data();
      s.feature = out.feature.data();
    });
    return out;
  }
  // The signed distances of grains of shape, at any range.
  ShapeDistances shape_distances(const Shapes &grains, int threads = 0,
                                 const Progress &progress = {}) const
  {
    lsdcd_shapes s = asked_of(grains, threads);
    ShapeDistances out;
    out.distance.resize(s.n);
    for (std::vector<double> *numbers : {&out.closest, &out.of_grain, &out.normal})
      numbers->resize(3 * s.n);
    out.triangle.resize(s.n);
    out.feature.resize(s.n);
    s.distance = out.distance.data();
    s.closest = out.closest.data();
    s.closest_of_grain = out.of_grain.data();
    s.closest_normal = out.normal.data();
    s.closest_triangle = out.triangle.data();
    s.closest_feature = out.feature.data();
    answer(s, progress, lsdcd_shapes_host);
    return out;
  }
  const lsdcd_grid *get() const { return handle_.get(); }

 private:
  static lsdcd_shapes asked_of(const Shapes &grains, int threads)
  {
    const std::size_t n = grains.centres.size() / 3;
    const bool one_shape = grains.half_axes.size() == 3;
    const std::size_t shapes = one_shape ? 1 : n;
    if (grains.centres.size() != 3 * n || grains.half_axes.size() != 3 * shapes ||
        (!grains.exponents.empty() && grains.exponents.size() != 2 * shapes) ||
        (!grains.quaternions.empty() && grains.quaternions.size() != 4 * n))
      throw Error(LSDCD_ERROR_ARGUMENT, "lsdcd::Grid: grains have three numbers of a centre each, "
                                        "four of a quaternion or none, three half-axes "
                                        "and two exponents or none, of each grain or of one");
    lsdcd_shapes s = {};
    s.size = sizeof s;
    s.n = n;
    s.threads = threads;
    s.one_shape = one_shape;
    s.centres = grains.centres.data();
    s.half_axes = grains.half_axes.data();
    if (!grains.exponents.empty()) s.exponents = grains.exponents.data();
    if (!grains.quaternions.empty()) s.quaternions = grains.quaternions.data();
    return s;
  }
  // Asks a query of contacts, which tells how many there are.
  template <class Asked>
  void answer(Asked &a, const Progress &progress, int (*query)(const lsdcd_grid *, Asked *)) const
  {
    c::check_with(progress, a, [&](Asked &asked) {
      const int code = query(get(), &asked);
      a.contacts = asked.contacts;
      return code;
    });
  }
  // Asks with room for a.contacts, and again where there are more. put(): gives the query the arrays of `out`.
  template <class Asked, class Out, class Put>
  void fill(Asked &a, Out &out, const Progress &progress, int (*query)(const lsdcd_grid *, Asked *),
            const Put &put) const
  {
    do {
      a.room = a.contacts;
      out.resize(a.room);
      put();
      answer(a, progress, query);
    } while (a.contacts > a.room);
    out.resize(a.contacts);
  }

  template <class T>
  static std::size_t number_of(const std::vector<T> &points)
  {
    if (points.size() % 3 != 0)
      throw Error(LSDCD_ERROR_ARGUMENT, "lsdcd::Grid: there are " + std::to_string(points.size()) +
                                            " points' numbers, which is not three a point");
    return points.size() / 3;
  }

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

// ---- walls -----------------------------------------------------------------------------------

// Where a mesh is and how it moves, as lsdcd_wall_set_pose() takes it.
struct Pose {
  std::array<double, 3> position = {0, 0, 0};            // length
  std::array<double, 4> quaternion = {1, 0, 0, 0};       // w x y z, of length 1 to 1e-3
  std::array<double, 3> velocity = {0, 0, 0};            // of the point at `position`, length/time
  std::array<double, 3> angular_velocity = {0, 0, 0};    // along the axes of the box, 1/time
};

using BodyState = lsdcd_body_state;

// A contact of the last step; fields as in lsdcd_wall_contacts.
struct WallContact {
  std::ptrdiff_t sphere = 0;
  int mesh = 0;
  std::array<double, 3> force = {}, point = {};
  double overlap = 0;
  std::array<double, 5> dissipated_power = {}, dissipated = {};
  bool has_ended = false;
};

// A bin of the impacts on a mesh; fields as in lsdcd_wall_impacts.
struct ImpactBin {
  double begins = 0, ends = 0, impacts = 0, energy = 0;
};

// All that is 0 has its default.
struct WallOptions : lsdcd_wall_options {
  WallOptions() : lsdcd_wall_options() { size = sizeof(lsdcd_wall_options); }
};

// Rows of a table of motion, one behind the other.
struct Rows {
  std::vector<double> numbers;
  int columns = 0;
};

// A value that the words of a wall name as $NAME: a mesh, which must live as long as the call, or moves in; numbers, of which NaN is NULL; rows;
// a text.
class Value {
 public:
  Value(const Mesh &mesh) : kind_(LSDCD_VALUE_MESH), mesh_(mesh.get()) {}
  Value(Mesh &&mesh) : kind_(LSDCD_VALUE_MESH), kept_(std::make_shared<Mesh>(std::move(mesh)))
  {
    mesh_ = kept_->get();
  }
  Value(double number) : Value(std::vector<double>{number}) {}
  Value(std::initializer_list<double> numbers) : Value(std::vector<double>(numbers)) {}
  Value(std::vector<double> numbers) : kind_(LSDCD_VALUE_NUMBERS), numbers_(std::move(numbers)) {}
  Value(Rows rows) :
      kind_(LSDCD_VALUE_ROWS), numbers_(std::move(rows.numbers)), columns_(rows.columns)
  {
  }
  Value(std::string text) : kind_(LSDCD_VALUE_TEXT), text_(std::move(text)) {}
  Value(const char *text) : Value(std::string(text)) {}

  // With this name, for a call while both live.
  lsdcd_value named(const std::string &name) const
  {
    return {name.c_str(), kind_, mesh_, numbers_.data(), numbers_.size(), columns_, text_.c_str()};
  }

 private:
  int kind_;
  const lsdcd_mesh *mesh_ = nullptr;
  std::shared_ptr<Mesh> kept_;
  std::vector<double> numbers_;
  int columns_ = 0;
  std::string text_;
};
using Values = std::vector<std::pair<std::string, Value>>;

namespace c {
inline std::vector<lsdcd_value> values_of(const Values &values)
{
  std::vector<lsdcd_value> all;
  for (const auto &[name, value] : values) all.push_back(value.named(name));
  return all;
}
}    // namespace c

// Meshes and laws that push the spheres in arrays of the caller, of the host or a GPU (lsdcd_wall_options), step by step.
class Wall {
 public:
  // By the words that stand behind wall/lsdcd in a script, see lsdcd_wall_create().
  explicit Wall(const std::string &words, const Values &values = {},
                const lsdcd_wall_options *options = nullptr)
  {
    lsdcd_wall *made = nullptr;
    const std::vector<lsdcd_value> given = c::values_of(values);
    c::check(lsdcd_wall_create(words.c_str(), given.data(), given.size(), options, &made));
    handle_.reset(made);
  }
  // Throws what Wall() would throw for these words and values, and makes nothing.
  static void check(const std::string &words, const Values &values = {},
                    const lsdcd_wall_options *options = nullptr)
  {
    const std::vector<lsdcd_value> given = c::values_of(values);
    c::check(lsdcd_wall_check(words.c_str(), given.data(), given.size(), options));
  }
  // By the words of fix_modify, see lsdcd_wall_change().
  void change(const std::string &words, const Values &values = {})
  {
    const std::vector<lsdcd_value> given = c::values_of(values);
    c::check(lsdcd_wall_change(get(), words.c_str(), given.data(), given.size()));
  }
  // The value of v_NAME in the words, from the next step on.
  void set_input(const std::string &name, double value)
  {
    c::check(lsdcd_wall_set_input(get(), name.c_str(), value));
  }
  // The number of a mesh, from 0.
  int mesh(const std::string &name)
  {
    int number = 0;
    c::check(lsdcd_wall_get_mesh(get(), name.c_str(), &number));
    return number;
  }
  void step(const lsdcd_spheres &spheres, const lsdcd_wall_step &step)
  {
    c::check(lsdcd_wall_step_spheres(get(), &spheres, &step));
  }
  void renumber(const std::vector<std::ptrdiff_t> &from)
  {
    c::check(lsdcd_wall_renumber(get(), from.data(), from.size()));
  }
  // The history of the contacts of these spheres, for unpack() by another process.
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
  // Of a mesh in the last step; -1: of all. The torque is about `torque_about` of each mesh.
  lsdcd_wall_totals totals(int mesh = -1) { return totals_about(mesh, nullptr); }
  // The torque is about a point of the box.
  lsdcd_wall_totals totals(int mesh, const std::array<double, 3> &about)
  {
    return totals_about(mesh, about.data());
  }
  // A number of a mesh after the last step by its name, which is the same in LAMMPS: "force_z"; -1: of all. Throws LSDCD_ERROR_ARGUMENT for a name
  // that there is not.
  double output(const std::string &name, int mesh = -1)
  {
    double number = 0;
    c::check(lsdcd_wall_get_outputs(get(), mesh, name.c_str(), &number, 1));
    return number;
  }
  // Where mesh number `mesh` is, from 0, after the last step: what was at x when the wall was made is at R x + t. Three
  // rows of four numbers, each row of R with its t, a length, behind it, as Matrix has them. Throws
  // LSDCD_ERROR_ARGUMENT for a mesh that there is not.
  std::array<double, 12> pose(int mesh = 0)
  {
    std::array<double, 12> matrix = {};
    c::check(lsdcd_wall_get_pose(get(), mesh, matrix.data()));
    return matrix;
  }
  // Where mesh number `mesh`, which has `motion caller`, is in the next step and those after it. In a step, but not with
  // `setup` or `synchronous`, points move with velocity + angular_velocity x (R x) of half a step before the pose, see lsdcd_wall_set_pose().
  void set_pose(int mesh, const Pose &pose)
  {
    c::check(lsdcd_wall_set_pose(get(), mesh, pose.position.data(), pose.quaternion.data(),
                                 pose.velocity.data(), pose.angular_velocity.data()));
  }
  // Where the vertices of mesh number `mesh`, which has `nodes caller`, are in the next step and those after it: 3
  // numbers a vertex, in the order of your vertices, see lsdcd_wall_set_nodes(). `velocities` may be empty: all are 0 then. Throws
  // LSDCD_ERROR_ARGUMENT for another number of them.
  void set_nodes(int mesh, const std::vector<double> &positions,
                 const std::vector<double> &velocities = {})
  {
    check_nodes(mesh, positions.size());
    if (!velocities.empty()) check_nodes(mesh, velocities.size());
    c::check(lsdcd_wall_set_nodes(get(), mesh, positions.data(),
                                  velocities.empty() ? nullptr : velocities.data()));
  }
  // Where they are after the last step, also of a mesh that wear moves (`wear ... deform`), and the forces on nodes then.
  std::vector<double> nodes(int mesh)
  {
    std::vector<double> positions(node_numbers(mesh));
    c::check(lsdcd_wall_get_nodes(get(), mesh, positions.data()));
    return positions;
  }
  std::vector<double> node_forces(int mesh)
  {
    std::vector<double> forces(node_numbers(mesh));
    c::check(lsdcd_wall_get_node_forces(get(), mesh, forces.data()));
    return forces;
  }
  // The same three with arrays of the caller, 3 numbers a vertex, in memory of the host or of the wall's GPU; null
  // velocities are 0.
  void set_nodes(int mesh, const double *positions, const double *velocities)
  {
    c::check(lsdcd_wall_set_nodes(get(), mesh, positions, velocities));
  }
  void nodes(int mesh, double *positions)
  {
    c::check(lsdcd_wall_get_nodes(get(), mesh, positions));
  }
  void node_forces(int mesh, double *forces)
  {
    c::check(lsdcd_wall_get_node_forces(get(), mesh, forces));
  }
  // Contacts of this process in the last step, of a wall with `each_contact`.
  std::vector<WallContact> contacts()
  {
    lsdcd_wall_contacts ask = {};
    ask.size = sizeof ask;
    c::check(lsdcd_wall_get_contacts(get(), &ask));
    const std::size_t n = ask.room = ask.contacts;
    std::vector<std::ptrdiff_t> spheres(n);
    std::vector<int> meshes(n), ended(n);
    std::vector<double> forces(3 * n), points(3 * n), overlaps(n), powers(5 * n), energies(5 * n);
    ask.sphere = spheres.data();
    ask.mesh = meshes.data();
    ask.force = forces.data();
    ask.point = points.data();
    ask.overlap = overlaps.data();
    ask.dissipated_power = powers.data();
    ask.dissipated = energies.data();
    ask.has_ended = ended.data();
    c::check(lsdcd_wall_get_contacts(get(), &ask));
    std::vector<WallContact> all(n);
    for (std::size_t i = 0; i < n; i++) {
      all[i].sphere = spheres[i];
      all[i].mesh = meshes[i];
      all[i].overlap = overlaps[i];
      for (std::size_t k = 0; k < 3; k++) {
        all[i].force[k] = forces[3 * i + k];
        all[i].point[k] = points[3 * i + k];
      }
      for (std::size_t k = 0; k < 5; k++) {
        all[i].dissipated_power[k] = powers[5 * i + k];
        all[i].dissipated[k] = energies[5 * i + k];
      }
      all[i].has_ended = ended[i] != 0;
    }
    return all;
  }
  // The spectrum of the impacts on a mesh since the first step, of a wall with `impacts`.
  std::vector<ImpactBin> impacts(int mesh)
  {
    lsdcd_wall_impacts ask = {};
    ask.size = sizeof ask;
    c::check(lsdcd_wall_get_impacts(get(), mesh, &ask));
    const std::size_t n = ask.room = ask.bins;
    std::vector<double> begins(n), ends(n), impacts(n), energies(n);
    ask.begins = begins.data();
    ask.ends = ends.data();
    ask.impacts = impacts.data();
    ask.energy = energies.data();
    c::check(lsdcd_wall_get_impacts(get(), mesh, &ask));
    std::vector<ImpactBin> all(n);
    for (std::size_t k = 0; k < n; k++) all[k] = {begins[k], ends[k], impacts[k], energies[k]};
    return all;
  }
  // The rigid body that mesh number `mesh` is, after the last step, with velocities of the whole step; fields as in
  // lsdcd_body_state. Throws LSDCD_ERROR_ARGUMENT for a mesh that is none.
  BodyState body(int mesh)
  {
    BodyState state = {};
    state.size = sizeof state;
    c::check(lsdcd_wall_get_body(get(), mesh, &state));
    return state;
  }
  std::vector<double> save()
  {
    return numbers([&](double *to, std::size_t room, std::size_t *count) {
      return lsdcd_wall_save(get(), to, room, count);
    });
  }
  // What a wall of the same words saved, with the motion, servo or body that was set later; with `what_fits` also of another one, as far
  // as it goes.
  void restore(const std::vector<double> &numbers, bool what_fits = false)
  {
    const auto call = what_fits ? lsdcd_wall_restore_what_fits : lsdcd_wall_restore;
    c::check(call(get(), numbers.data(), numbers.size()));
  }
  lsdcd_wall *get() { return handle_.get(); }

 private:
  lsdcd_wall_totals totals_about(int mesh, const double *about)
  {
    lsdcd_wall_totals t = {};
    t.size = sizeof t;
    c::check(lsdcd_wall_get_totals(get(), mesh, about, &t));
    return t;
  }
  // Three for each node.
  std::size_t node_numbers(int mesh)
  {
    std::size_t count = 0;
    c::check(lsdcd_wall_get_node_count(get(), mesh, &count));
    return 3 * count;
  }
  void check_nodes(int mesh, std::size_t n)
  {
    const std::size_t wanted = node_numbers(mesh);
    if (n != wanted)
      throw Error(LSDCD_ERROR_ARGUMENT, "lsdcd::Wall::set_nodes: there are " + std::to_string(n) +
                                            " numbers, and the mesh has " +
                                            std::to_string(wanted / 3) +
                                            " vertices: give three for each");
  }
  // The numbers that a function writes where there is room: it is called once for their count, once for them.
  template <class Write>
  static std::vector<double> numbers(const Write &write)
  {
    std::size_t count = 0;
    c::check(write(nullptr, 0, &count));
    std::vector<double> all(count);
    c::check(write(all.data(), count, &count));
    return all;
  }
  std::unique_ptr<lsdcd_wall, c::Free<lsdcd_wall_free>> handle_;
};

}    // namespace cpp_api
}    // namespace lsdcd

#endif
