// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall of meshes and laws: against the wall of a script's words, bit for bit, and in closed form; poses, totals and
// wrong fields.
#include "floor_and_grains.h"
#include "process.h"
#include "support/fake_host.h"
#include "support/random.h"
#include "support/script_wall.h"
#include "support/temp_dir.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace test_library_wall_spec {
namespace {

using Vector = std::array<double, 3>;
using lsdcd::uniform;

// A power of two, so that times and places are sums without rounding.
constexpr double kStep = 0x1p-10;

class wall_spec : public FloorTest {
 protected:
  static api::Law hooke_history(double kn = kN)
  {
    return api::Law::classic({"hooke/history", {kn, kT, 0, 0, 0.5, 0}});
  }
  api::WallSpec floor_of(const api::Law &law, const api::Mesh &mesh) const
  {
    api::WallSpec spec;
    spec.law = law;
    spec.meshes.emplace_back(mesh, "floor");
    return spec;
  }
  api::WallSpec floor(const api::Law &law = hooke_history()) const { return floor_of(law, *mesh_); }
  api::WallSpec floor_that_moves(const api::Motion &motion) const
  {
    api::WallSpec spec = floor();
    spec.meshes[0].motions = {motion};
    return spec;
  }
  // By a servo along z.
  api::WallSpec floor_that_pushes(double force, double max_speed) const
  {
    api::WallSpec spec = floor();
    api::Servo servo;
    servo.axis[2] = 1;
    servo.target = force;
    servo.max_speed = max_speed;
    spec.meshes[0].servo = servo;
    return spec;
  }
  // Of the same floor in a script.
  std::vector<std::string> words(const std::string &more = "") const
  {
    return lsdcd::words("hooke/history 1000 300 0 0 0.5 0 mesh " + file_ + " device cpu " + more);
  }
};

// Spheres of two types that press, slide and turn on the floor, over its inner edge, too.
struct Pile : Grains {
  std::vector<int> type;
  std::vector<double> temperature, heat;

  Pile()
  {
    for (int i = 0; i < 6; i++) {
      add(0.7 * i - 2, 0.6 * i - 2.1, 0.46 + 0.01 * i, 0.3 - 0.1 * i);
      v[3 * i + 1] = 0.05 * i;
      v[3 * i + 2] = -0.2;
      omega[3 * i] = 0.4 * i;
      omega[3 * i + 2] = 1 - 0.3 * i;
      type.push_back(1 + i % 3);
      temperature.push_back(300 + i);
    }
  }
  // The forces of a wall, of the library or a script, in n steps, in which the spheres fall by their velocities.
  template <class AnyWall>
  std::vector<double> go(AnyWall &wall, int n = 12)
  {
    std::vector<double> all;
    for (int k = 0; k < n; k++) {
      force.assign(x.size(), 0);
      torque.assign(x.size(), 0);
      heat.assign(radius.size(), 0);
      lsdcd_spheres s = spheres();
      s.type = type.data();
      s.temperature = temperature.data();
      s.heat = heat.data();
      lsdcd_wall_step step = step_of(kStep);
      step.setup = k == 0;
      wall.step(s, step);
      for (const auto *numbers : {&force, &torque, &heat})
        all.insert(all.end(), numbers->begin(), numbers->end());
      for (std::size_t i = 0; i < x.size(); i++) x[i] += kStep * v[i];
    }
    return all;
  }
};

bool any_nonzero(const std::vector<double> &numbers)
{
  for (const double x : numbers)
    if (x != 0) return true;
  return false;
}

// ---- laws of materials -----------------------------------------------------------------------

const char *const kMaterials = "units si\n"
                               "material glass\n"
                               "  youngs_modulus 5e4 Pa\n"
                               "  poissons_ratio 0.23 1\n"
                               "  surface_energy 0.5 J/m2\n"
                               "  thermal_conductivity 1.7 W/m/K\n"
                               "material steel\n"
                               "  youngs_modulus 2e5 Pa\n"
                               "  poissons_ratio 0.3 1\n"
                               "  surface_energy 0.8 J/m2\n"
                               "  thermal_conductivity 51 W/m/K\n"
                               "pair glass glass\n"
                               "  restitution 0.9 1\n"
                               "  sliding_friction 0.092 1\n"
                               "pair glass steel\n"
                               "  sliding_friction 0.2 1\n";

class law_of_materials : public wall_spec {
 protected:
  lsdcd::TempDir folder_;
  const std::string materials_ = folder_.write("some.lsdcd", kMaterials);

  api::Materials of(const std::string &particle, const std::string &wall = "",
                    const std::vector<api::Materials::Override> &overrides = {},
                    const std::string &units = "si") const
  {
    return {materials_, particle, wall, overrides, units};
  }
  // The forces of the wall of these words with `material`.
  std::vector<double> of_words(const std::string &line, const std::string &units = "si") const
  {
    const char *const hot = line.find(" heat ") != line.npos ? " temperature 350" : "";
    std::vector<std::string> words = lsdcd::words(line + " mesh " + file_ + " device cpu" + hot);
    std::replace(words.begin(), words.end(), std::string("FILE"), materials_);
    lsdcd::ScriptWall wall(words, units);
    return Pile().go(wall);
  }
  std::vector<double> of_law(const api::Law &law) const
  {
    api::WallSpec spec = floor(law);
    if (!law.heat.name.empty()) spec.meshes[0].temperature = 350;
    api::Wall wall(spec);
    return Pile().go(wall);
  }
};

TEST_F(law_of_materials, has_the_bits_of_the_words)
{
  api::Law adhesive, damped, hot, sticky;
  adhesive.normal = {"jkr"};
  damped.damping = {"tsuji"};
  damped.tangential = {"mindlin", {api::kDerived, 0.5, api::kDerived}};
  damped.rolling = {"sds", {1e4, 1, 0.1}};
  damped.limit_damping = true;
  hot.heat = {"radius", {api::kDerived}};
  sticky.cohesion = {"sjkr", {50}};
  const struct {
    const char *words;
    api::Materials materials;
    api::Law with;
    const char *units;
  } rows[] = {
      {"granular material FILE glass", of("glass"), {}, "si"},
      {"granular material FILE glass", of("glass", "", {}, "cgs"), {}, "cgs"},
      {"granular material FILE glass on steel with restitution 0.8",
       of("glass", "steel", {{"", "restitution", 0.8}}),
       {},
       "si"},
      {"granular material FILE glass on steel with steel youngs_modulus 1e5 restitution 0.8",
       of("glass", "steel", {{"steel", "youngs_modulus", 1e5}, {"", "restitution", 0.8}}),
       {},
       "si"},
      {"granular jkr material FILE glass on steel", of("glass", "steel"), adhesive, "si"},
      {"granular material FILE glass tangential mindlin NULL 0.5 NULL damping tsuji rolling sds "
       "1e4 "
       "1 0.1 limit_damping",
       of("glass"), damped, "si"},
      {"granular material FILE glass heat radius NULL", of("glass"), hot, "si"},
      {"granular material FILE glass cohesion sjkr 50", of("glass"), sticky, "si"},
  };
  for (const auto &row : rows) {
    const std::vector<double> wanted = of_words(row.words, row.units);
    EXPECT_TRUE(any_nonzero(wanted)) << row.words;
    EXPECT_EQ(of_law(api::Law::from_material(row.materials, row.with)), wanted) << row.words;
  }
}

TEST_F(law_of_materials, tells_each_number_and_its_source)
{
  std::string report;
  const api::Law law = api::Law::from_material(of("glass"), &report);
  EXPECT_EQ(law.normal.numbers, (std::vector<double>{5e4, 0.9, 0.23}));
  EXPECT_TRUE(has(report, "glass on glass: restitution 0.9 (some.lsdcd line 13)"));
}

TEST_F(law_of_materials, says_what_is_wrong)
{
  const auto with = [](const std::string &normal, const api::SubModel &damping) {
    api::Law law;
    law.normal = {normal};
    law.damping = damping;
    return law;
  };
  api::Law classic = hooke_history(), sticky, stiff;
  sticky.cohesion = {"sjkr", {-50}};
  stiff.rolling = {"sds", {api::kDerived, 1, 0.1}};
  const struct {
    api::Materials materials;
    api::Law law;
    std::string says;
    int code;
  } rows[] = {
      {of("iron"), {}, "some.lsdcd", LSDCD_ERROR_INPUT},
      {of(""), {}, "`materials.particle` is \"\"", LSDCD_ERROR_ARGUMENT},
      {of("glass", "steel"),
       {},
       "has no restitution of glass on steel: write 'overrides restitution",
       LSDCD_ERROR_INPUT},
      {of("glass", "steel", {{"", "youngs_modulus", 1e5}}),
       {},
       "write which one you mean",
       LSDCD_ERROR_INPUT},
      {of("glass", "", {{"", "restitution", 2}}),
       {},
       "`materials.overrides[0]` is \"restitution\": restitution = 2 is out of range",
       LSDCD_ERROR_ARGUMENT},
      {of("glass", "", {{"", "resitution", 0.5}}),
       {},
       "`materials.overrides[0]` is \"resitution\": 'resitution' is not a property; the nearest is "
       "'restitution'",
       LSDCD_ERROR_ARGUMENT},
      {of("glass", "", {{"steel", "youngs_modulus", 1e5}}),
       {},
       "`materials.overrides[0].of` is \"steel\": the materials are",
       LSDCD_ERROR_ARGUMENT},
      {of("glass", "", {{"", "restitution", 0.5}, {"", "restitution", 0.6}}),
       {},
       "`materials.overrides[1].key` is \"restitution\": it is given twice",
       LSDCD_ERROR_ARGUMENT},
      {of("glass"), classic, "`law.style.name` is \"hooke/history\": a style takes no materials",
       LSDCD_ERROR_ARGUMENT},
      {of("glass"), with("hertz", {}), "`law.normal.name` is \"hertz\"", LSDCD_ERROR_ARGUMENT},
      {of("glass"), with("jkr", {"tsuji"}), "does not take the material's restitution",
       LSDCD_ERROR_INPUT},
      {of("glass"), sticky, "`law.cohesion.numbers[0]` is -50", LSDCD_ERROR_ARGUMENT},
      {of("glass"), stiff, "`law.rolling.numbers[0]` is -1", LSDCD_ERROR_ARGUMENT},
  };
  for (const auto &row : rows) {
    const auto make = [&] { api::Law::from_material(row.materials, row.law); };
    EXPECT_TRUE(is_refused(row.says, make));
    EXPECT_EQ(code_of(make), row.code) << row.says;
  }
}

// ---- meshes against words ----------------------------------------------------------------------

TEST_F(wall_spec, has_laws_for_types_from_1)
{
  api::WallSpec spec = floor();
  spec.meshes[0].type_laws = {{2, 2, hooke_history(2 * kN)}};
  lsdcd::Wall wall(spec);
  Pile pile;
  pile.type[3] = 0;
  EXPECT_EQ(text_of([&] { pile.go(wall, 1); }), "type[3] is 0, below 1");
}

// Spheres that leave, whose damping would pull.
TEST_F(wall_spec, limits_the_damping_of_all_laws_by_that_of_the_wall)
{
  const auto hooke = [](double damping) {
    return api::Law::classic({"hooke", {1000, 300, damping, 0, 0.5, 0}});
  };
  api::WallSpec spec = floor(hooke(200));
  spec.law.limit_damping = true;
  spec.meshes[0].law = hooke(300);
  spec.meshes[0].type_laws = {{2, 2, hooke(400)}};
  lsdcd::ScriptWall by_words(lsdcd::words("hooke 1000 300 200 0 0.5 0 limit_damping mesh " + file_ +
                                          " device cpu law hooke 1000 300 300 0 0.5 0 law types 2 "
                                          "hooke 1000 300 400 0 0.5 0"));
  api::Wall by_spec(spec);
  Pile one, other;
  for (Pile *pile : {&one, &other})
    for (std::size_t k = 2; k < pile->v.size(); k += 3) pile->v[k] = 0.1;
  const std::vector<double> forces = other.go(by_spec, 1);
  EXPECT_TRUE(any_nonzero(forces));
  EXPECT_EQ(forces, one.go(by_words, 1));
  for (std::size_t k = 2; k < other.force.size(); k += 3) EXPECT_GE(other.force[k], 0);
}

TEST_F(wall_spec, has_the_bits_of_words_for_changes_of_motion)
{
  lsdcd::ScriptWall by_words(words());
  api::Wall by_spec(floor());
  Pile one, other;
  one.go(by_words);
  other.go(by_spec);
  by_words.change(lsdcd::words("motion linear 0 0 0.1"));
  by_spec.set_motion(0, {api::Motion::linear({0, 0, 0.1})});
  EXPECT_EQ(other.go(by_spec), one.go(by_words));
  by_words.change(lsdcd::words("motion none"));
  by_spec.set_motion(0, {});
  EXPECT_EQ(other.go(by_spec), one.go(by_words));
  EXPECT_NE(by_spec.pose(0)[11], 0);
}

std::string bytes_of(const std::string &name)
{
  std::ifstream file(name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_F(wall_spec, writes_the_files_of_words)
{
  const std::string fields[] = {file_ + ".words.vtp", file_ + ".spec.vtp"},
                    stl[] = {file_ + ".words.stl", file_ + ".spec.stl"};
  api::WallSpec spec = floor();
  api::WallMesh &floor = spec.meshes[0];
  floor.fields = fields[1];
  floor.stl = stl[1];
  floor.fields_every = 4;
  floor.stl_every = 3;
  floor.motions = {api::Motion::linear({0, 0, 0.1})};
  floor.wear_factor = 2;
  spec.wear = LSDCD_ARCHARD;
  spec.wear_coefficient = 1e-3;
  spec.hardness = 1e6;
  lsdcd::ScriptWall by_words(
      words("mesh_fields " + fields[0] + " every 4 mesh_stl " + stl[0] +
            " every 3 motion linear 0 0 0.1 wear_factor 2 wear archard 1e-3 1e6"));
  api::Wall by_spec(spec);
  Pile().go(by_words);
  Pile().go(by_spec);
  for (const auto *names : {fields, stl}) {
    EXPECT_FALSE(bytes_of(names[0]).empty()) << names[0];
    EXPECT_EQ(bytes_of(names[1]), bytes_of(names[0])) << names[0];
    for (int k = 0; k < 2; k++) std::remove(names[k].c_str());
  }
  EXPECT_GT(by_spec.totals(0).worn_volume, 0);
  EXPECT_EQ(by_spec.totals(0).worn_volume, by_words.worn(0));
}

TEST_F(wall_spec, means_are_those_of_the_steps)
{
  api::WallSpec spec = floor();
  spec.average_every = 5;
  api::Wall wall(spec);
  Grains grains(1, 2, 0.5);
  grains.step(wall, 1, true);
  double sum = 0;
  for (int step = 1; step <= 10; step++) {
    grains.x[2] = 0.5 - 0.001 * step * step;
    grains.step(wall);
    if (step > 5) sum += wall.totals(0).force[2];
  }
  EXPECT_NE(sum, 0);
  EXPECT_NEAR(wall.totals(0).mean_force[2], sum / 5, 1e-13 * std::fabs(sum));
  EXPECT_EQ(wall.totals(-1).mean_force[2], wall.totals(0).mean_force[2]);
}

// A sphere in the edge of two walls touches both; one beside it touches the floor alone.
TEST_F(wall_spec, gives_each_contact_of_the_last_step)
{
  api::WallSpec spec = floor();
  spec.each_contact = true;
  spec.meshes.emplace_back(*mesh_, "side");
  spec.meshes[1].placement.rotate({0, 1, 0}, 90);    // its normal is along x
  api::Wall wall(spec);
  EXPECT_TRUE(wall.contacts().empty());
  Grains grains;
  grains.add(5, 5, 0.47);
  grains.add(0.48, 1, 0.49);
  grains.step(wall);
  const std::vector<api::WallContact> found = wall.contacts();
  const struct {
    std::ptrdiff_t sphere;
    int mesh;
    Vector force, point;
    double overlap;
  } wanted[] = {{0, 0, {0, 0, 30}, {5, 5, 0}, 0.03},
                {1, 0, {0, 0, 10}, {0.48, 1, 0}, 0.01},
                {1, 1, {20, 0, 0}, {0, 1, 0.49}, 0.02}};
  ASSERT_EQ(found.size(), 3u);
  for (const auto &row : wanted) {
    const auto at = std::find_if(found.begin(), found.end(), [&](const api::WallContact &c) {
      return c.sphere == row.sphere && c.mesh == row.mesh;
    });
    ASSERT_NE(at, found.end());
    // Overlaps are differences of numbers of order one; forces kn times as much; the turn's matrix is rounded.
    EXPECT_NEAR(at->overlap, row.overlap, kRounding);
    for (std::size_t k = 0; k < 3; k++) {
      EXPECT_NEAR(at->force[k], row.force[k], kN * kRounding);
      EXPECT_NEAR(at->point[k], row.point[k], kRounding);
    }
  }
  int spheres[] = {-7, -7};
  lsdcd_wall_contacts few = {};
  few.size = sizeof few;
  few.room = 2;
  few.mesh = spheres;
  EXPECT_EQ(lsdcd_wall_get_contacts(wall.get(), &few), LSDCD_OK);
  EXPECT_EQ(few.contacts, 3u);
  EXPECT_EQ(spheres[0], -7);    // too little room: nothing is written
}

// A sphere of mass 1 that comes down at speed 2.
TEST_F(wall_spec, gives_the_spectrum_of_impacts)
{
  api::WallSpec spec = floor();
  spec.impact_speed = 0.1;
  api::Wall wall(spec);
  Grains grains(1, 2, 0.5);
  grains.v[2] = -2;
  grains.x[2] += 1e-9;
  grains.step(wall);
  EXPECT_TRUE(wall.impacts(0).empty());
  grains.x[2] -= 2e-9;
  grains.step(wall, 2);
  const std::vector<api::ImpactBin> bins = wall.impacts(0);
  ASSERT_EQ(bins.size(), 1u);
  EXPECT_LE(bins[0].begins, 2);
  EXPECT_GT(bins[0].ends, 2);
  EXPECT_EQ(bins[0].impacts, 1);
  EXPECT_NEAR(bins[0].energy, 2, 1e-13);
  double begins = -7;
  lsdcd_wall_impacts few = {};
  few.size = sizeof few;
  few.begins = &begins;
  EXPECT_EQ(lsdcd_wall_get_impacts(wall.get(), 0, &few), LSDCD_OK);
  EXPECT_EQ(few.bins, 1u);
  EXPECT_EQ(begins, -7);    // too little room: nothing is written
}

// ---- wear that moves the wall ----------------------------------------------------------------

api::WallSpec receding(api::WallSpec spec)
{
  spec.wear = LSDCD_ARCHARD;
  spec.wear_coefficient = 1e-3;
  spec.hardness = 1;
  spec.wear_deform_every = 4;
  spec.wear_deform_factor = 3;
  return spec;
}

// A law without a spring that could hold a sphere: all of its way wears.
api::Law slipping()
{
  return api::Law::classic({"hooke", {kN, kT, 0, 0, 0.5, 0}});
}

// A sphere that slides, kept in its place, over one of the two triangles.
Grains slider()
{
  Grains grains(4, -3, 0.49, 2);
  return grains;
}

TEST_F(wall_spec, wear_moves_the_mesh_as_by_words)
{
  const std::string stl[] = {file_ + ".words.stl", file_ + ".spec.stl"};
  api::WallSpec spec = receding(floor());
  spec.meshes[0].stl = stl[1];
  spec.meshes[0].stl_every = 12;
  lsdcd::ScriptWall by_words(
      words("mesh_stl " + stl[0] + " every 12 wear archard 1e-3 1 deform every 4 factor 3"));
  api::Wall by_spec(spec);
  std::vector<double> flat;    // the corners of the file, an STL
  const api::MeshArrays of = mesh_->arrays();
  for (const std::uint32_t vertex : of.welded_vertex)
    flat.insert(flat.end(), of.vertices.begin() + 3 * vertex, of.vertices.begin() + 3 * vertex + 3);
  EXPECT_EQ(by_spec.nodes(0), flat);
  Pile().go(by_words, 13);
  Pile().go(by_spec, 13);
  EXPECT_EQ(bytes_of(stl[1]), bytes_of(stl[0]));
  for (const std::string &name : stl) std::remove(name.c_str());
  EXPECT_GT(by_spec.totals(0).removed_volume, 0);
  EXPECT_EQ(by_spec.totals(0).removed_volume, by_words.removed(0));
  EXPECT_NE(by_spec.nodes(0), flat);
}

// The sphere wears the first 3 steps; in the 4th the corners of its triangle, whose area is 200, go down by the volume
// over the sum of the thirds of areas around them, and that of the volume between is exactly the factor times what has
// worn. A corner of both triangles has twice the area, so it goes half as far. Rounding: of a volume of order 1.
TEST_F(wall_spec, the_worn_volume_is_between_the_old_vertices_and_the_new)
{
  api::Wall wall(receding(floor(slipping())));
  Grains grains = slider();
  grains.step(wall, 1, true);
  grains.step(wall, 3);
  const double worn = wall.totals(0).worn_volume;
  EXPECT_GT(worn, 0);
  EXPECT_EQ(wall.totals(0).removed_volume, 0);
  grains.step(wall, 1);
  const api::MeshArrays of = mesh_->arrays();
  const std::vector<double> at = wall.nodes(0);
  double between = 0;
  for (std::size_t k = 2; k < at.size(); k += 3) between -= 200. / 3 * at[k];    // of each corner
  EXPECT_NEAR(between, 3 * worn, 1e-12 * worn);
  EXPECT_NEAR(wall.totals(0).removed_volume, 3 * worn, 1e-12 * worn);
  EXPECT_EQ(wall.totals(0).held_back_volume, 0);
  for (std::size_t k = 0; k < at.size(); k += 3) {
    const std::size_t vertex = 3 * of.welded_vertex[k / 3];
    const double x = of.vertices[vertex], y = of.vertices[vertex + 1], depth = 3 * worn / 200;
    const double wanted = x < y ? 0 : x > y ? depth : depth / 2;
    EXPECT_NEAR(at[k + 2], -wanted, 1e-12 * depth) << x << " " << y;
  }
}

// Saved after step 5, in which no file is due. The mesh rises, so that each file is another one.
TEST_F(wall_spec, a_saved_wall_writes_the_files_that_are_due)
{
  api::WallSpec spec = floor();
  api::WallMesh &floor = spec.meshes[0];
  floor.motions = {api::Motion::linear({0, 0, 0.1})};
  floor.fields_every = 4;
  floor.stl_every = 3;
  const auto name_of = [&](const char *run, const std::string &end) {
    return file_ + "." + run + "." + end;
  };
  const auto wall_of = [&](const char *run) {
    floor.fields = name_of(run, "*.vtp");
    floor.stl = name_of(run, "*.stl");
    return api::Wall(spec);
  };
  api::Wall whole = wall_of("whole"), begun = wall_of("begun"), again = wall_of("again");
  Grains grains = slider();
  grains.step(whole, 13);
  grains.step(begun, 5);
  again.restore(begun.save());
  grains.step(again, 8);
  for (int step = 0; step <= 13; step++)
    for (const auto &[end, every] : {std::pair(".vtp", 4), std::pair(".stl", 3)}) {
      const std::string file = std::to_string(step) + end,
                        wanted = bytes_of(name_of("whole", file));
      EXPECT_EQ(wanted.empty(), step == 0 || step % every != 0) << file;
      EXPECT_EQ(bytes_of(name_of("again", file)), step > 5 ? wanted : "") << file;
      for (const char *run : {"whole", "begun", "again"}) std::remove(name_of(run, file).c_str());
    }
  for (const char *run : {"whole", "begun", "again"})
    std::remove(name_of(run, "series.pvd").c_str());
}

// Each field is in test_saved_fields. Here: all digits of numbers count, also of rows of tables, which no text of a motion has.
TEST_F(wall_spec, takes_saved_data_of_a_wall_with_the_same_digits_alone)
{
  using Spec = api::WallSpec;
  const api::Mesh other(std::vector<double>{-9, -9, 0, 9, -9, 0, 0, 9, 0}, {0, 1, 2});
  Spec two = floor();
  two.meshes.emplace_back(other, "ramp").placement.move(0, 0, 9);
  two.meshes[1].motions = {api::Motion::linear({0, 0, 1})};
  const std::vector<double> far = {0, 0, 0, 0, 1, 0, 0, 0.5}, near = {0, 0, 0, 0, 1, 0, 0, 0.25};
  const Spec by_table = floor_that_moves(api::Motion::table(far, 4)),
             pushes = floor_that_pushes(2, 0.5);
  const struct {
    const Spec &was;
    std::function<void(Spec &)> change;
    const char *text;    // empty: it may differ
  } rows[] = {
      {two, [](Spec &s) { s.meshes[0].name = "lid"; }, ""},
      {two, [](Spec &s) { s.law.style.numbers[0] *= 1 + 1e-15; }, "the law is hooke/history with "},
      {two, [](Spec &s) { std::swap(s.meshes[0], s.meshes[1]); },
       "the motion of meshes[0] is linear 0 0 1 and was rest"},
      {two,
       [](Spec &s) {
         s.meshes[1].motions = {api::Motion::linear({0, 0, 1 + 1e-15})};
       },
       "the exact motion 'linear 0 0 1' of meshes[1] is 0 0 1.00"},
      {by_table, [](Spec &) {}, ""},
      {by_table, [&](Spec &s) { s.meshes[0].motions = {api::Motion::table(near, 4)}; },
       "the exact motion 'table of rows' of meshes[0] is "},
      {pushes, [](Spec &s) { s.meshes[0].servo->target += 1e-9; },
       "the exact servo 'force z 2 vmax 0.5' of meshes[0] is "}};
  for (const auto &row : rows) {
    Spec changed = row.was;
    row.change(changed);
    lsdcd::Wall was(row.was), is(changed);
    const std::vector<double> saved = was.save();
    const std::string text = text_of([&] { is.restore(saved); });
    EXPECT_EQ(text.empty(), !*row.text) << text << row.text;
    EXPECT_TRUE(has(text, row.text));
  }
  Spec stiff = two;
  stiff.law.style.numbers[0] *= 2;
  lsdcd::Wall wall(two), stiffer(stiff);
  slider().step(wall, 3);
  stiffer.restore(wall.save(), true);
  EXPECT_EQ(stiffer.pose(1), wall.pose(1));
}

// The vertices of a mesh that moves are in the box: lifted by the motion, and lower by the wear.
TEST_F(wall_spec, vertices_that_wear_moves_go_with_the_mesh)
{
  api::WallSpec spec = receding(floor(slipping()));
  spec.meshes[0].posed_by_caller = true;
  api::Wall still(receding(floor(slipping()))), wall(spec);
  api::Pose lifted;
  lifted.position = {0, 0, 1};
  wall.set_pose(0, lifted);
  Grains low = slider(), high = slider();
  high.x[2] += 1;
  low.step(still, 5);
  high.step(wall, 5);
  const std::vector<double> at = wall.nodes(0), below = still.nodes(0);
  EXPECT_LT(below[2] + below[5] + below[8] + below[11], 0);
  for (std::size_t k = 0; k < at.size(); k++)
    EXPECT_NEAR(at[k], below[k] + (k % 3 == 2), 1e-15 * 20) << k;
}

// The mesh is shared: the handle may go first.
TEST_F(wall_spec, shares_meshes_that_are_freed_before_it)
{
  auto mesh = std::make_unique<api::Mesh>(file_);
  api::Wall one(floor_of(hooke_history(), *mesh)), other(floor_of(hooke_history(2 * kN), *mesh));
  mesh.reset();
  Grains grains(0.3, 0.2, 0.49);
  grains.step(one);
  EXPECT_NEAR(grains.force[2], kN * 0.01, kN * kRounding);
  grains.step(other);
  EXPECT_NEAR(grains.force[2], 2 * kN * 0.01, 2 * kN * kRounding);
}

// ---- poses -----------------------------------------------------------------------------------

// Steps of kStep in which the caller poses mesh 0 before each; all that spheres got.
std::vector<double> go_posed(lsdcd::Wall &wall, int n,
                             const std::function<std::optional<api::Pose>(int)> &pose_in)
{
  Pile pile;
  std::vector<double> all;
  for (int k = 1; k <= n; k++) {
    if (const auto pose = pose_in(k)) wall.set_pose(0, *pose);
    pile.force.assign(pile.x.size(), 0);
    pile.torque.assign(pile.x.size(), 0);
    lsdcd_wall_step step = step_of(kStep);
    wall.step(pile.spheres(), step);
    all.insert(all.end(), pile.force.begin(), pile.force.end());
    all.insert(all.end(), pile.torque.begin(), pile.torque.end());
  }
  return all;
}

api::Law with_damping()
{
  return api::Law::classic({"hooke/history", {kN, kT, 20, 10, 0.5, 1}});
}

TEST_F(wall_spec, set_pose_has_the_bits_of_a_linear_motion)
{
  api::WallSpec moved = floor(with_damping()), posed = moved;
  const Vector v = {0.25, -0.5, 1};
  moved.meshes[0].motions = {api::Motion::linear(v)};
  posed.meshes[0].posed_by_caller = true;
  api::Wall by_motion(moved), by_pose(posed);
  const auto wanted = go_posed(by_motion, 50, [](int) { return std::nullopt; });
  EXPECT_TRUE(any_nonzero(wanted));
  EXPECT_EQ(go_posed(by_pose, 50,
                     [&](int k) {
                       api::Pose pose;
                       for (int d = 0; d < 3; d++) pose.position[d] = v[d] * (k * kStep);
                       pose.velocity = v;
                       return pose;
                     }),
            wanted);
  EXPECT_EQ(by_pose.pose(0), by_motion.pose(0));
  EXPECT_EQ(by_pose.totals(0).power, by_motion.totals(0).power);
}

// A turn about an axis through the mesh's origin. Matrices of the two differ by the rounding of sines and of a
// quaternion, 1e-15 with lengths up to 4; forces by that times stiffness, velocities times 4 damping.
TEST_F(wall_spec, set_pose_turns_a_mesh_as_a_rotation_does)
{
  api::WallSpec moved = floor(with_damping()), posed = moved;
  const double period = 2, omega = 2 * std::acos(-1.) / period;
  moved.meshes[0].motions = {api::Motion::rotate({0, 0, 0}, {0, 1, 0}, period)};
  posed.meshes[0].posed_by_caller = true;
  api::Wall by_motion(moved), by_pose(posed);
  const auto wanted = go_posed(by_motion, 50, [](int) { return std::nullopt; });
  const auto found = go_posed(by_pose, 50, [&](int k) {
    const double half = omega * k * kStep / 2;
    api::Pose pose;
    pose.quaternion = {std::cos(half), 0, std::sin(half), 0};
    pose.angular_velocity = {0, omega, 0};
    return pose;
  });
  ASSERT_EQ(found.size(), wanted.size());
  EXPECT_TRUE(any_nonzero(wanted));
  for (std::size_t i = 0; i < found.size(); i++)
    EXPECT_NEAR(found[i], wanted[i], 20 * 4 * 1e-15 * kN) << i;
}

// A sphere whose velocity is that of the plate below it, at the same time, feels no friction; half a step before, the plate below was
// turned by angle = omega dt / 2, and its velocity differs by omega x angle to first order: 10 times that, to a relative angle.
TEST_F(wall_spec, takes_velocities_of_the_time_of_places_in_synchronous_steps)
{
  const double omega = 50, angle = omega * kDt / 2, x = 0.5;
  const api::Motion turns = api::Motion::rotate({0, 0, 0}, {0, 0, 1}, 2 * std::acos(-1.0) / omega);
  for (const bool by_motion : {false, true})
    for (const bool synchronous : {false, true}) {
      api::WallSpec spec = floor(api::Law::classic({"hooke", {kN, 0, 0, 10, 1000, 1}}));
      spec.meshes[0].posed_by_caller = !by_motion;
      if (by_motion) spec.meshes[0].motions = {turns};
      lsdcd::Wall wall(spec);
      api::Pose pose;
      pose.angular_velocity = {0, 0, omega};
      if (!by_motion) wall.set_pose(0, pose);
      Grains grains(x, 0, 0.45);
      grains.v[1] = omega * x;
      lsdcd_wall_step step = step_of();
      step.synchronous = synchronous;
      wall.step(grains.spheres(), step);
      const double slip = synchronous ? 0 : 10 * omega * x * angle;
      EXPECT_NEAR(grains.force[0], slip, slip * angle + 10 * omega * x * kRounding) << by_motion;
      EXPECT_NEAR(grains.force[1], 0, slip * angle + 10 * omega * x * kRounding) << by_motion;
    }
}

TEST_F(wall_spec, refuses_synchronous_steps_beside_a_body)
{
  api::WallSpec spec = floor();
  spec.meshes[0].body = api::RigidBody(1, {0, 0, 0}, {1, 1, 1, 0, 0, 0});
  lsdcd::Wall wall(spec);
  Grains grains(0.3, 0.2, 0.5);
  lsdcd_wall_step step = step_of();
  step.synchronous = 1;
  EXPECT_TRUE(
      begins(text_of([&] { wall.step(grains.spheres(), step); }), "synchronous is 1, and "));
}

TEST_F(wall_spec, rests_where_it_was_placed_until_it_is_posed)
{
  api::WallSpec spec = floor(), resting = spec;
  spec.meshes[0].posed_by_caller = true;
  lsdcd::Wall posed(spec), still(resting);
  const auto nothing = [](int) { return std::nullopt; };
  EXPECT_EQ(go_posed(posed, 5, nothing), go_posed(still, 5, nothing));
  EXPECT_EQ(posed.pose(0), still.pose(0));
}

// ---- nodes -----------------------------------------------------------------------------------

// A plate of four vertices in another order than triangles have them, mirrored and shifted by its placement: the k-th node
// is the k-th vertex of the caller. A fifth is of no triangle.
TEST_F(wall_spec, set_nodes_lifts_a_plate_vertex_by_vertex)
{
  const std::vector<double> vertices = {1, 1, 0, -1, -1, 0, 1, -1, 0, -1, 1, 0, 7, 7, 7};
  const std::vector<std::uint32_t> faces = {1, 2, 0, 1, 0, 3};
  const api::Mesh mesh(vertices, faces);
  api::WallSpec spec = floor_of(api::Law::classic({"hooke", {kN, 0, 20, 0, 0, 1}}), mesh);
  spec.meshes[0].placement.scale(-1, 1, 1).move(0.25, 0, 1);
  spec.meshes[0].nodes_by_caller = true;
  lsdcd::Wall wall(spec);
  std::vector<double> placed = wall.nodes(0);
  ASSERT_EQ(placed.size(), vertices.size());
  EXPECT_TRUE(std::isnan(placed[12]));
  std::fill(placed.begin() + 12, placed.end(), 0);
  for (std::size_t k = 0; k < 12; k += 3) {
    EXPECT_EQ(placed[k], 0.25 - vertices[k]);
    EXPECT_EQ(placed[k + 1], vertices[k + 1]);
    EXPECT_EQ(placed[k + 2], 1);
  }

  // Lifted by 0.01, with a speed of 0.5 towards a sphere of radius 0.5 and mass 2 over the middle of a triangle.
  std::vector<double> at = placed, velocities(at.size(), 0);
  for (std::size_t k = 2; k < at.size(); k += 3) {
    at[k] += 0.0625;
    velocities[k] = 0.5;
  }
  wall.set_nodes(0, at, velocities);
  Grains grains;
  double middle[2] = {0, 0};
  for (int k = 0; k < 3; k++)
    for (int d = 0; d < 2; d++) middle[d] += at[3 * faces[k] + d] / 3;
  grains.add(middle[0], middle[1], 1.5);
  grains.step(wall);
  const double wanted = kN * 0.0625 + 20 * grains.mass[0] * 0.5;
  EXPECT_NEAR(grains.force[2], wanted, kN * kRounding);
  EXPECT_NEAR(wall.totals(0).power, 0.5 * wanted, kN * kRounding);
  const std::vector<double> forces = wall.node_forces(0);
  for (std::uint32_t k = 0; k < 5; k++)
    EXPECT_NEAR(forces[3 * k + 2], k < 3 ? -wanted / 3 : 0, kN * kRounding) << k;
  std::vector<double> there = wall.nodes(0);
  there.resize(12);
  at.resize(12);
  EXPECT_EQ(there, at);
}

// Two triangles of six corners, of which four are two vertices: the first of each two has the force of both.
TEST_F(wall_spec, nodes_that_were_welded_stay_together)
{
  const std::vector<double> corners = {-2, -2, 0, 2, -2, 0, 2, 2, 0, -2, -2, 0, 2, 2, 0, -2, 2, 0};
  const api::Mesh mesh(corners);
  api::WallSpec spec = floor_of(api::Law::classic({"hooke", {kN, 0, 0, 0, 0, 0}}), mesh);
  spec.meshes[0].nodes_by_caller = true;
  lsdcd::Wall wall(spec);
  EXPECT_EQ(wall.nodes(0), corners);
  Grains grains(0, 0, 0.49);    // over the middle of the edge between the two
  grains.step(wall);
  const std::vector<double> forces = wall.node_forces(0);
  const double half = -kN * 0.01 / 2, wanted[6] = {half, 0, half, 0, 0, 0};
  for (int k = 0; k < 6; k++) EXPECT_NEAR(forces[3 * k + 2], wanted[k], kN * kRounding) << k;
  std::vector<double> torn = corners;
  torn[3 * 4 + 2] = 0.1;
  EXPECT_TRUE(
      is_refused("nodes 2 and 4 (from 0) are one vertex", [&] { wall.set_nodes(0, torn); }));
}

TEST_F(wall_spec, refuses_nodes_that_make_no_sense)
{
  api::WallSpec spec = floor();
  lsdcd::Wall still(spec);
  EXPECT_TRUE(is_refused("has no nodes that move: say nodes caller", [&] { still.nodes(0); }));
  spec.meshes[0].nodes_by_caller = true;
  lsdcd::Wall wall(spec);
  std::vector<double> at = wall.nodes(0);
  at[4] = NAN;
  EXPECT_TRUE(is_refused("`positions[4]` is", [&] { wall.set_nodes(0, at); }));
  EXPECT_TRUE(is_refused("there are 3 numbers", [&] { wall.set_nodes(0, {1, 2, 3}); }));
  EXPECT_TRUE(is_refused("its nodes alone move this mesh", [&] { wall.set_motion(0, {}); }));
}

// Hills of 128 triangles, by a side of 8.
api::Mesh hills()
{
  std::vector<double> vertices;
  std::vector<std::uint32_t> faces;
  for (std::uint32_t i = 0; i <= 8; i++)
    for (std::uint32_t j = 0; j <= 8; j++) {
      for (const double x : {i - 4., j - 4., 0.8 * std::sin(2. * i + 3 * j)}) vertices.push_back(x);
      const std::uint32_t k = 9 * i + j;
      if (i < 8 && j < 8)
        for (const std::uint32_t corner : {k, k + 9, k + 10, k, k + 10, k + 1})
          faces.push_back(corner);
    }
  return api::Mesh(vertices, faces);
}

Grains cloud()
{
  Grains grains;
  lsdcd::Random random(5);
  for (int i = 0; i < 300; i++) {
    grains.add(uniform(random, -4, 4), uniform(random, -4, 4), uniform(random, -4, 4));
    grains.radius.back() = uniform(random, 0.2, 0.4);
    for (int k = 0; k < 3; k++) grains.v[3 * i + k] = uniform(random, -1, 1);
  }
  return grains;
}

// Steps of all sizes between 1e-5 and 10 radii, in any order: within the margins of lists and of candidates, past one of
// them, and past both, with spheres far from the mesh that it meets at once. No springs, which a jump would keep. Of one
// mesh bits are equal. Of two a sphere is computed by another sum where it is a candidate of both, which hangs on where
// candidates were chosen: places of size 10 have 20 roundings, times the stiffness.
TEST_F(wall_spec, finds_all_contacts_where_a_pose_jumps)
{
  const api::Mesh mesh = hills();
  lsdcd::Random random(11);
  for (const std::size_t n : {1u, 2u}) {
    api::WallSpec spec = floor_of(api::Law::classic({"hooke", {kN, kT, 20, 10, 0.5, 1}}), mesh);
    if (n > 1) spec.meshes.emplace_back(mesh, "other").placement.move(1, 0, 0.5);
    for (api::WallMesh &m : spec.meshes) m.posed_by_caller = true;
    lsdcd::Wall wall(spec);
    Grains grains = cloud();
    std::vector<api::Pose> poses(n);
    const double limit = n == 1 ? 0 : 20 * 10 * 2.3e-16 * kN;
    double contacts = 0;
    for (int k = 0; k < 60; k++) {
      const double size = 0.4 * std::pow(10., uniform(random, -5, 1));
      lsdcd::Wall fresh(spec);
      for (std::size_t m = 0; m < n; m++) {
        api::Pose &pose = poses[m];
        double length = 0;
        for (double &x : pose.position) x = std::fmod(x + uniform(random, -size, size), 4.);
        for (double &q : pose.quaternion) q += uniform(random, -size, size);
        for (const double q : pose.quaternion) length += q * q;
        for (double &q : pose.quaternion) q /= std::sqrt(length);
        for (double &v : pose.velocity) v = uniform(random, -1, 1);
        for (double &w : pose.angular_velocity) w = uniform(random, -1, 1);
        wall.set_pose(static_cast<int>(m), pose);
        fresh.set_pose(static_cast<int>(m), pose);
      }
      Grains same = grains;
      grains.step(wall);
      same.step(fresh);
      for (std::size_t i = 0; i < grains.force.size(); i++) {
        ASSERT_LE(std::fabs(grains.force[i] - same.force[i]), limit) << k << ", by " << size;
        ASSERT_LE(std::fabs(grains.torque[i] - same.torque[i]), limit) << k << ", by " << size;
      }
      contacts += wall.totals(-1).contacts;
    }
    EXPECT_GT(contacts, 60 * 20);
  }
}

// ---- several processes -----------------------------------------------------------------------

TEST_F(wall_spec, refuses_poses_that_differ_between_processes)
{
  api::WallSpec spec = floor();
  spec.meshes[0].posed_by_caller = true;
  lsdcd::on_processes(2, [&](lsdcd::FakeHost &host) {
    const Process process(host);
    lsdcd::Wall wall(spec, &process.options);
    Grains mine(0, 0, 0.49);
    api::Pose pose;
    pose.position = {host.rank() == 0 ? 0. : -0., 0, 0.01};    // which are equal
    wall.set_pose(0, pose);
    mine.step(wall);
    pose.position = {0, 0, host.rank() == 0 ? 0.01 : 0.02};
    wall.set_pose(0, pose);
    EXPECT_TRUE(begins(text_of([&] { mine.step(wall); }),
                       "poses given by lsdcd_wall_set_pose() differ between the processes"));
  });
}

// ---- wrong fields ----------------------------------------------------------------------------

// The error of a spec after `spoil`.
class Wrong {
 public:
  explicit Wrong(const api::Mesh &mesh)
  {
    law = {};
    law.size = sizeof law;
    law.style = {"hooke/history", {1000, 300, 0, 0, 0.5, 0}};
    granular = {};
    granular.size = sizeof granular;
    granular.normal = {"hertz", {1000, 0.5}};
    granular.tangential = {"linear_history", {300, 1, 0.5}};
    types = {sizeof types, 1, 2, &law};
    motion = {};
    motion.size = sizeof motion;
    body = {};
    body.size = sizeof body;
    for (lsdcd_wall_mesh &m : meshes) {
      m = {};
      m.size = sizeof m;
      m.mesh = mesh.get();
    }
    meshes[1].placement[0] = meshes[1].placement[5] = meshes[1].placement[10] = 1;
    meshes[1].placement[11] = -3;
    spec = {};
    spec.size = sizeof spec;
    spec.law = &law;
    spec.meshes = meshes;
    spec.n_meshes = 2;
  }
  std::string text() const
  {
    lsdcd_wall *wall = nullptr;
    const int code = lsdcd_wall_from_spec(&spec, nullptr, &wall);
    if (code == LSDCD_OK) {
      lsdcd_wall_free(wall);
      return "";
    }
    EXPECT_EQ(code, LSDCD_ERROR_ARGUMENT) << lsdcd_last_error();
    return lsdcd_last_error();
  }

  lsdcd_law law, granular;
  lsdcd_type_law types;
  lsdcd_motion motion;
  lsdcd_rigid_body body;
  lsdcd_wall_mesh meshes[2];
  lsdcd_wall_spec spec;
};

// A spec has the address of its meshes alone.
static_assert(std::is_constructible_v<api::WallMesh, api::Mesh &>);
static_assert(!std::is_constructible_v<api::WallMesh, api::Mesh>);
static_assert(!std::is_constructible_v<api::WallMesh, const api::Mesh, const char *>);

TEST_F(wall_spec, gives_a_sub_model_all_of_its_numbers)
{
  using api::kDerived;
  api::Law rolls = hooke_history(),
           turns = api::Law::granular({"hooke", {1, 0}}, {"mindlin", {1, 1, 0.5}});
  rolls.rolling = {"cdt", {0.1, 0}};
  turns.twisting = {"sds", {1, 1}};
  const struct {
    api::Law law;
    const char *text;
  } rows[] = {
      {api::Law::classic({"hooke/history", {1e4, 5e3, 20, kDerived, 0.5, 1}}), ""},
      {api::Law::classic({"hooke/history", {1e4, 5e3, 20, 0.5, 1}}),
       "'hooke/history' is given 5 numbers, and has 6: kn kt gamman gammat xmu dampflag"},
      {api::Law::classic({"hooke/history", {1e4, 5e3, 20, 0, 0.5, 1, 0}}), "is given 7 numbers"},
      {api::Law::classic({"hooke", {1e4}}), "is given 1 number, and has 6"},
      {api::Law::granular({"hertz", {1e4}}, {"mindlin", {1, 1, 0.5}}), "has 2: kn eta|e"},
      {api::Law::granular({"hertz", {1e4, 0}}, {"linear_history", {1, 0.5}}),
       "has 3: kt xgammat mu"},
      {rolls, "'cdt' is given 2 numbers, and has 1: MU"},
      {turns, "'sds' is given 2 numbers, and has 3: k gamma mu"},
      {api::Law::classic({"hook", {1e4}}), "hooke"},
  };
  for (const auto &row : rows) {
    const std::string text = text_of([&] { lsdcd::Wall wall(floor(row.law)); });
    EXPECT_TRUE(has(text, row.text));
    EXPECT_EQ(text.empty(), !*row.text) << text;
  }
}

TEST_F(wall_spec, names_the_field_its_value_and_the_remedy)
{
  const double nan = std::nan("");
  const auto with_granular = [](Wrong &w) -> lsdcd_law & {
    w.spec.law = &w.granular;
    return w.granular;
  };
  const auto with_motion = [](Wrong &w) -> lsdcd_motion & {
    w.meshes[0].motions = &w.motion;
    w.meshes[0].n_motions = 1;
    return w.motion;
  };
  const double late[] = {0, 0, 0, 0, 1, 0,
                         0, 1, 1, 0, 0, 2};    // the last two rows are of one time
  const auto with_table = [&](Wrong &w) -> lsdcd_motion & {
    lsdcd_motion &m = with_motion(w);
    m.kind = LSDCD_TABLE;
    m.rows = late;
    m.n_rows = 3;
    m.columns = 4;
    return m;
  };
  const auto with_types = [](Wrong &w) -> lsdcd_type_law & {
    w.meshes[1].type_laws = &w.types;
    w.meshes[1].n_type_laws = 1;
    return w.types;
  };
  const struct {
    std::function<void(Wrong &)> spoil;
    const char *text;
  } rows[] = {
      {[&](Wrong &w) { w.spec.size = 8; }, "`lsdcd_wall_spec`: size is 8, and should be sizeof("},
      {[&](Wrong &w) { w.spec.law = nullptr; }, "`law` is null"},
      {[&](Wrong &w) { w.law.size = 4; }, "`law`: size is 4, and should be sizeof(lsdcd_law)"},
      {[&](Wrong &w) { w.law.style.name = nullptr; },
       "`law.style.name` is null: give a style, hooke|"},
      {[&](Wrong &w) { w.law.style.numbers[6] = 7; },
       "`law.style.numbers[6]` is 7: \"hooke/history\" has 6 numbers, and the others stay 0"},
      {[&](Wrong &w) { w.law.rolling.numbers[0] = 1; },
       "`law.rolling.numbers[0]` is 1: a sub-model without a name has no numbers"},
      {[&](Wrong &w) { w.law.limit_damping = 2; }, "`law.limit_damping` is 2: it is 0 or 1"},
      {[&](Wrong &w) { with_granular(w).tangential.name = nullptr; },
       "`law.tangential.name` is null: beside a normal sub-model give one of linear_nohistory|"},
      {[&](Wrong &w) { w.law.normal.name = "hertz"; },
       "`law.normal.name` is \"hertz\": there is the style \"hooke/history\", too; give one"},
      {[&](Wrong &w) {
         with_granular(w).tangential = {"mindlin", {LSDCD_DERIVED, 1, 0.5}};
       },
       "`law.tangential.numbers[0]` is LSDCD_DERIVED: kt of \"mindlin\" is derived from E and nu"},
      {[&](Wrong &w) { w.spec.meshes = nullptr; }, "`meshes` is null: give an array of 2"},
      {[&](Wrong &w) { w.meshes[0].size = 16; }, "`meshes[0]`: size is 16, and should be sizeof("},
      {[&](Wrong &w) { w.meshes[1].size = 16; }, "`meshes[1]`: size is 16, and should be sizeof("},
      {[&](Wrong &w) { w.meshes[1].mesh = nullptr; }, "`meshes[1].mesh` is null: give a mesh"},
      {[&](Wrong &w) { with_types(w).law = nullptr; }, "`meshes[1].type_laws[0].law` is null"},
      {[&](Wrong &w) { w.meshes[0].posed_by_caller = 3; },
       "`meshes[0].posed_by_caller` is 3: it is 0 or 1"},
      {[](Wrong &w) {
         w.meshes[0].body = &w.body;
         w.body.density = 1;
         w.body.joint = 5;
       },
       "`meshes[0].body.joint` is 5: it is LSDCD_FREE"},
      {[&](Wrong &w) { with_motion(w).kind = 7; },
       "`meshes[0].motions[0].kind` is 7: it is LSDCD_LINEAR"},
      {[&](Wrong &w) { with_motion(w).angle = 1; },
       "`meshes[0].motions[0].angle` is 1: LSDCD_LINEAR does not use it"},
      {[&](Wrong &w) { with_motion(w).rows = &nan; },
       "`meshes[0].motions[0].rows` is an array: LSDCD_LINEAR does not use it"},
      {[&](Wrong &w) { with_motion(w).repeats = 1; },
       "`meshes[0].motions[0].repeats` is 1: LSDCD_LINEAR does not use it"},
      {[&](Wrong &w) { with_motion(w).degrees = 1; },
       "`meshes[0].motions[0].degrees` is 1: LSDCD_LINEAR does not use it"},
      {[&](Wrong &w) { with_motion(w).file = "arm.txt"; },
       "`meshes[0].motions[0].file` is \"arm.txt\": LSDCD_LINEAR does not use it"},
      {[&](Wrong &w) { with_table(w).file = "arm.txt"; },
       "`meshes[0].motions[0].rows` is an array: a table of a file does not use it"},
      {[&](Wrong &w) { with_table(w).n_rows = 0; }, "`meshes[0].motions[0].n_rows` is 0: give two"},
      {[&](Wrong &w) { with_table(w).rows = nullptr; },
       "`meshes[0].motions[0].rows` is null: give an array of 3"},
      {[&](Wrong &w) { with_table(w).columns = 9; },
       "`meshes[0].motions[0].columns` is 9: it is 2, 4, 5, 7 or 8"},
      {[&](Wrong &w) { with_table(w).period = 1; },
       "`meshes[0].motions[0].period` is 1: LSDCD_TABLE does not use it"},
      {[&](Wrong &w) { with_motion(w).period = 1; },
       "`meshes[0].motions[0].period` is 1: LSDCD_LINEAR does not use it"},
      {[&](Wrong &w) { w.meshes[1].stl_every = 3; },
       "`meshes[1].stl_every` is 3: `meshes[1].stl` has no file"},
      {[&](Wrong &w) { w.spec.corner = 2; }, "`corner` is 2: it is LSDCD_BLEND or LSDCD_SUM"},
      {[&](Wrong &w) { w.spec.side = -1; }, "`side` is -1: it is LSDCD_BOTH_SIDES"},
      {[&](Wrong &w) { w.spec.device = 3; },
       "`device` is 3: it is LSDCD_CPU, LSDCD_CUDA or LSDCD_AUTO"},
      {[&](Wrong &w) { w.spec.each_contact = 2; }, "`each_contact` is 2: it is 0 or 1"},
      {[&](Wrong &w) { w.spec.wear_deform_every = -1; },
       "`wear_deform_every` is -1: it is a number of steps"},
      {[&](Wrong &w) { w.spec.wear_coefficient = 1; },
       "`wear_coefficient` is 1: LSDCD_NO_WEAR does not use it"},
      {[&](Wrong &w) { w.spec.wear_deform_factor = 2; },
       "`wear_deform_factor` is 2: a wall without wear_deform_every does not use it"},
      {[&](Wrong &w) {
         w.spec.wear = LSDCD_FINNIE;
         w.spec.wear_deform_every = 10;
         w.spec.wear_deform_factor = -2;
       },
       "`wear_deform_factor` is -2: it is above 0"},
  };
  EXPECT_EQ(Wrong(*mesh_).text(), "");
  for (const auto &row : rows) {
    Wrong wrong(*mesh_);
    row.spoil(wrong);
    EXPECT_TRUE(begins(wrong.text(), row.text));
  }
}

TEST_F(wall_spec, writes_no_file_over_that_of_a_mesh)
{
  const std::string before = bytes_of(file_), folder = testing::TempDir();
  const api::Mesh corners(std::vector<double>{-9, -9, 0, 9, -9, 0, 0, 9, 0});
  for (const std::string &name : {file_, folder + "/./" + file_.substr(folder.size())}) {
    Wrong wrong(*mesh_);
    wrong.meshes[1].mesh = corners.get();
    wrong.meshes[1].stl = name.c_str();
    wrong.meshes[1].stl_every = 1;
    EXPECT_TRUE(lsdcd::says(wrong.text(),
                            {"in 'mesh_stl', '" + name + "' is ",
                             "the mesh file that `meshes[0].mesh` reads: name another file"}));
    wrong.meshes[0].mesh = corners.get();
    EXPECT_EQ(wrong.text(), "");
  }
  EXPECT_EQ(bytes_of(file_), before);
}

TEST_F(wall_spec, writes_no_series_over_the_file_of_a_mesh)
{
  const std::string folder = testing::TempDir(), series = folder + "series_*.stl";
  std::filesystem::copy_file(file_, folder + "series_30.stl",
                             std::filesystem::copy_options::overwrite_existing);
  const api::Mesh mesh(folder + "series_30.stl");
  Wrong wrong(mesh);
  wrong.meshes[0].stl = series.c_str();
  wrong.meshes[0].stl_every = 10;
  EXPECT_TRUE(
      lsdcd::says(wrong.text(), {"in 'mesh_stl', '" + series + "' is ", "name another file"}));
  wrong.meshes[0].stl_every = 20;    // it writes no step 30
  EXPECT_EQ(wrong.text(), "");
}

// A sphere with a spring at its limit slides at the speed 2 with the force mu kn 0.03 = 15, one that is lifted has left what its spring held.
TEST_F(wall_spec, contacts_tell_what_they_dissipate)
{
  api::WallSpec spec = floor();
  spec.each_contact = spec.energy = true;
  api::Wall wall(spec);
  Grains grains(5, 5, 0.47, 2);
  grains.add(1, 1, 0.47);
  grains.v[3] = 2;
  for (int step = 0; step < 100; step++) {
    for (const std::size_t i : {0, 3}) grains.x[i] += 2 * kDt;
    if (step == 99) grains.x[5] = 0.51;
    grains.step(wall);
  }
  const std::vector<api::WallContact> found = wall.contacts();
  const lsdcd_wall_totals totals = wall.totals(0);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(totals.contacts, 1);
  EXPECT_EQ(found[0].sphere, 0);
  EXPECT_FALSE(found[0].has_ended);
  EXPECT_NEAR(found[0].dissipated_power[1], 30, 30 * kRounding);
  EXPECT_EQ(found[1].sphere, 1);
  EXPECT_TRUE(found[1].has_ended);
  EXPECT_EQ(found[1].force, (Vector{0, 0, 0}));
  EXPECT_NEAR(found[1].point[0], grains.x[3] - 2 * kDt, kRounding);
  for (std::size_t cause = 0; cause < 5; cause++) {
    EXPECT_NEAR(found[0].dissipated_power[cause] + found[1].dissipated_power[cause],
                totals.dissipated_power[cause], 100 * kRounding);
    EXPECT_NEAR(found[0].dissipated[cause] + found[1].dissipated[cause], totals.dissipated[cause],
                10 * kRounding);
  }
}

// ---- bodies ----------------------------------------------------------------------------------

// A sphere at rest pushes a plate of mass 2 down.
TEST_F(wall_spec, a_body_tells_where_it_is_and_its_energy)
{
  api::WallSpec spec = floor();
  api::RigidBody body(2, {0, 0, 0}, {1, 1, 2, 0, 0, 0});
  body.slider({0, 0, 2});
  body.stiffness = 30;
  body.damping = 0.5;
  body.rest = 0.1;
  body.lo = -1;
  body.hi = 0.5;
  body.motor = 0.3;
  body.load[2] = -0.7;
  body.gravity[2] = -9.81;
  body.velocity[2] = 0.2;
  spec.meshes[0].body = body;
  api::Wall wall(spec);
  Grains grains(0.3, 0.2, 0.49);
  for (int k = 0; k < 20; k++) grains.step(wall);
  const api::BodyState a = wall.body(0);
  EXPECT_LT(a.velocity[2], 0.2);
  EXPECT_NEAR(a.coordinate, a.centre[2], 1e-15);
  EXPECT_EQ(a.quaternion[0], 1);
  EXPECT_NEAR(a.energy,
              0.5 * 2 * a.velocity[2] * a.velocity[2] + 0.5 * 30 * std::pow(a.coordinate - 0.1, 2),
              1e-12);
}

TEST_F(wall_spec, a_body_tells_the_forces_of_its_stop_and_joint)
{
  api::WallSpec spec = floor();
  api::RigidBody body(2, {0, 0, 0}, {1, 1, 2, 0, 0, 0});
  body.slider({0, 0, 1});
  body.lo = 0;
  body.hi = 1;
  body.load[2] = -4;
  body.load[0] = 3;
  body.moment[1] = -2;
  spec.meshes[0].body = body;
  api::Wall wall(spec);
  Grains grains(0.3, 0.2, 5);
  for (int k = 0; k < 10; k++) grains.step(wall);
  const api::BodyState state = wall.body(0);
  EXPECT_EQ(state.stop_force, 4);
  EXPECT_EQ(state.energy, 0);
  // The joint bears what the body may not follow.
  EXPECT_EQ(state.reaction_force[0], -3);
  EXPECT_EQ(state.reaction_torque[1], 2);
}

TEST_F(wall_spec, refuses_poses_that_are_none)
{
  api::WallSpec spec = floor();
  spec.meshes[0].posed_by_caller = true;
  lsdcd::Wall wall(spec);
  const struct {
    std::function<void(api::Pose &)> spoil;
    const char *text;
  } rows[] = {
      {[](api::Pose &p) { p.position[1] = NAN; }, "`position[1]` is nan: give a finite number"},
      {[](api::Pose &p) { p.velocity[2] = HUGE_VAL; },
       "`velocity[2]` is inf: give a finite number"},
      {[](api::Pose &p) { p.angular_velocity[0] = -HUGE_VAL; },
       "`angular_velocity[0]` is -inf: give a finite number"},
      {[](api::Pose &p) { p.quaternion[3] = NAN; }, "`quaternion[3]` is nan: give a finite number"},
      {[](api::Pose &p) { p.quaternion[0] = 1.01; },
       "the pose's quaternion has the length 1.01: give a unit one, w x y z"},
  };
  for (const auto &row : rows) {
    api::Pose pose;
    row.spoil(pose);
    EXPECT_EQ(text_of([&] { wall.set_pose(0, pose); }), row.text);
    EXPECT_EQ(code_of([&] { wall.set_pose(0, pose); }), LSDCD_ERROR_ARGUMENT);
  }
  EXPECT_TRUE(
      is_refused("mesh 0, 'floor', is posed by the caller", [&] { wall.set_motion(0, {}); }));
}

// In C: pointers that are null, and the facts of sub-models.
TEST_F(wall_spec, takes_null_for_what_is_not_given)
{
  api::WallSpec spec = floor();
  spec.meshes[0].posed_by_caller = true;
  lsdcd::Wall wall(spec);
  const double up[3] = {0, 0, 0.02};
  ASSERT_EQ(lsdcd_wall_set_pose(wall.get(), 0, up, nullptr, nullptr, nullptr), LSDCD_OK);
  Grains grains(1, 0, 0.5);
  grains.step(wall);
  const lsdcd_wall_totals totals = wall.totals(0);
  EXPECT_NEAR(totals.force[2], -kN * 0.02, kN * kRounding);
  EXPECT_NEAR(totals.torque[1], kN * 0.02, kN * kRounding);    // about the origin
  ASSERT_EQ(lsdcd_wall_set_pose(wall.get(), 0, nullptr, nullptr, nullptr, nullptr), LSDCD_OK);
  grains.step(wall);
  EXPECT_EQ(grains.force[2], 0);
  lsdcd_sub_model_facts facts = {};
  EXPECT_EQ(lsdcd_sub_model_get_facts(0, &facts), LSDCD_ERROR_ARGUMENT);
  facts.size = sizeof facts;
  EXPECT_EQ(lsdcd_sub_model_get_facts(100000, &facts), LSDCD_ERROR_ARGUMENT);
}

}    // namespace
}    // namespace test_library_wall_spec
