// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "support/meshes.h"

#include "study/cylinder.h"
#include "support/device.h"
#include "support/test_engine.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace lsdcd {

namespace {

void triangle(TriangleSoup &soup, const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  soup.corners.insert(soup.corners.end(), {a, b, c});
}

void quad(TriangleSoup &soup, const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d)
{
  triangle(soup, a, b, c);
  triangle(soup, a, c, d);
}

}    // namespace

TriangleSoup floor_mesh(int n, Real half, unsigned seed)
{
  std::mt19937 random(seed);
  // Below a sixth of a side no triangle can fold over.
  std::uniform_real_distribution<Real> jitter(-0.16, 0.16);
  const Real side = 2 * half / n;
  std::vector<Vec3> node((n + 1) * (n + 1));
  for (int j = 0; j <= n; j++)
    for (int i = 0; i <= n; i++) {
      Vec3 &p = node[j * (n + 1) + i];
      p = {-half + i * side, -half + j * side, 0};
      if (seed && i > 0 && i < n) p.x += side * jitter(random);
      if (seed && j > 0 && j < n) p.y += side * jitter(random);
    }
  std::vector<std::array<Vec3, 3>> triangles;
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) {
      const Vec3 a = node[j * (n + 1) + i], b = node[j * (n + 1) + i + 1];
      const Vec3 c = node[(j + 1) * (n + 1) + i + 1], d = node[(j + 1) * (n + 1) + i];
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  if (seed) {
    std::shuffle(triangles.begin(), triangles.end(), random);
    for (auto &t : triangles)
      if (random() & 1) std::swap(t[1], t[2]);
  }
  TriangleSoup soup;
  soup.source = "floor";
  for (const auto &t : triangles) triangle(soup, t[0], t[1], t[2]);
  return soup;
}

TriangleSoup cylinder_mesh(int n, int m, Real r, Real h)
{
  CylinderMesh shape;
  shape.segments = n;
  shape.along = m;
  shape.radius = r;
  shape.height = h;
  return make_cylinder(shape);
}

TriangleSoup box_mesh(const Vec3 &lo, const Vec3 &hi)
{
  TriangleSoup soup;
  soup.source = "box";
  const auto p = [&](int x, int y, int z) {
    return Vec3{x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z};
  };
  quad(soup, p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0));
  quad(soup, p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1));
  quad(soup, p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1));
  quad(soup, p(0, 1, 0), p(0, 1, 1), p(1, 1, 1), p(1, 1, 0));
  quad(soup, p(0, 0, 0), p(0, 0, 1), p(0, 1, 1), p(0, 1, 0));
  quad(soup, p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1));
  return soup;
}

TriangleSoup hinge_mesh(Real degrees, Real half)
{
  TriangleSoup soup;
  soup.source = "hinge";
  const Real a = degrees * kPi / 180;
  const Real x = half * std::cos(a), z = half * std::sin(a);
  quad(soup, {-half, -half, 0}, {0, -half, 0}, {0, half, 0}, {-half, half, 0});
  quad(soup, {0, -half, 0}, {x, -half, z}, {x, half, z}, {0, half, 0});
  return soup;
}

TriangleSoup cone_mesh(int n, Real radius, Real height)
{
  TriangleSoup soup;
  soup.source = "cone";
  for (int i = 0; i < n; i++) {
    const Real a = 2 * kPi * i / n, b = 2 * kPi * ((i + 1) % n) / n;
    soup.corners.insert(soup.corners.end(),
                        {{0, 0, 0},
                         {radius * std::cos(a), radius * std::sin(a), -height},
                         {radius * std::cos(b), radius * std::sin(b), -height}});
  }
  return soup;
}

TriangleSoup faces_all_round(int n)
{
  TriangleSoup soup;
  soup.source = "faces all round";
  for (int i = 0; i < n; i++) {
    // A spiral that spreads them evenly.
    const Real z = 1 - (2 * i + Real(1)) / n, r = std::sqrt(1 - z * z), phi = Real(2.399963) * i;
    const Vec3 out = {r * std::cos(phi), r * std::sin(phi), z};
    const Vec3 u = (1 / norm(cross(out, {0.3, 0.5, 0.8}))) * cross(out, {0.3, 0.5, 0.8});
    const Vec3 v = cross(out, u);
    const Real size = Real(0.02);
    for (int k = 0; k < 3; k++) {
      const Real a = Real(2.0943951) * k;
      soup.corners.push_back(out + (size * std::cos(a)) * u + (size * std::sin(a)) * v);
    }
  }
  return soup;
}

TriangleSoup split_floor(int n, int m, Real gap, Real half)
{
  TriangleSoup soup;
  soup.source = "split floor";
  const auto add = [&](Real x0, Real x1, int strips) {
    for (int i = 0; i < strips; i++) {
      const Real y0 = -half + 2 * half * i / strips, y1 = -half + 2 * half * (i + 1) / strips;
      soup.corners.insert(soup.corners.end(), {{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}});
      soup.corners.insert(soup.corners.end(), {{x0, y0, 0}, {x1, y1, 0}, {x0, y1, 0}});
    }
  };
  add(-half, -gap / 2, n);
  add(gap / 2, half, m);
  return soup;
}

TriangleSoup mesh_with_junction(bool closed)
{
  const Vec3 a = {-1, 0, 0}, b = {1, 0, 0}, middle = {0, 0, 0}, low = {0, -1, 0}, high = {0, 1, 0};
  TriangleSoup soup;
  soup.corners = {a, low, b, a, middle, high, middle, b, high};
  if (closed) soup.corners.insert(soup.corners.end(), {a, b, middle});
  return soup;
}

TriangleSoup turned(TriangleSoup soup, Real angle)
{
  for (Vec3 &p : soup.corners)
    p = {std::cos(angle) * p.x - std::sin(angle) * p.y,
         std::sin(angle) * p.x + std::cos(angle) * p.y, p.z};
  return soup;
}

TriangleSoup crumpled_torus(const std::vector<Vec3> &x, int n)
{
  TriangleSoup soup;
  const auto at = [&](int i, int j) { return x[i % n * n + j % n]; };
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      for (const Vec3 &p :
           {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
        soup.corners.push_back(p);
  return soup;
}

void append(TriangleSoup &soup, const TriangleSoup &more)
{
  soup.corners.insert(soup.corners.end(), more.corners.begin(), more.corners.end());
}

TriangleSoup joined(TriangleSoup one, const TriangleSoup &other)
{
  append(one, other);
  return one;
}

TriangleSoup moved(TriangleSoup soup, const Vec3 &by)
{
  for (Vec3 &x : soup.corners) x += by;
  return soup;
}

TriangleSoup inverted(TriangleSoup soup)
{
  for (std::size_t t = 0; t < soup.corners.size(); t += 3)
    std::swap(soup.corners[t], soup.corners[t + 1]);
  return soup;
}

std::shared_ptr<const WeldedMesh> welded(const TriangleSoup &soup)
{
  return std::make_shared<WeldedMesh>(weld(soup, -1));
}

Scene::Scene(const TriangleSoup &soup, Real cutoff, EngineSettings settings, Real grid_length,
             Real weld_tolerance, int nearest) :
    mesh(weld(soup, weld_tolerance)),
    springs(settings.law().n_extra())
{
  StepGridSettings g;
  g.length = grid_length;
  g.cutoff = cutoff;
  g.sides = settings.side != Side::both;
  g.nearest = nearest;
  grid = build_grid(mesh, g, test_on_cuda());
  flat_ = FlatOf(grid);
  use(make_test_engine(settings));
}

void Scene::use(std::unique_ptr<WallEngine> other)
{
  engine = std::move(other);
  engine->set_grid(flat_.view());
}

int Scene::add_sphere(const Vec3 &x, Real radius, Real mass, const Vec3 &v, const Vec3 &omega)
{
  const int i = spheres_.add(x, radius, mass, v, omega);
  springs.grow(i + 1);
  return i;
}

void Scene::compute(Real dt, bool update, bool per_sphere)
{
  spheres_.clear_forces();
  spheres_.heat_flow.assign(n(), 0);
  spheres_.temperature.assign(n(), sphere_temperature);
  StepSettings step;
  step.wall_temperature = wall_temperature;
  step.dt = dt;
  step.update_history = update;
  step.per_sphere = per_sphere;
  step_once(*engine, spheres_.spheres(), step, &springs);
}

void Scene::step(Real dt, const Vec3 &gravity)
{
  const auto kick = [&] {
    for (int i = 0; i < n(); i++) {
      set_v(i, v(i) + (0.5 * dt) * ((1 / mass(i)) * force(i) + gravity));
      const Real inertia = 0.4 * mass(i) * radius(i) * radius(i);
      set_omega(i, omega(i) + (0.5 * dt / inertia) * torque(i));
    }
  };
  kick();
  spheres_.move(dt);
  compute(dt);
  if (more_forces) more_forces(*this, dt);
  kick();
}

}    // namespace lsdcd
