// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// One mesh of a wall: its spec and grid, and where it is.
#pragma once

#include "engine/loads/feature_engine.h"
#include "wall/move/mover.h"
#include "wall/surface/mesh_surface.h"

#include <memory>

namespace lsdcd {

struct MeshPart {
  // Makes this mesh of the wall, counted from 0, and reads its file. `force`: as of Mover. Host, wall and laws must outlive this object.
  // Throws InputError on all processes. Collective.
  MeshPart(Host &host, WallSpec &wall, const LawTable &laws, int index, Real force,
           const Step &now) :
      index(index),
      spec(wall.meshes[index]), grid(host, wall, spec),
      surface(make_surface(host, wall, index, grid)),
      mover(host, wall, laws, index, grid, force, now), body(mover.body()), host_(host)
  {
  }

  const int index;
  MeshSpec &spec;    // in that of the wall; its motion may change later
  MeshGrid grid;     // as it was read, and as a surface without nodes is
  const std::unique_ptr<MeshSurface> surface;
  Mover mover;
  BodyMover *const body;    // of the mover; null: it is none

  bool springs_are_foreign = false;    // those of a saved state are of another mesh
  bool way_warned = false;             // that it goes far in a step
  bool coat_feels_it = false;          // the coat of a body, which may be outside of the box

  MeshNodes *nodes() const { return surface->nodes(); }    // null: they do not move
  const Servo &servo() const { return spec.motion.servo(); }
  FeatureCounts feature_counts() const
  {
    const MeshReport &has = grid.report();
    return {has.facets, has.edges, has.vertices};
  }
  bool moves() const { return spec.has_nodes || spec.motion.any(); }    // or was moved
  // Returns whether the mesh stood still in the last step, and does so until something is set that moves it.
  bool is_at_rest() const
  {
    return is_same_place(mover.pose_before(), pose()) && !spec.motion.acts() && !spec.has_nodes &&
           !spec.surface_varies();
  }
  // Returns how the mesh gives way to pushes where it is now (1/mass).
  Mobility mobility() const { return body ? body->mobility() : Mobility(); }
  bool has_coat() const { return spec.body.present && spec.body.coat.present; }

  const Pose &pose() const { return mover.pose(); }    // in this step

  // Returns whether a spring may name this feature of the mesh.
  bool has(FeatureCode feature) const { return !springs_are_foreign && grid.has(feature); }

  // Returns the mesh in its own frame in this step; null on processes that do not have it (mesh_surface.h).
  const WeldedMesh *mesh() const { return surface->mesh(); }
  ViewOf<StepGrid> view() const { return grid.view(); }    // where its nodes do not move
  // Returns the records of the mesh's features; none if its nodes move.
  MeshFeaturesView records() const { return surface->records(); }

  Box bounds(Real past) const;    // in its own frame, and `past` (length) beyond
  // Returns whether the mesh, at a pose, comes nearer than `depth` (a part of the box) to one of the faces that edge k of the box joins.
  // Then sets lo and hi to the range that it has along that edge, as parts of the box. Collective.
  bool reaches(const PeriodicBox &box, int k, Real depth, const Pose &at, Real &lo, Real &hi) const;
  // Returns whether the mesh looks the same from each of its images across the faces that edge k joins.
  bool keeps_edge(const PeriodicBox &box, int k) const;
  // Returns the box of what can touch the mesh, as seen from its own frame.
  PeriodicBox effective_box(const PeriodicBox &box) const;

 private:
  Host &host_;
};

}    // namespace lsdcd
