#include "lammps/mpi_wall.h"

#include "base/give_back_memory.h"
#include "base/input_words.h"
#include "grid/loose_ends.h"
#include "mesh/fingerprint.h"
#include "mesh/io/read_mesh.h"
#include "mesh/measure_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <type_traits>

namespace lsdcd {

namespace {

std::string seconds_since(double start)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3f s", MPI_Wtime() - start);
  return text;
}

}    // namespace

SharedWall::SharedWall(MPI_Comm world, const WallSettings &settings, const MeshSettings &of_mesh) :
    settings_(settings), of_mesh_(of_mesh), shared_(world)
{
  read();
}

// The file is read by rank 0 alone: it may not be there on other nodes.
void SharedWall::read()
{
  int rank;
  MPI_Comm_rank(shared_.world(), &rank);
  TriangleSoup soup;
  soup.source = of_mesh_.file;
  run_collectively(shared_.world(), rank == 0, [&] {
    soup = read_mesh(of_mesh_.file).soup;
    of_mesh_.placement.apply(soup);
  });

  // One writer per node; rank 0 is the first of them. No message goes to a node without room.
  std::uint64_t corners = soup.corners.size();
  MPI_Bcast(&corners, 1, MPI_UINT64_T, 0, shared_.world());
  run_collectively(shared_.world(), shared_.writes(), [&] { soup.corners.resize(corners); });
  if (shared_.writes())
    broadcast_bytes(soup.corners.data(), corners * sizeof(Vec3), 0, shared_.writers());
  run_collectively(shared_.world(), shared_.writes(), [&] {
    mesh_ = std::make_unique<WallMesh>(weld(soup, of_mesh_.weld));
    check_has_area(*mesh_);
    report_ = mesh_->report;
    if (rank == 0) mesh_fingerprint_ = fingerprint(*mesh_);
    soup = TriangleSoup();
    give_back_memory();
  });
  static_assert(std::is_trivially_copyable<MeshReport>::value, "sent as bytes");
  MPI_Bcast(&report_, sizeof report_, MPI_BYTE, 0, shared_.world());
  MPI_Bcast(&mesh_fingerprint_, 1, MPI_UINT64_T, 0, shared_.world());
  if (rank == 0) mesh_text_ = describe(report_, of_mesh_.file);
}

// Where centres of spheres can be, with room for a box that grows, so that not every step of a
// face makes a grid. The walls far outside of a box that follows its spheres wait to be met: only
// a mesh much larger than the box is cut off there.
Box SharedWall::within(Real cutoff, const PeriodicBox &box) const
{
  constexpr Real kRoom = 0.05, kMuchLarger = 4;
  Vec3 past;
  for (int k = 0; k < 3; k++)
    past[k] =
        box.margin + (box.follows[k] ? std::max(box.width(k), 20 * cutoff) : kRoom * box.width(k));
  Box room = box.bounds(past);
  for (int k = 0; k < 3; k++) {
    const Real size = room.hi[k] - room.lo[k];
    if (!box.follows[k] || report_.hi[k] - report_.lo[k] > kMuchLarger * size) continue;
    room.lo[k] = kNoLimit.lo[k];
    room.hi[k] = kNoLimit.hi[k];
  }
  return room;
}

WallMesh SharedWall::whole(Real cutoff, const PeriodicBox &box) const
{
  return with_images(*mesh_, box, cutoff + box.margin + kBoxTolerance * cutoff);
}

bool SharedWall::fits(const PeriodicBox &box) const
{
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
    // Of the mesh along this axis, in units of the box.
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

bool SharedWall::uses_gpu() const
{
  return settings_.device != Device::cpu && cuda_available(nullptr);
}

GridSettings SharedWall::grid_settings(Real cutoff, const PeriodicBox &box) const
{
  GridSettings want;
  want.length = settings_.grid_length;
  want.cutoff = cutoff;
  want.memory_budget = settings_.memory_budget;
  want.limited = !(want.length > 0);    // a length that is given may take its time
  want.sides = settings_.side != Side::both;
  want.nearest = settings_.nearest;
  want.in_floats = settings_.precision != Precision::double_;
  // Asked for a length that is chosen only, so that devices share the cache of one that is given.
  want.for_gpu = !(want.length > 0) && uses_gpu();
  want.within = within(cutoff, box);
  want.progress = progress;
  return want;
}

void SharedWall::build(Real cutoff, const PeriodicBox &box)
{
  int rank;
  MPI_Comm_rank(shared_.world(), &rank);
  const GridSettings want = grid_settings(cutoff, box);
  // A box that changes in many steps would leave a file in each.
  const bool for_box = cutoff == cutoff_;
  cutoffs_ += !for_box;
  cache_file_ = for_box ? "" : of_mesh_.cache_file;
  if (!cache_file_.empty() && cutoffs_ > 1) cache_file_ += "." + std::to_string(cutoffs_);
  cache_text_.clear();
  cache_warning_.clear();
  ends_warning_.clear();
  cutoff_ = cutoff;
  box_ = box;
  within_ = want.within;

  WallMesh with_images;    // the mesh itself is not copied for a box without them
  run_collectively(shared_.world(), shared_.writes() && box.any_periodic(),
                   [&] { with_images = whole(cutoff, box); });
  const WallMesh &mesh = mesh_ && !box.any_periodic() ? *mesh_ : with_images;
  GridKey key = {};
  std::unique_ptr<CachedGrid> cached;
  const bool caches = rank == 0 && !cache_file_.empty();
  run_collectively(shared_.world(), caches, [&] {
    key = grid_key(mesh, want);
    cached = std::make_unique<CachedGrid>(cache_file_, key);
  });
  if (cache_file_.empty() || !read_cache(cached.get())) {
    GridReport report;
    build_block(mesh, want, report);
    if (caches) write_cache(key, report, *cached);
  }
  if (want.sides && view().outside == 0)
    throw InputError("side in and side out need a mesh that does not meet itself; facets of '" +
                     of_mesh_.file +
                     "' cut, overlap or touch each other, see lsdcd inspect: make one shell of "
                     "them (a boolean union), or use side both");
  run_collectively(shared_.world(), rank == 0, [&] { note_images(mesh); });
  broadcast_text(grid_text_, 0, shared_.world());
  broadcast_text(ends_warning_, 0, shared_.world());
  MPI_Bcast(&cells_, 1, MPI_UINT64_T, 0, shared_.world());
}

// What images are there, and where they do not fit the mesh.
void SharedWall::note_images(const WallMesh &whole)
{
  const PeriodicImages &images = whole.images;
  if (!images.any()) return;
  grid_text_ += "\n  periodic images of " + std::to_string(images.face_of.size()) +
                " triangles act through the faces of the box";
  // A gap that is wide beside the box is an opening; not so where the deck says that the mesh
  // continues itself.
  Real least = HUGE_VAL;
  for (int k = 0; k < 3; k++)
    if (box_.periodic[k]) least = std::min(least, box_.width(k));
  const Real widest = std::max(2 * cutoff_, (settings_.periodic ? 0.25 : 0.05) * least);
  const LooseEnds loose = loose_ends(whole, view().wall, box_, widest);
  if (loose.edges == 0) return;
  ends_warning_ = "the ends of the mesh do not meet across the periodic boundary in " +
                  std::string(1, "xyz"[loose.axis]) + ": " + std::to_string(loose.edges) +
                  " open edges face a gap of up to " + number_text(loose.widest) +
                  "; make the mesh as long as the box, " + number_text(box_.width(loose.axis)) +
                  ", or let its ends overlap";
}

// Rank 0 alone looks at the file and decides for all; what it reads goes to the
// writers of other nodes, who may not see that file.
bool SharedWall::read_cache(CachedGrid *cached)
{
  const double start = MPI_Wtime();
  std::uint64_t bytes = cached && cached->state() == CacheState::usable ? cached->block_bytes() : 0;
  MPI_Bcast(&bytes, 1, MPI_UINT64_T, 0, shared_.world());
  if (bytes == 0) return false;
  char *block = shared_.allocate(bytes);
  int good = 0;
  run_collectively(shared_.world(), cached, [&] { good = cached->read(block); });
  MPI_Bcast(&good, 1, MPI_INT, 0, shared_.world());
  if (!good) return false;
  if (shared_.writes()) broadcast_bytes(block, bytes, 0, shared_.writers());
  shared_.publish();
  if (cached) {
    grid_text_ = describe(cached->report());
    cells_ = cached->report().lists.cells;
    cache_text_ = "not built now, read from cache '" + cache_file_ + "' in " + seconds_since(start);
  }
  return true;
}

void SharedWall::build_block(const WallMesh &whole, const GridSettings &want, GridReport &report)
{
  std::unique_ptr<TriangleGrid> grid;
  std::size_t bytes = 0;
  run_collectively(shared_.world(), shared_.writes(), [&] {
    grid = std::make_unique<TriangleGrid>(build_grid(whole, want, uses_gpu()));
    bytes = flat_bytes(*grid);
    report = grid->report;
    cells_ = report.lists.cells;
    grid_text_ = describe(report);
  });
  char *block = shared_.allocate(bytes);
  if (shared_.writes()) move_flat(*grid, block);
  shared_.publish();
}

// A cache that cannot be written costs a warning, never the run.
void SharedWall::write_cache(const GridKey &key, const GridReport &report, const CachedGrid &cached)
{
  const double start = MPI_Wtime();
  const bool missing = cached.state() == CacheState::missing;
  if (!missing) cache_warning_ = "cache '" + cache_file_ + "' " + cached.problem();
  if (cached.state() == CacheState::foreign) {
    cache_warning_ += "; it is left as it is and the grid is not kept: name another file";
    return;
  }
  std::size_t written;
  try {
    written = write_grid_cache(cache_file_, key, report, shared_.block(), shared_.bytes());
  } catch (const std::exception &e) {
    cache_warning_ += (missing ? "the grid is not kept: cache " : "; it was not replaced: ") +
                      std::string(e.what());
    return;
  }
  if (!missing) cache_warning_ += "; the grid was built and the file replaced";
  char size[32];
  std::snprintf(size, sizeof size, "%.1f MB", written / 1e6);
  cache_text_ = "written to cache '" + cache_file_ + "', " + size + " in " + seconds_since(start);
}

bool SharedWall::has(FeatureCode feature) const
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

std::size_t SharedWall::bytes() const
{
  std::size_t mesh = 0;
  if (mesh_)
    mesh = mesh_->vertices.size() * sizeof(Vec3) + mesh_->faces.size() * 7 * sizeof(int) +
           mesh_->edges.size() * 5 * sizeof(int);
  return mesh + (shared_.writes() || !shared_.is_shared() ? shared_.bytes() : 0);
}

}    // namespace lsdcd
