#include "node_wall.h"

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

NodeWall::NodeWall(MPI_Comm world, const WallSettings &settings) :
    settings_(settings), shared_(world)
{
  read();
}

// The file is read by rank 0 alone: it may not be there on other nodes.
void NodeWall::read()
{
  int rank;
  MPI_Comm_rank(shared_.world(), &rank);
  TriangleSoup soup;
  soup.source = settings_.mesh_file;
  together(shared_.world(), rank == 0, [&] {
    soup = read_stl(settings_.mesh_file);
    settings_.placement.apply(soup);
  });

  // One writer per node; rank 0 is the first of them.
  together(shared_.world(), shared_.writes(), [&] {
    int n_writers;
    MPI_Comm_size(shared_.writers(), &n_writers);
    if (n_writers > 1) {
      std::uint64_t corners = soup.corners.size();
      MPI_Bcast(&corners, 1, MPI_UINT64_T, 0, shared_.writers());
      soup.corners.resize(corners);
      broadcast_bytes(soup.corners.data(), corners * sizeof(Vec3), 0, shared_.writers());
    }
    mesh_ = std::make_unique<WallMesh>(weld(soup, settings_.weld));
    report_ = mesh_->report;
  });
  static_assert(std::is_trivially_copyable<MeshReport>::value, "sent as bytes");
  MPI_Bcast(&report_, sizeof report_, MPI_BYTE, 0, shared_.world());
  if (rank == 0) mesh_text_ = describe(report_, settings_.mesh_file);
}

GridSettings NodeWall::grid_settings(Real reach) const
{
  GridSettings want;
  want.length = settings_.grid_length;
  want.reach = reach;
  want.memory_budget = settings_.memory_budget;
  want.sides = settings_.side != Side::both;
  want.nearest = settings_.nearest;
  want.exact = settings_.exact;
  want.in_floats = settings_.precision != Precision::double_;
  want.may_coarsen = settings_.tune >= 0 && !settings_.length_given;
  return want;
}

void NodeWall::build(Real reach)
{
  int rank;
  MPI_Comm_rank(shared_.world(), &rank);
  const GridSettings want = grid_settings(reach);
  builds_++;
  cache_file_ = settings_.cache_file;
  if (!cache_file_.empty() && builds_ > 1) cache_file_ += "." + std::to_string(builds_);
  cache_text_.clear();
  cache_warning_.clear();

  GridKey key = {};
  std::unique_ptr<CachedGrid> cached;
  const bool caches = rank == 0 && !cache_file_.empty();
  together(shared_.world(), caches, [&] {
    key = grid_key(*mesh_, want);
    cached = std::make_unique<CachedGrid>(cache_file_, key);
  });
  if (cache_file_.empty() || !read_cache(cached.get())) {
    GridReport report;
    build_block(want, report);
    if (caches) write_cache(key, report, *cached);
  }
  broadcast_text(grid_text_, 0, shared_.world());
  reach_ = reach;
}

// Rank 0 alone looks at the file and decides for all; what it reads goes to the
// writers of other nodes, who may not see that file.
bool NodeWall::read_cache(CachedGrid *cached)
{
  const double start = MPI_Wtime();
  std::uint64_t bytes = cached && cached->state() == CacheState::usable ? cached->block_bytes() : 0;
  MPI_Bcast(&bytes, 1, MPI_UINT64_T, 0, shared_.world());
  if (bytes == 0) return false;
  char *block = shared_.allocate(bytes);
  int good = 0;
  together(shared_.world(), cached, [&] { good = cached->read(block); });
  MPI_Bcast(&good, 1, MPI_INT, 0, shared_.world());
  if (!good) return false;
  if (shared_.writes()) broadcast_bytes(block, bytes, 0, shared_.writers());
  shared_.publish();
  if (cached) {
    grid_text_ = describe(cached->report());
    cache_text_ = "not built now, read from cache '" + cache_file_ + "' in " + seconds_since(start);
  }
  return true;
}

void NodeWall::build_block(const GridSettings &want, GridReport &report)
{
  std::unique_ptr<TriangleGrid> grid;
  std::size_t bytes = 0;
  together(shared_.world(), shared_.writes(), [&] {
    std::string why;
    const bool on_cuda = settings_.device != Device::cpu && cuda_available(&why);
    grid = std::make_unique<TriangleGrid>(build_grid(*mesh_, want, on_cuda));
    bytes = flat_bytes(*grid);
    report = grid->report;
    grid_text_ = describe(report);
  });
  char *block = shared_.allocate(bytes);
  if (shared_.writes()) flatten(*grid, block);
  shared_.publish();
}

// A cache that cannot be written costs a warning, never the run.
void NodeWall::write_cache(const GridKey &key, const GridReport &report, const CachedGrid &cached)
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

bool NodeWall::has(FeatureCode feature) const
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

std::size_t NodeWall::bytes() const
{
  std::size_t mesh = 0;
  if (mesh_)
    mesh = mesh_->vertices.size() * sizeof(Vec3) + mesh_->faces.size() * 7 * sizeof(int) +
           mesh_->edges.size() * 5 * sizeof(int);
  return mesh + (shared_.writes() || !shared_.is_shared() ? shared_.bytes() : 0);
}

}    // namespace lsdcd
