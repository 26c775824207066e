// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A mesh of a wall and its grid, made once per node and read by all.
#pragma once

#include "box/periodic_images.h"
#include "grid/triangle_grid.h"
#include "host/host.h"
#include "mesh/welded_mesh.h"
#include "tree/triangle_tree.h"
#include "wall/spec/wall_spec.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace lsdcd {

// Making and building are collective and throw the same InputError on every process.
class MeshGrid {
 public:
  // Reads the mesh, or takes it from its spec, and places and welds it. Host and specs must outlive this object.
  MeshGrid(Host &host, const WallSpec &wall, const MeshSpec &spec);

  // Makes the grid for particles up to radius `cutoff` with centres in `box`, with the periodic
  // images of the mesh that act there, or reads it from its cache file. The grid of the n-th
  // cutoff, n > 1, is kept in a file of its own, FILE.n; that of another box in none.
  void build(Real cutoff, const PeriodicBox &box);

  // Returns whether the grid is right for spheres in this box, too, the same on all processes. Images follow the box to kBoxTolerance of
  // the cutoff.
  bool fits(const PeriodicBox &box) const;
  static constexpr Real kBoxTolerance = 1e-4;

  bool has_images() const { return !spec_.has_nodes && view().wall.images.same_vertex; }
  // Returns whether no sphere in the box can touch the wall.
  bool out_of_reach() const { return !spec_.has_nodes && cells_ == 0; }

  const MeshReport &report() const { return report_; }
  std::uint64_t mesh_fingerprint() const { return mesh_fingerprint_; }    // as its placement has it
  const std::string &mesh_text() const { return mesh_text_; }    // of the process that read it
  const std::string &grid_text() const { return grid_text_; }    // on every process
  // Return texts on the last build's cache file, and on what was wrong with it; empty on all processes but the first, and if there is
  // nothing to say.
  const std::string &cache_text() const { return cache_text_; }
  const std::string &cache_warning() const { return cache_warning_; }
  // Returns a text on ends of the mesh that do not meet across a periodic face, after the last build; on every process.
  const std::string &ends_warning() const { return ends_warning_; }
  bool has_parted() const { return has_parted_; }    // they met in the box before
  ViewOf<StepGrid> view() const { return ViewOf<StepGrid>(flat_view(memory_.block.get())); }
  Real cutoff() const { return cutoff_; }                 // 0 before the first build
  bool is_shared() const { return memory_.is_shared; }    // with the processes of the node

  // Returns whether this mesh has a feature that a spring names.
  bool has(FeatureCode feature) const;

  // Moves the vertices to other places in the mesh's frame (length), given on processes that have the mesh. Does not build the grid again.
  // Collective.
  void move_vertices(const std::vector<Vec3> &at);

  // Returns the mesh. One process per node has it, or all if grains may be no spheres or nodes move; null on others.
  const WeldedMesh *mesh() const { return mesh_.get(); }
  // Returns the tree of the triangles of the grid, with images; null before the first build, and if all grains are spheres.
  const TriangleTree *tree() const { return tree_ ? &tree_->tree : nullptr; }

  std::size_t bytes() const;    // held by this process

  // Told how far a build is, on processes that build.
  ProgressListener progress;

 private:
  void read();
  bool is_on_all() const
  {
    return spec_.has_nodes || wall_.shapes;
  }    // all processes have the mesh
  bool uses_gpu() const;
  StepGridSettings grid_settings(Real cutoff, const PeriodicBox &box) const;
  Box within(Real cutoff, const PeriodicBox &box) const;
  WeldedMesh whole(Real cutoff, const PeriodicBox &box) const;
  void note_images(const WeldedMesh &whole);
  void note_ends(const WeldedMesh &whole, const PeriodicBox &before);

  Host &host_;
  const WallSpec &wall_;
  const MeshSpec &spec_;
  NodeMemory memory_;    // after the first build
  std::unique_ptr<WeldedMesh>
      mesh_;    // on one process per node, and on all where grains may be no spheres
  struct MeshTree {
    WeldedMesh mesh;
    TriangleTable names;
    TriangleTree tree;

    explicit MeshTree(WeldedMesh of) : mesh(std::move(of)), names(mesh), tree(mesh, names) {}
  };
  std::unique_ptr<MeshTree> tree_;
  MeshReport report_;
  std::uint64_t mesh_fingerprint_ = 0;
  std::string mesh_text_, grid_text_;
  std::string cache_text_, cache_warning_, ends_warning_;    // of the last build
  bool has_parted_ = false;                                  // in the last build
  PeriodicBox box_;                                          // of the last build
  Box within_ = kNoLimit;
  std::uint64_t cells_ = 0;
  int cutoffs_ = 0;    // that there were builds for
  Real cutoff_ = 0;
};

}    // namespace lsdcd
