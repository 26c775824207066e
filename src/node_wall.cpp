#include "node_wall.h"

#include <cstdint>
#include <type_traits>

namespace lsdcd {

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

void NodeWall::build(Real reach)
{
  std::unique_ptr<TriangleGrid> grid;
  std::size_t bytes = 0;
  together(shared_.world(), shared_.writes(), [&] {
    GridSettings want;
    want.length = settings_.grid_length;
    want.reach = reach;
    want.memory_budget = settings_.memory_budget;
    want.sides = settings_.side != Side::both;
    want.nearest = settings_.nearest;
    want.exact = settings_.exact;
    want.in_floats = settings_.precision != Precision::double_;
    std::string why;
    const bool on_cuda = settings_.device != Device::cpu && cuda_available(&why);
    grid = std::make_unique<TriangleGrid>(build_grid(*mesh_, want, on_cuda));
    bytes = flat_bytes(*grid);
    grid_text_ = describe(grid->report);
  });
  char *block = shared_.allocate(bytes);
  if (shared_.writes()) flatten(*grid, block);
  shared_.publish();
  broadcast_text(grid_text_, 0, shared_.world());
  reach_ = reach;
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
