// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Meshes and walls that tests share.
#pragma once

#include "contact/contact_history.h"
#include "engine/engine.h"
#include "grid/flat_grid.h"
#include "mesh/triangle_soup.h"
#include "mesh/welded_mesh.h"
#include "support/sphere_arrays.h"

#include <functional>
#include <memory>
#include <vector>

namespace lsdcd {

// A floor at z = 0 over [-half, half]^2 in 2 n^2 triangles. With a seed the
// inner nodes are moved in the plane, the triangles shuffled, and every winding
// chosen at random; z stays exactly 0.
TriangleSoup floor_mesh(int n, Real half, unsigned seed = 0);

// The same floor, its half x < 0 in n strips, the other half in m: T-junctions at x = 0. `gap` (length)
// sets the halves apart.
TriangleSoup split_floor(int n, int m, Real gap, Real half);

// Triangles on both sides of the x axis, of which those on one side have a vertex in the middle of the side of the
// other. `closed`: with the facet without area that is between them.
TriangleSoup mesh_with_junction(bool closed);

// Turned about z by an angle in radians.
TriangleSoup turned(TriangleSoup soup, Real angle);

// A closed cylinder along z, radius r, 0 <= z <= h, n segments round, m along.
TriangleSoup cylinder_mesh(int n, int m, Real r, Real h);

// A closed box between two corners, normals out, 12 triangles.
TriangleSoup box_mesh(const Vec3 &lo, const Vec3 &hi);

// Two half-planes that meet along the y axis at z = 0: the left one flat at
// z = 0 for x < 0, the right one rising by `degrees` (negative: falling).
TriangleSoup hinge_mesh(Real degrees, Real half);

// An open cone of n facets, its tip at the origin, widening downwards to z = -height.
TriangleSoup cone_mesh(int n, Real radius, Real height);

// n small faces all round the origin, each with its middle at distance 1: n contacts.
TriangleSoup faces_all_round(int n);

// A torus of n x n quads cut in two, whose n^2 vertices are anywhere: it meets itself in every way.
TriangleSoup crumpled_torus(const std::vector<Vec3> &x, int n);

void append(TriangleSoup &soup, const TriangleSoup &more);
TriangleSoup joined(TriangleSoup one, const TriangleSoup &other);
TriangleSoup moved(TriangleSoup soup, const Vec3 &by);
// Every facet wound the other way.
TriangleSoup inverted(TriangleSoup soup);

// With the tolerance that a wall takes by itself.
std::shared_ptr<const WeldedMesh> welded(const TriangleSoup &soup);

// A wall with an engine, ready for steps with one or more spheres.
class Scene {
 public:
  Scene(const TriangleSoup &soup, Real cutoff, EngineSettings settings, Real grid_length = 0,
        Real weld_tolerance = -1, int nearest = 0);

  void use(std::unique_ptr<WallEngine> other);    // replaces the test's engine

  int add_sphere(const Vec3 &x, Real radius, Real mass, const Vec3 &v = {0, 0, 0},
                 const Vec3 &omega = {0, 0, 0});
  // Clears forces and computes them; springs move unless `update` is false.
  void compute(Real dt, bool update = true, bool per_sphere = false);
  // One velocity-Verlet step of spheres under gravity and the wall, as fix
  // nve/sphere does it; `more_forces` is called after the wall's, where it is set.
  void step(Real dt, const Vec3 &gravity);

  std::function<void(Scene &, Real dt)> more_forces;
  void add_force(int i, const Vec3 &force, const Vec3 &torque)
  {
    put_vector(spheres_.force, i, this->force(i) + force);
    put_vector(spheres_.torque, i, this->torque(i) + torque);
  }

  Vec3 force(int i) const { return vector_at(spheres_.force, i); }
  Vec3 torque(int i) const { return vector_at(spheres_.torque, i); }
  Real heat(int i) const { return spheres_.heat_flow[i]; }    // power, where the law has heat
  Vec3 x(int i) const { return vector_at(spheres_.x, i); }
  Vec3 v(int i) const { return vector_at(spheres_.v, i); }
  Vec3 omega(int i) const { return vector_at(spheres_.omega, i); }
  void set_x(int i, const Vec3 &value) { put_vector(spheres_.x, i, value); }
  void set_v(int i, const Vec3 &value) { put_vector(spheres_.v, i, value); }
  void set_omega(int i, const Vec3 &value) { put_vector(spheres_.omega, i, value); }
  Real mass(int i) const { return spheres_.mass[i]; }
  Real radius(int i) const { return spheres_.radius[i]; }
  int n() const { return spheres_.n(); }

  WeldedMesh mesh;
  StepGrid grid;
  ContactHistory springs;
  std::unique_ptr<WallEngine> engine;
  Real wall_temperature = 0, sphere_temperature = 0;    // where the law has heat

 private:
  FlatOf<StepGrid> flat_;
  SphereArrays spheres_;
};

}    // namespace lsdcd
