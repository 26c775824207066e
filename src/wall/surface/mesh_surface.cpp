// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/surface/mesh_surface.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "wall/spec/mesh_name.h"
#include "wall/surface/mesh_wear.h"

namespace lsdcd {

namespace {

class RecedingSurface final : public MeshSurface {
 public:
  RecedingSurface(Host &host, const WallSpec &wall, int mesh, MeshGrid &grid) :
      MeshSurface(host, wall, mesh, grid), wear_(host, wall, mesh, grid.report(), grid.mesh())
  {
  }

  bool changes() const override { return true; }
  Real removed() const override { return wear_.removed(); }
  Real held_back() const override { return wear_.held_back(); }

  void check_plane() const override
  {
    throw InputError(named(
        "in two dimensions wear cannot move a mesh, because what comes off one of the two "
        "triangles behind a piece of the outline would let the outline lean: leave deform out, or "
        "give the mesh wear_factor 0"));
  }

  void check_snapshot() const override
  {
    throw InputError(named("in a " + std::string(host_.names().replay) +
                           " the shape of a mesh that wear moves is not known, because it follows "
                           "from the contacts of all steps before: leave deform out, and give the "
                           "mesh of that time, which mesh_stl writes"));
  }

  void check_grid() const override
  {
    if (grid_.has_images())
      throw InputError(
          named("wear cannot move a mesh that has periodic images, because its ends would come "
                "apart: keep it away from periodic faces by the largest radius"));
  }

  bool change(const Step &step) override
  {
    if (!wear_.is_due(step)) return false;
    std::vector<Vec3> at;
    if (!wear_.recede(grid_.mesh(), step.number, at)) return false;
    grid_.move_vertices(at);
    return true;
  }

  std::vector<Vec3> receded() const override { return wear_.receded(); }

  void end(const StepResults &results, const Step &step) override
  {
    if (step.kind == Step::step) wear_.add(results.contacts(), step.dt, records());
  }

  std::string recedes_text() const override
  {
    return "every " + counted(wall_.wear_deform.every, "step") + " by " +
           number_text(wall_.wear_deform.factor) + " times what has worn";
  }

  void save(MeshState &to) const override { to.surface = wear_.save(grid_.mesh()); }

  bool restore(const MeshState &was, bool same) override
  {
    warn_of_nodes(was);
    if (was.surface.vertices.empty() || !same) return false;
    const std::vector<Real> &x = was.surface.vertices;
    std::vector<Vec3> at;
    for (std::size_t k = 0; k < x.size(); k += 3) at.push_back({x[k], x[k + 1], x[k + 2]});
    wear_.restore(was.surface);
    grid_.move_vertices(at);
    return true;
  }

  std::size_t bytes() const override { return wear_.bytes(); }

 private:
  MeshWear wear_;
};

class NodeSurface final : public MeshSurface {
 public:
  // Each process has the whole mesh of `grid`.
  NodeSurface(Host &host, const WallSpec &wall, int mesh, MeshGrid &grid) :
      MeshSurface(host, wall, mesh, grid),
      nodes_(std::make_unique<MeshNodes>(host, wall, mesh, *grid.mesh()))
  {
  }

  const WeldedMesh *mesh() const override { return &nodes_->mesh(); }
  MeshFeaturesView records() const override { return {}; }
  Box bounds() const override { return nodes_->bounds(); }
  bool changes() const override { return true; }
  MeshNodes *nodes() const override { return nodes_.get(); }

  void check_plane() const override
  {
    const std::string spheres = std::string(host_.names().sphere) + "s";
    throw InputError(named(
        "in two dimensions a mesh cannot have nodes, because its vertices lie off the plane z = 0, "
        "in which all " +
        spheres + " are: make the box three-dimensional and hold the " + spheres +
        " in the plane, or leave nodes out"));
  }

  void begin(const Step &step, Real cutoff) override { nodes_->begin_step(step, cutoff); }

  void save(MeshState &to) const override { to.nodes = nodes_->save(); }

  void check(const MeshState &was, bool same) const override
  {
    if (same) nodes_->check(was.nodes);
  }

  // Those of another mesh are in another order, and as many as it has vertices.
  bool restore(const MeshState &was, bool same) override
  {
    if (same)
      nodes_->restore(was.nodes);
    else if (!was.nodes.places.empty())
      host_.warn(
          named("the " + std::string(host_.names().saved) +
                " was written with a different mesh: the nodes begin at the vertices of this "
                "one, whatever they were there"));
    warn_of_wear(was, same);
    return false;
  }

  std::size_t bytes() const override { return nodes_->bytes(); }

 private:
  const std::unique_ptr<MeshNodes> nodes_;
};

}    // namespace

std::unique_ptr<MeshSurface> make_surface(Host &host, const WallSpec &wall, int mesh,
                                          MeshGrid &grid)
{
  const MeshSpec &spec = wall.meshes[mesh];
  if (spec.has_nodes) return std::make_unique<NodeSurface>(host, wall, mesh, grid);
  if (wall.recedes(spec)) return std::make_unique<RecedingSurface>(host, wall, mesh, grid);
  return std::make_unique<MeshSurface>(host, wall, mesh, grid);
}

std::string MeshSurface::named(const std::string &text) const
{
  return with_mesh_name(wall_, index_, text);
}

bool MeshSurface::restore(const MeshState &was, bool same)
{
  warn_of_nodes(was);
  warn_of_wear(was, same);
  return false;
}

void MeshSurface::warn_of_nodes(const MeshState &was) const
{
  if (!was.nodes.places.empty())
    host_.warn(named("the " + std::string(host_.names().saved) +
                     " has nodes of this mesh that had moved, and here it has none: the mesh has "
                     "the shape of its file"));
}

void MeshSurface::warn_of_wear(const MeshState &was, bool same) const
{
  if (!was.surface.vertices.empty() && same)
    host_.warn(named("the " + std::string(host_.names().saved) +
                     " has a worn shape of this mesh, and the wear of this wall moves no mesh "
                     "(deform): the mesh has the shape of its file"));
}

}    // namespace lsdcd
