// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Shared by the tests of the library's wall: a floor, and grains in arrays of the caller.
#pragma once

#include "lsdcd_behind_core.h"
#include "support/says.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

constexpr double kN = 1000, kT = 300, kDt = 1e-3;
// The words of a wall with these.
inline const std::string kFloorWords = "hooke/history 1000 300 0 0 0.5 0 mesh $floor ";
// Products and sums of a few numbers of order one.
constexpr double kRounding = 1e-13;

// A floor of two triangles at z = 0, from -10 to 10, which meet on the line x = y.
class FloorTest : public testing::Test {
 protected:
  const testing::TestInfo *const info_ = testing::UnitTest::GetInstance()->current_test_info();
  const std::string file_ =
      testing::TempDir() + "floor_of_" + info_->test_suite_name() + "_" + info_->name() + ".stl";

  void SetUp() override
  {
    std::ofstream(file_)
        << "solid f\nfacet normal 0 0 1\nouter loop\nvertex -10 -10 0\nvertex 10 -10 0\n"
           "vertex 10 10 0\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\n"
           "vertex -10 -10 0\nvertex 10 10 0\nvertex -10 10 0\nendloop\nendfacet\n"
           "endsolid f\n";
    mesh_.emplace(file_);
  }
  void TearDown() override { std::remove(file_.c_str()); }

  // `words`: what follows kFloorWords.
  lsdcd::Wall floor_wall(const std::string &words = "",
                         const lsdcd_wall_options *options = nullptr) const
  {
    return lsdcd::Wall(kFloorWords + words, {{"floor", *mesh_}}, options);
  }

  std::optional<api::Mesh> mesh_;    // of the file
};

// Keeps the lines and warnings that walls of these options show.
struct Shown : lsdcd::WallOptions {
  std::vector<std::string> lines, warnings;

  Shown(const Shown &) = delete;    // it points to itself
  Shown()
  {
    data = this;
    show = [](void *shown, int warning, const char *text) {
      Shown &to = *static_cast<Shown *>(shown);
      (warning ? to.warnings : to.lines).push_back(text);
    };
  }
};

// Gives a wall a box about the origin, periodic along z or nowhere.
inline void set_box(lsdcd::WallOptions &options, double half, bool periodic = true)
{
  for (int k = 0; k < 3; k++) options.hi[k] = -(options.lo[k] = -half);
  options.periodic[2] = periodic;
  if (periodic) options.margin = 0.1;
}

inline lsdcd_wall_step step_of(double dt = kDt)
{
  lsdcd_wall_step step = {};
  step.size = sizeof step;
  step.dt = dt;
  return step;
}

struct Grains {
  std::vector<double> x, v, omega, radius, mass, force, torque;

  Grains() = default;
  Grains(double px, double py, double pz, double vx = 0) { add(px, py, pz, vx); }    // one

  void add(double px, double py, double pz, double vx = 0)
  {
    for (const double n : {px, py, pz}) x.push_back(n);
    for (const double n : {vx, 0., 0.}) v.push_back(n);
    radius.push_back(0.5);
    mass.push_back(1);
    omega.resize(x.size());
    force.resize(x.size());
    torque.resize(x.size());
  }
  lsdcd_spheres spheres()
  {
    lsdcd_spheres s = {};
    s.size = sizeof s;
    s.n = radius.size();
    s.x = x.data();
    s.v = v.data();
    s.omega = omega.data();
    s.radius = radius.data();
    s.mass = mass.data();
    s.force = force.data();
    s.torque = torque.data();
    return s;
  }
  // By a wall of the library, or of a script.
  template <class AnyWall>
  void step(AnyWall &wall, int n = 1, bool setup = false)
  {
    for (int i = 0; i < n; i++) {
      force.assign(x.size(), 0);
      torque.assign(x.size(), 0);
      lsdcd_wall_step step = step_of();
      step.setup = setup;
      wall.step(spheres(), step);
    }
  }
};

inline int code_of(const std::function<void()> &work)
{
  try {
    work();
    return LSDCD_OK;
  } catch (const lsdcd::Error &e) {
    return e.code();
  }
}

inline std::string text_of(const std::function<void()> &work)
{
  try {
    work();
    return "";
  } catch (const lsdcd::Error &e) {
    return e.what();
  }
}

// Does `work` throw an Error of the library that says `part`?
inline testing::AssertionResult is_refused(const std::string &part,
                                           const std::function<void()> &work)
{
  return lsdcd::has(text_of(work), part);
}

using lsdcd::begins;
using lsdcd::has;
