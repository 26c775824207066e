// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// All coats of the bodies of a wall, and what they did to its meshes in the last step.
#pragma once

#include "wall/coat/body_coat.h"

#include <deque>
#include <functional>
#include <string>
#include <vector>

namespace lsdcd {

// Errors are InputError, the same on all processes.
class BodyCoats {
 public:
  // Host, wall and meshes must outlive this object; meshes may come until make().
  BodyCoats(Host &host, const WallSpec &wall, std::deque<MeshPart> &meshes) :
      host_(host), wall_(wall), meshes_(meshes)
  {
  }

  // Makes the coats that the spec of the wall has, before there are grids. `engine`: the settings of the wall's engine; `force`: as of
  // BodyMover. Collective.
  void make(const EngineSettings &engine, Real force);
  bool any() const { return !coats_.empty(); }
  Real largest_radius() const;         // length; 0 where there are none
  std::string text(int mesh) const;    // line of the log; empty: the mesh has none

  // Renames the features that springs name. Called before a mesh gets another grid.
  void rename_features(const BodyCoat::FeatureName &name);
  // Takes the grid of a mesh from now on.
  void set_grid(const MeshPart &m);

  // Makes a step, in which all meshes are where they are now. `receded`: as of BodyCoat.
  void step(const Step &step, const BodyCoat::Receded &receded);

  // Returns the loads on each mesh in the last step, the same on all processes, or null if there are no coats.
  const std::vector<CoatLoad> *loads() const { return any() ? &loads_ : nullptr; }
  // Returns the load on a mesh, which is 0 where there are no coats.
  const CoatLoad &load(int mesh) const;
  // Returns what the contacts of coats did with energy in the last step, the same on all processes; nothing if none is recorded.
  const CoatEnergy &energy() const { return energy_; }
  // Returns the largest rates of the bodies that a coat of this mesh touched, or whose coats touched it.
  ModeRates fastest_touched(int mesh,
                            const std::function<ModeRates(const MeshPart &)> &rates) const;

  // save() writes what the coat of a mesh keeps into a saved state, with the names that `name` gives to features. restore() takes it back
  // before a step; the first process warns if it is of another law or another coat.
  void save(int mesh, MeshState &to, const BodyCoat::FeatureName &name);
  void restore(int mesh, const MeshState &was);

  std::size_t bytes() const;

 private:
  BodyCoat *of(int mesh);

  Host &host_;
  const WallSpec &wall_;
  std::deque<MeshPart> &meshes_;
  std::deque<BodyCoat> coats_;
  std::vector<CoatLoad> loads_;    // of each mesh
  CoatEnergy energy_;
};

}    // namespace lsdcd
