// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The surface of a mesh in its own frame: as it was read, receding by its wear, or of nodes that move.
#pragma once

#include "wall/saved/mesh_state.h"
#include "wall/surface/mesh_grid.h"
#include "wall/surface/mesh_nodes.h"

#include <memory>
#include <string>

namespace lsdcd {

// The surface of one mesh. In each step: change(), begin(), and end() once contacts are computed. Errors are InputError, the same on all
// processes, with a text that names the mesh.
class MeshSurface {
 public:
  // Makes a surface that stays as `grid` has read it. Host, wall and grid must outlive this object.
  MeshSurface(Host &host, const WallSpec &wall, int mesh, MeshGrid &grid) :
      host_(host), wall_(wall), index_(mesh), grid_(grid)
  {
  }
  virtual ~MeshSurface() = default;

  // Returns the mesh in this step; null on processes that do not have it. All have it if nodes move or grains may be no spheres, else one
  // per node.
  virtual const WeldedMesh *mesh() const { return grid_.mesh(); }
  // Returns the records of the mesh's features; none if nodes move, because then only the engine has them.
  virtual MeshFeaturesView records() const { return grid_.view().wall; }
  virtual Box bounds() const { return {grid_.report().lo, grid_.report().hi}; }
  virtual bool changes() const { return false; }    // from step to step
  // Returns the nodes of the mesh if they move, or null.
  virtual MeshNodes *nodes() const { return nullptr; }
  // Return the volume that wear has removed, and the volume that is worn but held back; see MeshWear.
  virtual Real removed() const { return 0; }
  virtual Real held_back() const { return 0; }

  // Throws if the mesh cannot change in two dimensions.
  virtual void check_plane() const {}
  // Throws if the surface is not known in a snapshot.
  virtual void check_snapshot() const {}
  // Throws if the surface cannot change with the grid that was built.
  virtual void check_grid() const {}

  // Moves vertices that are no nodes, if that is due. Returns whether vertices have moved: then the grid must be built again. Collective.
  virtual bool change(const Step & /* step */) { return false; }
  // Returns how far change() has moved each vertex (length), the same on all processes; empty if energy is not recorded.
  virtual std::vector<Vec3> receded() const { return {}; }
  // Begins a step.
  virtual void begin(const Step & /* step */, Real /* cutoff */) {}
  // Notes what the contacts of a step with spheres do to the surface.
  virtual void end(const StepResults & /* results */, const Step & /* step */) {}

  // Returns the line of the log on wear; empty: there is nothing to say.
  virtual std::string recedes_text() const { return ""; }

  // save() writes what the surface needs to continue into a saved state. restore() takes from a state what is of this surface, and returns
  // whether vertices have moved: then the grid must be built again. `same`: the state is of the same mesh. The first process warns of what
  // is left out. Both are collective.
  virtual void save(MeshState & /* to */) const {}
  // Throws InputError, the same on all processes, if restore() would make a mesh that cannot be.
  virtual void check(const MeshState & /* was */, bool /* same */) const {}
  virtual bool restore(const MeshState &was, bool same);

  virtual std::size_t bytes() const { return 0; }    // beside the grid's

 protected:
  std::string named(const std::string &text) const;
  void warn_of_nodes(const MeshState &was) const;
  void warn_of_wear(const MeshState &was, bool same) const;

  Host &host_;
  const WallSpec &wall_;
  int index_;
  MeshGrid &grid_;
};

// Makes the surface that the spec of a mesh describes. Host, wall and grid must outlive this object. Throws InputError on all processes.
// Collective.
std::unique_ptr<MeshSurface> make_surface(Host &host, const WallSpec &wall, int mesh,
                                          MeshGrid &grid);

}    // namespace lsdcd
