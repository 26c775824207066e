// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/surface/mesh_grid.h"

#include "backend/cuda_available.h"
#include "base/give_back_memory.h"
#include "base/input_words.h"
#include "box/loose_ends.h"
#include "grid/cache/load_or_build.h"
#include "mesh/fingerprint.h"
#include "mesh/io/read_mesh.h"
#include "mesh/measure_mesh.h"
#include "mesh/soup_of.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace lsdcd {

MeshGrid::MeshGrid(Host &host, const WallSpec &wall, const MeshSpec &spec) :
    host_(host), wall_(wall), spec_(spec)
{
  read();
}

// The first process alone reads the file, which may not be there on other nodes.
void MeshGrid::read()
{
  const bool first = host_.is_first(), fills = host_.ranks().fills_memory || is_on_all();
  TriangleSoup soup;
  soup.source = spec_.name;
  run_collectively(host_, first, [&] {
    soup = spec_.mesh ? soup_of(*spec_.mesh) : read_mesh(spec_.file).soup;
    spec_.placement.apply(soup);
  });

  // No message goes to a node without room.
  std::uint64_t corners = soup.corners.size();
  host_.broadcast(&corners, sizeof corners, 0);
  run_collectively(host_, fills, [&] { soup.corners.resize(corners); });
  host_.broadcast(soup.corners.data(), corners * sizeof(Vec3), 0,
                  is_on_all() ? Receivers::all : Receivers::that_fill_memory);
  host_.broadcast(&soup.rounding, sizeof soup.rounding, 0);
  run_collectively(host_, fills, [&] {
    mesh_ = std::make_unique<WeldedMesh>(weld(soup, spec_.weld));
    check_has_area(*mesh_);
    report_ = mesh_->report;
    if (first) mesh_fingerprint_ = fingerprint(*mesh_);
    soup = TriangleSoup();
    give_back_memory();
  });
  static_assert(std::is_trivially_copyable<MeshReport>::value, "sent as bytes");
  host_.broadcast(&report_, sizeof report_, 0);
  host_.broadcast(&mesh_fingerprint_, sizeof mesh_fingerprint_, 0);
  if (first) mesh_text_ = describe(report_, spec_.name);
}

void MeshGrid::move_vertices(const std::vector<Vec3> &at)
{
  run_collectively(host_, mesh_ != nullptr, [&] {
    mesh_->vertices = at;
    measure_again(*mesh_);
    report_ = mesh_->report;
  });
  host_.broadcast(&report_, sizeof report_, 0);
}

// Where centres of spheres can be, with room for a box that grows, so that not every step of a
// face makes a grid. The walls far outside of a box that follows its spheres wait to be met: only
// a mesh much larger than the box is cut off there.
Box MeshGrid::within(Real cutoff, const PeriodicBox &box) const
{
  constexpr Real kRoom = 0.05, kMuchLarger = 4;
  Vec3 past;
  for (int k = 0; k < 3; k++)
    past[k] =
        box.margin + (box.follows(k) ? std::max(box.width(k), 20 * cutoff) : kRoom * box.width(k));
  Box room = box.bounds(past);
  for (int k = 0; k < 3; k++) {
    const Real size = room.hi[k] - room.lo[k];
    const bool is_cut = !box.follows(k) || report_.hi[k] - report_.lo[k] > kMuchLarger * size;
    if (is_cut && !box.unlimited[k]) continue;
    room.lo[k] = kNoLimit.lo[k];
    room.hi[k] = kNoLimit.hi[k];
  }
  return room;
}

WeldedMesh MeshGrid::whole(Real cutoff, const PeriodicBox &box) const
{
  return with_images(*mesh_, box, cutoff + box.margin + kBoxTolerance * cutoff);
}

bool MeshGrid::fits(const PeriodicBox &box) const
{
  if (spec_.has_nodes) return true;
  const Real tolerance = kBoxTolerance * cutoff_;
  const Vec3 margin = {box.margin, box.margin, box.margin};
  const Box need = box.bounds(margin);
  for (int k = 0; k < 3; k++) {
    const bool beyond_lo =
        need.lo[k]<within_.lo[k] - tolerance, beyond_hi = need.hi[k]> within_.hi[k] + tolerance;
    if ((beyond_lo && report_.lo[k] - cutoff_ < within_.lo[k]) ||
        (beyond_hi && report_.hi[k] + cutoff_ > within_.hi[k]))
      return false;
  }
  for (int k = 0; k < 3; k++) {
    if (box.periodic[k] != box_.periodic[k]) return false;
    if (!box.periodic[k]) continue;
    const Real depth = cutoff_ + std::max(box.margin, box_.margin);
    // The extent of the mesh along this axis, in units of the box.
    Real lo = HUGE_VAL, hi = -HUGE_VAL;
    for (int i = 0; i < 8; i++) {
      const Vec3 corner = {i & 1 ? report_.hi.x : report_.lo.x, i & 2 ? report_.hi.y : report_.lo.y,
                           i & 4 ? report_.hi.z : report_.lo.z};
      for (const PeriodicBox *b : {&box, &box_}) {
        lo = std::min(lo, b->fraction(corner)[k]);
        hi = std::max(hi, b->fraction(corner)[k]);
      }
    }
    const Real past = depth / std::min(box.width(k), box_.width(k));
    if (lo > past && hi < 1 - past) continue;    // no image in either box
    const Vec3 stretched = box.edge[k] - box_.edge[k];
    const Real face = box_.fraction(box.corner)[k] * box_.width(k);
    if (norm(stretched) > tolerance || std::fabs(face) > tolerance ||
        box.margin > box_.margin + tolerance)
      return false;
  }
  return true;
}

bool MeshGrid::uses_gpu() const
{
  return wall_.device != Device::cpu && cuda_available(nullptr);
}

StepGridSettings MeshGrid::grid_settings(Real cutoff, const PeriodicBox &box) const
{
  StepGridSettings want;
  want.length = wall_.grid_length;
  want.cutoff = cutoff;
  want.memory_budget = wall_.memory_budget;
  want.sides = wall_.side != Side::both;
  want.nearest = wall_.nearest;
  // Asked for a length that is chosen only, so that devices share the cache of one that is given.
  want.for_gpu = !(want.length > 0) && uses_gpu();
  want.within = within(cutoff, box);
  want.progress = progress;
  return want;
}

void MeshGrid::build(Real cutoff, const PeriodicBox &box)
{
  if (spec_.has_nodes) {    // MeshNodes has its grid
    cutoff_ = cutoff;
    return;
  }
  const StepGridSettings want = grid_settings(cutoff, box);
  const PeriodicBox before = cutoff_ > 0 ? box_ : box;
  // A box that changes in many steps would leave a file in each.
  const bool for_box = cutoff == cutoff_;
  cutoffs_ += !for_box;
  std::string cache_file = for_box ? "" : spec_.cache_file;
  if (!cache_file.empty() && cutoffs_ > 1) cache_file += "." + std::to_string(cutoffs_);
  ends_warning_.clear();
  has_parted_ = false;
  cutoff_ = cutoff;
  box_ = box;
  within_ = want.within;

  WeldedMesh with_images;    // the mesh itself is not copied for a box without them
  run_collectively(host_, host_.ranks().fills_memory && box.any_periodic(),
                   [&] { with_images = whole(cutoff, box); });
  const WeldedMesh &mesh = mesh_ && !box.any_periodic() ? *mesh_ : with_images;
  const LoadedGrid loaded = load_or_build_grid(cache_file, mesh, want, uses_gpu(), host_, memory_);
  if (wall_.shapes)
    run_collectively(host_, true, [&] {
      tree_ = std::make_unique<MeshTree>(box.any_periodic() ? whole(cutoff, box) : *mesh_);
    });
  cache_text_ = loaded.cache_text;
  cache_warning_ = loaded.cache_warning;
  cells_ = loaded.report.lists.cells;
  grid_text_ = describe(loaded.report);
  if (want.sides && view().outside == 0)
    throw InputError("side in and side out need a mesh that does not meet itself; facets of '" +
                     spec_.name +
                     "' cut, overlap or touch each other, see lsdcd inspect: make one shell of "
                     "them (a boolean union), or use side both");
  run_collectively(host_, host_.is_first(), [&] {
    note_images(mesh);
    note_ends(mesh, before);
  });
  broadcast_text(host_, grid_text_);
  broadcast_text(host_, ends_warning_);
  host_.broadcast(&has_parted_, sizeof has_parted_, 0);
  host_.broadcast(&cells_, sizeof cells_, 0);
}

// Writes how many images there are.
void MeshGrid::note_images(const WeldedMesh &whole)
{
  const PeriodicImages &images = whole.images;
  if (!images.any()) return;
  grid_text_ += "\n  periodic images of " + std::to_string(images.face_of.size()) +
                " triangles act through the faces of the box";
}

// Writes where the mesh does not meet its images, or no longer. A gap that is wide beside the box is an opening, but where the mesh met
// itself in the box before; less so where the spec says that the mesh continues itself.
void MeshGrid::note_ends(const WeldedMesh &whole, const PeriodicBox &before)
{
  if (!box_.any_periodic()) return;
  Real least = HUGE_VAL;
  for (int k = 0; k < 3; k++)
    if (box_.periodic[k]) least = std::min(least, box_.width(k));
  const Real widest = std::max(2 * cutoff_, (wall_.periodic ? 0.25 : 0.05) * least);
  LooseEnds loose = parted_ends(whole, view().wall, before, box_);
  has_parted_ = loose.gap > 0;
  if (!has_parted_ && whole.images.any())
    loose = loose_ends(whole, view().wall, box_, cutoff_, widest);
  if (loose.gap == 0) return;
  ends_warning_ = "the ends of the mesh do not meet across the periodic face in " +
                  std::string(1, "xyz"[loose.axis]) + ", where its open edges face a gap of " +
                  number_text(loose.gap) + "; make the mesh as long as the box, " +
                  number_text(box_.width(loose.axis)) + ", or let its ends overlap";
}

bool MeshGrid::has(FeatureCode feature) const
{
  const std::size_t index = feature_index(feature);
  switch (feature_kind(feature)) {
    case FeatureKind::face:
      return index < report_.facets - report_.degenerate_facets - report_.duplicate_facets;
    case FeatureKind::edge:
      return index < report_.edges;
    case FeatureKind::vertex:
      return index < report_.vertices;
  }
  return false;
}

static std::size_t bytes_of(const WeldedMesh &mesh)
{
  return mesh.vertices.size() * sizeof(Vec3) + mesh.faces.size() * 7 * sizeof(int) +
         mesh.edges.size() * 5 * sizeof(int);
}

std::size_t MeshGrid::bytes() const
{
  const std::size_t mesh = mesh_ ? bytes_of(*mesh_) : 0,
                    tree = tree_ ? bytes_of(tree_->mesh) + tree_->tree.bytes() : 0;
  return mesh + tree + (host_.ranks().fills_memory || !memory_.is_shared ? memory_.bytes : 0);
}

}    // namespace lsdcd
