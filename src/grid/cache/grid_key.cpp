// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "grid/cache/grid_cache.h"

#include "lsdcd_grid_sources.h"    // made by the build: kGridSources

#include <cstring>
#include <type_traits>
#include <xxhash.h>

namespace lsdcd {

namespace {

// Numbers, and vectors of numbers with their lengths, one after another.
class Hasher {
 public:
  Hasher() : state_(XXH3_createState())
  {
    if (!state_) throw std::bad_alloc();
    XXH3_128bits_reset(state_);
  }
  ~Hasher() { XXH3_freeState(state_); }
  Hasher(const Hasher &) = delete;
  Hasher &operator=(const Hasher &) = delete;

  template <class... T>
  Hash of(const T &...values)
  {
    (add(values), ...);
    const XXH128_hash_t h = XXH3_128bits_digest(state_);
    return {h.low64, h.high64};
  }

 private:
  // No padding: every bit of a value counts, and nothing else.
  template <class T>
  void add(const T &value)
  {
    static_assert(std::is_arithmetic<T>::value || std::is_enum<T>::value, "hashed bit for bit");
    bytes(&value, sizeof value);
  }
  void add(const Vec3 &v) { bytes(&v, sizeof v); }
  template <class T>
  void add(const std::vector<T> &values)
  {
    static_assert(sizeof(T) % sizeof(int) == 0 && alignof(T) <= 8, "no padding");
    add(values.size());
    bytes(values.data(), values.size() * sizeof(T));
  }
  void bytes(const void *data, std::size_t n) { XXH3_128bits_update(state_, data, n); }

  XXH3_state_t *state_;
};

Hash version_hash()
{
  const std::uint64_t byte_order = 0x0102030405060708;
  return Hasher().of(byte_order, kGridSources, sizeof(Real), sizeof(std::size_t),
                     sizeof(FaceRecord), sizeof(EdgeRecord), sizeof(VertexRecord), sizeof(Brick),
                     sizeof(Cell), sizeof(CellEntry));
}

// The bindings name every member: one that is added does not compile until it is
// listed here too.
Hash settings_hash(const AnyGridSettings &s)
{
  const auto &[length, cutoff, memory_budget, sides, nearest, for_gpu, may_coarsen, within,
               length_name, progress] = static_cast<const GridSettings &>(s);
  (void) length_name;
  (void) progress;
  return Hasher().of(length, cutoff, memory_budget, sides, nearest, for_gpu, may_coarsen, within.lo,
                     within.hi, s.purpose, s.in_floats);
}

Hash mesh_hash(const WeldedMesh &mesh)
{
  const auto &[vertices, faces, face_edges, face_facet, edges, edge_first, edge_face, vertex_first,
               vertex_edge, dropped, report, source, images] = mesh;
  // From the report: the numbers that planning and building read.
  (void) source;
  (void) dropped;
  return Hasher().of(vertices, faces, face_edges, face_facet, edges, edge_first, edge_face,
                     vertex_first, vertex_edge, report.lo, report.hi, report.median_edge,
                     report.volume, images.n_faces, images.n_edges, images.n_vertices,
                     images.face_of, images.edge_of, images.vertex_of, images.same_vertex);
}

}    // namespace

GridKey grid_key(const WeldedMesh &mesh, const AnyGridSettings &settings)
{
  return {version_hash(), mesh_hash(mesh), settings_hash(settings)};
}

}    // namespace lsdcd
