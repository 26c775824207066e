// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A mesh that recedes by its wear: now and then its vertices go away from the side on which spheres wear it, so that the
// volume between the old and the new surface is the worn one.
#pragma once

#include "engine/results/step_results.h"
#include "host/host.h"
#include "mesh/welded_mesh.h"
#include "wall/saved/mesh_state.h"
#include "wall/spec/wall_spec.h"

#include <array>
#include <cstddef>
#include <vector>

namespace lsdcd {

class MeshWear {
 public:
  // Wears this mesh of the wall, counted from 0, of which nothing has worn yet. `mesh`: null on processes that do not have it; the first
  // process has it. Throws InputError on all processes if its triangles are not wound alike. Collective.
  MeshWear(Host &host, const WallSpec &wall, int index, const MeshReport &report,
           const WeldedMesh *mesh);

  // Returns whether this step begins with moved vertices.
  bool is_due(const Step &step) const
  {
    return step.kind == Step::step && step.number % wall_.wear_deform.every == 0;
  }

  // Adds what contacts of this process have worn off in a step of duration dt (time). `features`: of the mesh.
  void add(const std::vector<StepContact> &contacts, Real dt, const MeshFeaturesView &features);

  // Removes what has worn since the last time. Returns whether vertices move; then `at` has their new places on all processes that have the
  // mesh, and receded() how far they went. `mesh`: as above, where it is now. Logs once which nodes stay from now on. Throws InputError if
  // too much has worn for one move. Collective.
  bool recede(const WeldedMesh *mesh, std::int64_t step, std::vector<Vec3> &at);
  // Returns how far recede() has moved each vertex, on all processes; empty if energy is not recorded.
  const std::vector<Vec3> &receded() const { return receded_; }

  // Return volumes (length^3), the same on all processes. removed(): between the first surface and that of this step. held_back(): worn,
  // times the factor, and not removed because vertices stay.
  Real removed() const { return removed_; }
  Real held_back() const { return held_back_; }

  // Returns the state for saving, which is whole on the first process only. `mesh` as above. Collective.
  SurfaceState save(const WeldedMesh *mesh) const;
  // Restores a state, which is the same on all processes.
  void restore(const SurfaceState &was);

  std::size_t bytes() const;

 private:
  struct Move {
    std::vector<Vec3> direction;    // unit, to where a vertex goes; 0: it stays
    std::vector<Real> way, sign;    // length; -1 against the normals by the winding, 1 along them
  };

  std::string named(const std::string &text) const;
  void add_at(int vertex, Real volume, const Vec3 &away);
  void hold(int vertex, int face, const WeldedMesh &mesh, std::int64_t step);
  Move plan(const WeldedMesh &mesh, Real factor, std::int64_t step);
  int parts(const WeldedMesh &mesh, std::int64_t step);
  bool move(WeldedMesh &mesh, int n, std::int64_t step);
  bool hold_folding(const WeldedMesh &mesh, const WeldedMesh &moved, std::int64_t step);
  bool hold_meeting(const WeldedMesh &mesh, const WeldedMesh &moved, std::int64_t step);

  Host &host_;
  const WallSpec &wall_;
  int index_;
  // For each vertex since the last move, on this process: the volume that came off there, and its sum times the unit
  // vectors from spheres to the wall.
  std::vector<Real> pending_;
  std::vector<Vec3> receded_;    // of the last move
  // On the first process:
  std::vector<char> held_;
  std::vector<Real> first_size_;            // of each face, twice its area at the beginning
  std::vector<std::array<int, 2>> meet_;    // pairs of faces that met then
  Real removed_ = 0, held_back_ = 0;        // on all
  Real carried_ = 0;      // volume that the rounding of places has left for the next move
  std::string report_;    // on what stays; of the first time
  bool is_reported_ = false;
};

}    // namespace lsdcd
