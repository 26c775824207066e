// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The coat of a body: points of its surface, as spheres that feel the other meshes of the wall by the wall's own law.
#pragma once

#include "engine/engine.h"
#include "host/host.h"
#include "wall/part/mesh_part.h"
#include "wall/spheres/history_exchange.h"
#include "wall/sums/coat_load.h"

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

// Every process computes all points of a coat, so that no message is needed, and the bits do not depend on how many processes there are.
class BodyCoat {
 public:
  // `mesh`: the body's; `engine`: the settings of the wall's engine; `force`: as of BodyMover. Host and wall must outlive this object.
  // Throws InputError on all processes. Collective.
  BodyCoat(Host &host, const WallSpec &wall, int mesh, const MeshGrid &grid, EngineSettings engine,
           Real force);

  int mesh() const { return mesh_; }
  Real radius() const { return radius_; }
  std::string text() const;    // line of the log

  using FeatureName = HistoryExchange::FeatureName;
  // Renames the features that springs name, as `name` says. Called before a mesh gets another grid.
  void rename_features(const FeatureName &name);
  // Sets the grid of a mesh from now on.
  void set_grid(const MeshPart &m);

  // The following functions make a step, in which all meshes are where they are now: begin() of all coats, then finish() of all. Both throw
  // InputError, the same on all processes.

  // Finds the contacts and adds them to the pushes. Throws if a point has gone through a mesh since the step before.
  void begin(const std::deque<MeshPart> &meshes, const Step &step, CoatPushes &pushes);
  // Computes the contacts, whose damping hangs on all pushes. Adds them to the loads of each mesh, and what they do with energy to
  // `energy`, if that is recorded. `receded`: see StepSettings; empty: wear has moved no mesh.
  using Receded = std::vector<std::vector<Vec3>>;
  void finish(const std::deque<MeshPart> &meshes, const Step &step, const CoatPushes &pushes,
              const Receded &receded, std::vector<CoatLoad> &loads, CoatEnergy &energy);

  // save() returns what the contacts of the coat keep, with the names that `name` gives to features. restore() takes it back before a step;
  // the first process warns if it is of another law or another coat.
  std::vector<Real> save(const FeatureName &name);
  void restore(const std::vector<Real> &saved);

  std::size_t bytes() const;

 private:
  const CoatSpec &spec() const { return wall_.meshes[mesh_].body.coat; }
  Real body_mass() const { return wall_.meshes[mesh_].body.mass.mass; }
  bool is_held(Real gives_way) const;
  std::string named(const std::string &text) const;
  void put(const std::deque<MeshPart> &meshes, Real share, Real back);
  void place(const Pose &pose, Real back);
  void choose(const std::deque<MeshPart> &meshes);
  void check_way(const std::deque<MeshPart> &meshes, const Step &step);
  void look(StepSettings want);
  Spheres spheres();
  FeatureName of_others(const FeatureName &name) const;
  SurfaceMotion surface_against(const MeshPart &own, const MeshPart &other) const;
  StepSettings settings(const std::deque<MeshPart> &meshes, const Step &step);
  void add_receded(const Receded &receded, StepSettings &step);
  void find_contacts(const std::deque<MeshPart> &meshes, CoatPushes &pushes);
  void take_masses(const std::deque<MeshPart> &meshes, const CoatPushes &pushes);
  void take_restored(const std::deque<MeshPart> &meshes);
  void add_loads(const std::deque<MeshPart> &meshes, std::vector<CoatLoad> &loads) const;
  void add_energy(CoatEnergy &energy) const;
  void add_stiffness(const std::deque<MeshPart> &meshes, std::vector<CoatLoad> &loads) const;
  Real deepest(int &other) const;
  void check_depth();

  Host &host_;
  const WallSpec &wall_;
  int mesh_;
  Real force_;
  Real apart_ = 0, radius_ = 0;     // length
  std::vector<int> others_;         // the meshes of its engine
  std::vector<ContactLaw> laws_;    // of each
  std::vector<Vec3> points_;        // in the frame of the mesh
  std::vector<Vec3> x_, v_, omega_, force_on_, torque_on_;
  std::vector<Real> radii_, masses_;
  Real heavy_ = 0;    // the mass of points that touch no other body
  // The strongest contact that a point has with another mesh in this step.
  struct PointContact {
    int point, other;    // numbers of the wall's mesh
    Vec3 at, normal;     // in the box; to the point
  };
  std::vector<PointContact> contacts_;
  std::unique_ptr<WallEngine> engine_;
  HistoryExchange history_;    // of the points
  bool deep_warned_ = false;
  bool is_as_placed_ = true;      // no step was made
  std::vector<Real> restored_;    // until the first step
  // What each mesh of the engine has in a step.
  std::vector<SurfaceMotion> surfaces_;
  std::vector<Mobility> mobilities_;    // of this body, in their frames
  Receded receded_;                     // read only where a mesh has moved so
};

}    // namespace lsdcd
