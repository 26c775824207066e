// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Walls by words: against the wall of a script, bit for bit, and in closed form; files, saved states, poses, nodes and bodies; values that make no
// sense. Words against LAMMPS are in test_words.py.
#include "floor_and_grains.h"
#include "process.h"
#include "support/fake_host.h"
#include "support/random.h"
#include "support/script_wall.h"
#include "support/temp_dir.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace test_library_words {
namespace {

using lsdcd::content;
using lsdcd::uniform;
using Vector = std::array<double, 3>;

// A power of two, so that times and places are sums without rounding.
constexpr double kStep = 0x1p-10;

// A law without a spring that could hold a sphere: all of its way wears.
const std::string kSlipping = "hooke 1000 300 0 0 0.5 0 mesh $floor ",
                  kRecedes = "wear archard 1e-3 1 deform every 4 factor 3 ";

class library_words : public FloorTest {
 protected:
  const lsdcd::TempDir folder_;

  // $floor in the words is the floor, beside other values.
  lsdcd::Wall wall_of(const std::string &words, lsdcd::Values values = {}) const
  {
    if (has(words, "$floor")) values.emplace_back("floor", *mesh_);
    return lsdcd::Wall(words, values);
  }
  // The wall of a script. `words` follow kFloorWords, in which it has the file of the floor.
  lsdcd::ScriptWall script_wall(const std::string &words = "") const
  {
    return script_of(kFloorWords + words);
  }
  lsdcd::ScriptWall script_of(const std::string &words, const std::string &units = "si") const
  {
    std::vector<std::string> all = lsdcd::words(words + " device cpu");
    std::replace(all.begin(), all.end(), std::string("$floor"), file_);
    return lsdcd::ScriptWall(all, units);
  }
};

// Spheres of three types that press, slide and turn on the floor, over its inner edge, too.
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
  return std::any_of(numbers.begin(), numbers.end(), [](double x) { return x != 0; });
}

// A sphere that slides, kept in its place, over one of the two triangles.
Grains slider()
{
  return Grains(4, -3, 0.49, 2);
}

// ---- the wall of a script --------------------------------------------------------------------

// In the units of the program, which are those of the script.
TEST_F(library_words, of_materials_have_the_bits_of_a_script)
{
  const std::string file = folder_.write("some.lsdcd", "units si\n"
                                                       "material glass\n"
                                                       "  youngs_modulus 5e4 Pa\n"
                                                       "  poissons_ratio 0.23 1\n"
                                                       "  surface_energy 0.5 J/m2\n"
                                                       "  thermal_conductivity 1.7 W/m/K\n"
                                                       "material steel\n"
                                                       "  youngs_modulus 2e5 Pa\n"
                                                       "  poissons_ratio 0.3 1\n"
                                                       "  surface_energy 0.8 J/m2\n"
                                                       "pair glass glass\n"
                                                       "  restitution 0.9 1\n"
                                                       "  sliding_friction 0.092 1\n"
                                                       "pair glass steel\n"
                                                       "  sliding_friction 0.2 1\n");
  const struct {
    std::string begin, end;    // around the file
    const char *units = "si";
  } rows[] = {
      {"granular material", "glass mesh $floor"},
      {"granular material", "glass mesh $floor", "cgs"},
      {"granular material", "glass on steel with steel youngs_modulus 1e5 restitution 0.8 "
                            "mesh $floor"},
      {"granular jkr material", "glass on steel mesh $floor"},
      {"granular material", "glass tangential mindlin NULL 0.5 NULL damping tsuji rolling sds 1e4 "
                            "1 0.1 limit_damping mesh $floor"},
      {"granular material", "glass heat radius NULL mesh $floor temperature 350"},
      {"granular material", "glass cohesion sjkr 50 mesh $floor"},
  };
  for (const auto &row : rows) {
    lsdcd::WallOptions options;
    options.units = row.units;
    lsdcd::Wall wall(row.begin + " $file " + row.end, {{"file", file}, {"floor", *mesh_}},
                     &options);
    lsdcd::ScriptWall script = script_of(row.begin + " " + file + " " + row.end, row.units);
    const std::vector<double> wanted = Pile().go(script);
    EXPECT_TRUE(any_nonzero(wanted)) << row.end;
    EXPECT_EQ(Pile().go(wall), wanted) << row.end << ", " << row.units;
  }
}

TEST_F(library_words, changes_of_motion_have_the_bits_of_a_script)
{
  lsdcd::ScriptWall script = script_wall();
  lsdcd::Wall wall = floor_wall();
  Pile one, other;
  one.go(script);
  other.go(wall);
  for (const char *change : {"motion linear 0 0 0.1", "motion none"}) {
    script.change(lsdcd::words(change));
    wall.change(change);
    EXPECT_EQ(other.go(wall), one.go(script)) << change;
  }
  EXPECT_NE(wall.pose(0)[11], 0);
}

TEST_F(library_words, write_the_files_of_a_script)
{
  const std::string moves = " every 3 motion linear 0 0 0.1 wear_factor 2 wear archard 1e-3 1e6";
  const auto file = [&](const char *name) { return folder_.path(name); };
  lsdcd::ScriptWall script = script_wall("mesh_fields " + file("script.vtp") +
                                         " every 4 mesh_stl " + file("script.stl") + moves);
  lsdcd::Wall wall = wall_of(kFloorWords + "mesh_fields $fields every 4 mesh_stl $stl" + moves,
                             {{"fields", file("wall.vtp")}, {"stl", file("wall.stl")}});
  Pile().go(script);
  Pile().go(wall);
  for (const std::string end : {".vtp", ".stl"}) {
    const std::string wanted = content(folder_.path("script" + end));
    EXPECT_FALSE(wanted.empty()) << end;
    EXPECT_EQ(content(folder_.path("wall" + end)), wanted) << end;
  }
}

TEST_F(library_words, wear_moves_a_mesh_as_in_a_script)
{
  lsdcd::ScriptWall script =
      script_wall(kRecedes + "mesh_stl " + folder_.path("script.stl") + " every 12");
  lsdcd::Wall wall = wall_of(kFloorWords + kRecedes + "mesh_stl $stl every 12",
                             {{"stl", folder_.path("wall.stl")}});
  std::vector<double> flat;    // the corners of the file, an STL
  const api::MeshArrays of = mesh_->arrays();
  for (const std::uint32_t vertex : of.welded_vertex)
    flat.insert(flat.end(), of.vertices.begin() + 3 * vertex, of.vertices.begin() + 3 * vertex + 3);
  EXPECT_EQ(wall.nodes(0), flat);
  Pile().go(script, 13);
  Pile().go(wall, 13);
  EXPECT_FALSE(content(folder_.path("wall.stl")).empty());
  EXPECT_EQ(content(folder_.path("wall.stl")), content(folder_.path("script.stl")));
  EXPECT_EQ(wall.totals(0).worn_volume, script.worn(0));
  EXPECT_GT(wall.totals(0).removed_volume, 0);
  EXPECT_EQ(wall.totals(0).removed_volume, script.removed(0));
  EXPECT_NE(wall.nodes(0), flat);
}

// ---- values ----------------------------------------------------------------------------------

TEST_F(library_words, share_a_mesh_that_is_freed_before_the_wall)
{
  auto mesh = std::make_unique<api::Mesh>(file_);
  lsdcd::Wall one(kFloorWords, {{"floor", *mesh}}),
      other("hooke/history 2000 300 0 0 0.5 0 mesh $floor", {{"floor", *mesh}});
  mesh.reset();
  Grains grains(0.3, 0.2, 0.49);
  grains.step(one);
  EXPECT_NEAR(grains.force[2], kN * 0.01, kN * kRounding);
  grains.step(other);
  EXPECT_NEAR(grains.force[2], 2 * kN * 0.01, 2 * kN * kRounding);
}

TEST_F(library_words, take_a_mesh_that_is_made_for_them)
{
  lsdcd::Wall wall(kFloorWords, {{"floor", api::Mesh(file_)}});
  Grains grains(0.3, 0.2, 0.49);
  grains.step(wall);
  EXPECT_NEAR(grains.force[2], kN * 0.01, kN * kRounding);
}

TEST_F(library_words, name_a_value_that_makes_no_sense)
{
  const double numbers[] = {0, 0, 0, 0, 1};
  const auto rows_of = [&](std::size_t n, int columns) {
    return lsdcd_value{"rows", LSDCD_VALUE_ROWS, nullptr, numbers, n, columns, nullptr};
  };
  const struct {
    lsdcd_value value;
    const char *text;
  } rows[] = {
      {{"law", LSDCD_VALUE_NUMBERS, nullptr, nullptr, 6, 0, nullptr},
       "`values[1].numbers` is null: give an array of 6 numbers"},
      {{"file", LSDCD_VALUE_TEXT, nullptr, nullptr, 0, 0, nullptr},
       "`values[1].text` is null: give a text"},
      {{"file", LSDCD_VALUE_TEXT, nullptr, nullptr, 0, 0, "$law"},
       "the value 'file': a text does not begin with $"},
      {rows_of(5, 0), "`values[1].columns` is 0: it is 1 or more"},
      {rows_of(5, 2), "`values[1].columns` is 2: it is 1 or more"},
      {rows_of(0, 2), "the value 'rows' has no numbers"},
      {{"$law", LSDCD_VALUE_NUMBERS, nullptr, numbers, 1, 0, nullptr},
       "the value '$law': a name has letters, digits and _ alone, and no $"},
      {{"floor", LSDCD_VALUE_NUMBERS, nullptr, numbers, 1, 0, nullptr},
       "there are two values 'floor'"},
  };
  for (const auto &row : rows) {
    const lsdcd_value values[] = {{"floor", LSDCD_VALUE_MESH, mesh_->get(), nullptr, 0, 0, nullptr},
                                  row.value};
    EXPECT_EQ(lsdcd_wall_check(kFloorWords.c_str(), values, 2, nullptr), LSDCD_ERROR_ARGUMENT);
    EXPECT_TRUE(begins(lsdcd_last_error(), row.text));
  }
}

TEST_F(library_words, numbers_of_a_law_are_those_that_it_has)
{
  const struct {
    const char *style;
    std::vector<double> numbers;
    const char *text;
  } rows[] = {
      {"hooke/history", {1e4, 5e3, 20, 0.5, 1}, "dampflag must be a number, not 'mesh'"},
      {"hooke/history",
       {1e4, 5e3, 20, 0, 0.5, 1, 0},
       "in 'hooke/history', the number '0' ($law, number 7) is one more than expected"},
      {"granular hertz",
       {2000, 20, 5},
       "in 'granular hertz', the number '5' ($law, number 3) is one more than expected"},
      {"hooke/history 1e4 5e3 20 0 0.5 1 mesh $floor rolling cdt",
       {0.1, 0.2},
       "in 'rolling', the number '0.2' ($law, number 2) is one more than expected"},
      {"hooke/history 1e4 5e3 20 0 0.5 1 mesh $floor weld",
       {1, 2},
       "'2' ($law, number 2) is not a keyword"},
      {"hooke/history", {-1e4, 5e3, 20, 0, 0.5, 1}, "kn = -10000 ($law, number 1) is out of range"},
      {"hooke/history",
       {1e4, 5e3, NAN, 0, 0.5, 1},
       "gamman must be a number, not 'NULL' ($law, number 3)"},
      {"hooke/history 1e4 5e3 20 0 0.5", {7}, "dampflag = 7 ($law) is out of range"},
      {"granular hertz 1e4 0 tangential mindlin",
       {NAN, 1, 0.5},
       "kt can be NULL only where the normal sub-model has E and nu, not with 'hertz'"},
  };
  for (const auto &row : rows)
    EXPECT_TRUE(is_refused(row.text, [&] {
      lsdcd::Wall::check(row.style + std::string(" $law mesh $floor"),
                         {{"law", row.numbers}, {"floor", *mesh_}});
    }));
}

TEST_F(library_words, wear_that_moves_a_mesh_needs_steps_and_a_factor_above_0)
{
  const std::string words = kFloorWords + "wear finnie 1 deform every ";
  for (const auto &[more, text] : {std::pair("0", "in 'wear', N = 0 is out of range"),
                                   std::pair("10 factor -2", "in 'wear', F = -2 is out of range")})
    EXPECT_TRUE(is_refused(text, [&, end = more] { wall_of(words + end); }));
}

// Two meshes of one file have its name; no call means one of them by it.
TEST_F(library_words, do_not_say_which_of_two_meshes_with_one_name)
{
  lsdcd::Wall wall("hooke 1000 300 0 0 0.5 0 mesh $file mesh $file move 0 0 3", {{"file", file_}});
  EXPECT_TRUE(is_refused("several meshes are called '" + file_ + "': give them names",
                         [&] { wall.mesh(file_); }));
  EXPECT_TRUE(is_refused("meshes 1 and 2 are called so", [&] {
    wall.change("mesh $file motion none", {{"file", file_}});
  }));
}

TEST_F(library_words, laws_of_types_need_types_from_1)
{
  lsdcd::Wall wall = floor_wall("law types 2 hooke/history 2000 300 0 0 0.5 0");
  Pile pile;
  pile.type[3] = 0;
  EXPECT_EQ(text_of([&] { pile.go(wall, 1); }), "type[3] is 0, below 1");
}

// ---- files -----------------------------------------------------------------------------------

TEST_F(library_words, write_no_file_over_that_of_a_mesh)
{
  const api::Mesh corners(std::vector<double>{-9, -9, 0, 9, -9, 0, 0, 9, 0});
  const std::string before = content(file_), folder = testing::TempDir(),
                    stl = "move 0 0 -3 mesh_stl $stl every 1";
  for (const std::string &name : {file_, folder + "/./" + file_.substr(folder.size())}) {
    const std::string told = text_of([&] {
      wall_of(kFloorWords + "mesh $corners " + stl, {{"corners", corners}, {"stl", name}});
    });
    EXPECT_TRUE(lsdcd::says(told, {"in 'mesh_stl', '" + name + "' is ",
                                   "the mesh file that the mesh $floor reads: name another file"}));
    EXPECT_EQ(text_of([&] {
                lsdcd::Wall("hooke 1000 300 0 0 0.5 0 mesh $corners mesh $corners name low " + stl,
                            {{"corners", corners}, {"stl", name}});
              }),
              "");
  }
  EXPECT_EQ(content(file_), before);
}

TEST_F(library_words, write_no_series_over_the_file_of_a_mesh)
{
  const std::string file = folder_.path("series_30.stl"), series = folder_.path("series_*.stl");
  std::filesystem::copy_file(file_, file);
  const api::Mesh mesh(file);
  const auto told = [&](const std::string &every) {
    return text_of([&] {
      lsdcd::Wall(kFloorWords + "mesh_stl $series every " + every,
                  {{"floor", mesh}, {"series", series}});
    });
  };
  EXPECT_TRUE(
      lsdcd::says(told("10"), {"in 'mesh_stl', '" + series + "' is ", "name another file"}));
  EXPECT_EQ(told("20"), "");    // it writes no step 30
}

// Saved after step 5, in which no file is due. The mesh rises, so that each file is another one.
TEST_F(library_words, a_saved_wall_writes_the_files_that_are_due)
{
  const auto name_of = [&](const std::string &run, const std::string &end) {
    return folder_.path(run + "." + end);
  };
  const auto wall_of_run = [&](const char *run) {
    return wall_of(kFloorWords + "motion linear 0 0 0.1 mesh_fields $fields every 4 mesh_stl $stl "
                                 "every 3",
                   {{"fields", name_of(run, "*.vtp")}, {"stl", name_of(run, "*.stl")}});
  };
  lsdcd::Wall whole = wall_of_run("whole"), begun = wall_of_run("begun"),
              again = wall_of_run("again");
  Grains grains = slider();
  grains.step(whole, 13);
  grains.step(begun, 5);
  again.restore(begun.save());
  grains.step(again, 8);
  for (int step = 0; step <= 13; step++)
    for (const auto &[end, every] : {std::pair(".vtp", 4), std::pair(".stl", 3)}) {
      const std::string file = std::to_string(step) + end, wanted = content(name_of("whole", file));
      EXPECT_EQ(wanted.empty(), step == 0 || step % every != 0) << file;
      EXPECT_EQ(content(name_of("again", file)), step > 5 ? wanted : "") << file;
    }
}

// ---- saved states ----------------------------------------------------------------------------

// What words a wall with saved data may have otherwise is in test_saved_fields. Here: all digits of numbers count, also of rows of
// tables, which no text of a motion has.
TEST_F(library_words, saved_data_are_of_a_wall_with_the_same_digits_alone)
{
  const api::Mesh other(std::vector<double>{-9, -9, 0, 9, -9, 0, 0, 9, 0}, {0, 1, 2});
  const std::string law = "hooke/history 1000 300 0 0 0.5 0 ",
                    ramp = "mesh $ramp move 0 0 9 motion linear 0 0 1 ",
                    two = law + "mesh $floor " + ramp, table = kFloorWords + "motion table $rows";
  const lsdcd::Values with_ramp = {{"ramp", other}},
                      far = {{"rows", lsdcd::Rows{{0, 0, 0, 0, 1, 0, 0, 0.5}, 4}}},
                      near = {{"rows", lsdcd::Rows{{0, 0, 0, 0, 1, 0, 0, 0.25}, 4}}};
  const struct {
    std::string was, is;
    lsdcd::Values of_was, of_is;
    const char *text;    // empty: it may differ
  } rows[] = {{two, law + "mesh $floor name lid " + ramp, with_ramp, with_ramp, ""},
              {two, "hooke/history 1000.000000000001 300 0 0 0.5 0 mesh $floor " + ramp, with_ramp,
               with_ramp, "the law is hooke/history with 1000.00"},
              {two, law + ramp + "mesh $floor", with_ramp, with_ramp,
               "the motion of meshes[0] is linear 0 0 1 and was rest"},
              {two, law + "mesh $floor mesh $ramp move 0 0 9 motion linear 0 0 1.000000000000001",
               with_ramp, with_ramp, "the exact motion 'linear 0 0 1' of meshes[1] is 0 0 1.00"},
              {table, table, far, far, ""},
              {table, table, far, near, "the exact motion 'table of rows' of meshes[0] is "},
              {kFloorWords + "servo force z 2 vmax 0.5",
               kFloorWords + "servo force z 2.000000001 vmax 0.5",
               {},
               {},
               "the exact servo 'force z 2 vmax 0.5' of meshes[0] is "}};
  for (const auto &row : rows) {
    lsdcd::Wall was = wall_of(row.was, row.of_was), is = wall_of(row.is, row.of_is);
    const std::vector<double> saved = was.save();
    const std::string text = text_of([&] { is.restore(saved); });
    EXPECT_EQ(text.empty(), !*row.text) << text << row.text;
    EXPECT_TRUE(has(text, row.text));
  }
}

// As of a version that compares more, or less.
TEST_F(library_words, saved_data_with_a_part_more_or_less_are_of_another_wall)
{
  const std::vector<double> saved = wall_of(kFloorWords).save();
  const lsdcd::State all(lsdcd::WallState::kKind, saved.data(), saved.size());
  std::vector<std::vector<std::string>> parts;
  all.read("parts", 1, parts);
  const auto with_parts = [&](const std::vector<std::vector<std::string>> &of) {
    lsdcd::State state = lsdcd::WallState::from(all).blocks();
    state.add("parts", 1, of);
    state.add("springs of spheres", 1, std::vector<std::vector<double>>());
    state.add("step", 1, std::int64_t(0));
    return state.numbers();
  };
  const auto text_with = [&](const std::vector<std::vector<std::string>> &of) {
    return text_of([&] { wall_of(kFloorWords).restore(with_parts(of)); });
  };
  EXPECT_EQ(text_with(parts), "");
  auto more = parts, fewer = parts, without_text = parts;
  more.push_back({"gravity", "0 0 -1"});
  EXPECT_TRUE(has(text_with(more), "the gravity is none and was 0 0 -1. "));
  const auto law =
      std::find_if(fewer.begin(), fewer.end(), [](const auto &p) { return p[0] == "law"; });
  ASSERT_NE(law, fewer.end());
  fewer.erase(law);
  EXPECT_TRUE(has(text_with(fewer), "the law is hooke"));
  EXPECT_TRUE(has(text_with(fewer), " and was none. "));
  without_text.push_back({"gravity"});
  EXPECT_TRUE(has(text_with(without_text), "the data of the wall have a part without a text"));
}

// Parts of a mesh that only one has are told by their number.
TEST_F(library_words, saved_data_of_a_wall_with_more_meshes_are_of_another_wall)
{
  const std::string two = kFloorWords + "mesh $floor name lid move 0 0 9";
  const std::vector<double> of_one = wall_of(kFloorWords).save(), of_two = wall_of(two).save();
  EXPECT_TRUE(
      begins(text_of([&] { wall_of(two).restore(of_one); }),
             "these are numbers of a different wall: the number of meshes is 2 and was 1. "));
  EXPECT_TRUE(
      begins(text_of([&] { wall_of(kFloorWords).restore(of_two); }),
             "these are numbers of a different wall: the number of meshes is 1 and was 2. "));
}

TEST_F(library_words, what_fits_of_saved_data_is_taken_by_a_wall_with_another_law)
{
  const std::string meshes = "mesh $floor mesh $floor name lid move 0 0 9 motion linear 0 0 1";
  lsdcd::Wall wall = wall_of("hooke/history 1000 300 0 0 0.5 0 " + meshes),
              stiffer = wall_of("hooke/history 2000 300 0 0 0.5 0 " + meshes);
  slider().step(wall, 3);
  stiffer.restore(wall.save(), true);
  EXPECT_NE(wall.pose(1)[11], 0);
  EXPECT_EQ(stiffer.pose(1), wall.pose(1));
}

// ---- wear that moves the wall ----------------------------------------------------------------

// The sphere wears the first 3 steps; in the 4th the corners of its triangle, whose area is 200, go down by the volume
// over the sum of the thirds of areas around them. A corner of both triangles has twice the area, so it goes half as far.
TEST_F(library_words, worn_vertices_go_down_by_the_volume_over_the_area_around_them)
{
  lsdcd::Wall wall = wall_of(kSlipping + kRecedes);
  Grains grains = slider();
  grains.step(wall, 1, true);
  grains.step(wall, 3);
  const double worn = wall.totals(0).worn_volume, depth = 3 * worn / 200;
  EXPECT_GT(worn, 0);
  EXPECT_EQ(wall.totals(0).removed_volume, 0);
  grains.step(wall, 1);
  EXPECT_NEAR(wall.totals(0).removed_volume, 3 * worn, 1e-12 * worn);
  EXPECT_EQ(wall.totals(0).held_back_volume, 0);
  const api::MeshArrays of = mesh_->arrays();
  const std::vector<double> at = wall.nodes(0);
  for (std::size_t k = 0; k < at.size(); k += 3) {
    const std::size_t vertex = 3 * of.welded_vertex[k / 3];
    const double x = of.vertices[vertex], y = of.vertices[vertex + 1];
    const double wanted = x < y ? 0 : x > y ? depth : depth / 2;
    EXPECT_NEAR(at[k + 2], -wanted, 1e-12 * depth) << x << " " << y;
  }
}

// The vertices of a mesh that moves are in the box: lifted by its pose, and lower by the wear.
TEST_F(library_words, vertices_that_wear_moves_go_with_the_mesh)
{
  lsdcd::Wall still = wall_of(kSlipping + kRecedes),
              wall = wall_of(kSlipping + kRecedes + "motion caller");
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

// ---- contacts and impacts --------------------------------------------------------------------

// A sphere in the edge of two walls touches both; one beside it touches the floor alone.
TEST_F(library_words, each_contact_tells_its_sphere_mesh_force_and_place)
{
  lsdcd::Wall wall = floor_wall("each_contact mesh $floor name side rotate 0 1 0 90");
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
                {1, 1, {20, 0, 0}, {0, 1, 0.49}, 0.02}};    // the normal of the side is along x
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
}

TEST_F(library_words, contacts_are_not_written_where_there_is_too_little_room)
{
  lsdcd::Wall wall = floor_wall("each_contact");
  Grains grains;
  for (const double x : {-3, 0, 3}) grains.add(x, 1, 0.49);
  grains.step(wall);
  int meshes[] = {-7, -7};
  lsdcd_wall_contacts few = {};
  few.size = sizeof few;
  few.room = 2;
  few.mesh = meshes;
  EXPECT_EQ(lsdcd_wall_get_contacts(wall.get(), &few), LSDCD_OK);
  EXPECT_EQ(few.contacts, 3u);
  EXPECT_EQ(meshes[0], -7);
}

// It has left what its spring held: the sphere beside it, which slides on, has not.
TEST_F(library_words, a_contact_that_has_ended_is_told_where_it_was)
{
  lsdcd::Wall wall = floor_wall("each_contact energy");
  Grains grains(5, 5, 0.47, 2);
  grains.add(1, 1, 0.47, 2);
  for (int step = 0; step < 100; step++) {
    for (const std::size_t i : {0, 3}) grains.x[i] += 2 * kDt;
    if (step == 99) grains.x[5] = 0.51;
    grains.step(wall);
  }
  const std::vector<api::WallContact> found = wall.contacts();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_FALSE(found[0].has_ended);
  EXPECT_EQ(found[1].sphere, 1);
  EXPECT_TRUE(found[1].has_ended);
  EXPECT_EQ(found[1].force, (Vector{0, 0, 0}));
  EXPECT_NEAR(found[1].point[0], grains.x[3] - 2 * kDt, kRounding);
}

// A sphere of mass 1 comes down on the wall at speed 2.
void hit(lsdcd::Wall &wall)
{
  Grains grains(1, 2, 0.5);
  grains.v[2] = -2;
  grains.x[2] += 1e-9;
  grains.step(wall);
  EXPECT_TRUE(wall.impacts(0).empty());
  grains.x[2] -= 2e-9;
  grains.step(wall, 2);
}

TEST_F(library_words, impacts_are_in_bins_of_their_energy)
{
  lsdcd::Wall wall = floor_wall("impacts 0.1");
  hit(wall);
  const std::vector<api::ImpactBin> bins = wall.impacts(0);
  ASSERT_EQ(bins.size(), 1u);
  EXPECT_LE(bins[0].begins, 2);
  EXPECT_GT(bins[0].ends, 2);
  EXPECT_EQ(bins[0].impacts, 1);
  EXPECT_NEAR(bins[0].energy, 2, 1e-13);
}

TEST_F(library_words, impacts_are_not_written_where_there_is_too_little_room)
{
  lsdcd::Wall wall = floor_wall("impacts 0.1");
  hit(wall);
  double begins = -7;
  lsdcd_wall_impacts few = {};
  few.size = sizeof few;
  few.begins = &begins;
  EXPECT_EQ(lsdcd_wall_get_impacts(wall.get(), 0, &few), LSDCD_OK);
  EXPECT_EQ(few.bins, 1u);
  EXPECT_EQ(begins, -7);
}

// ---- poses -----------------------------------------------------------------------------------

const std::string kDamped = "hooke/history 1000 300 20 10 0.5 1 mesh $floor ";

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
    const lsdcd_wall_step step = step_of(kStep);
    wall.step(pile.spheres(), step);
    all.insert(all.end(), pile.force.begin(), pile.force.end());
    all.insert(all.end(), pile.torque.begin(), pile.torque.end());
  }
  return all;
}

std::optional<api::Pose> no_pose(int)
{
  return std::nullopt;
}

TEST_F(library_words, poses_have_the_bits_of_a_linear_motion)
{
  const Vector v = {0.25, -0.5, 1};
  lsdcd::Wall moved = wall_of(kDamped + "motion linear 0.25 -0.5 1"),
              posed = wall_of(kDamped + "motion caller");
  const auto wanted = go_posed(moved, 50, no_pose);
  EXPECT_TRUE(any_nonzero(wanted));
  EXPECT_EQ(go_posed(posed, 50,
                     [&](int k) {
                       api::Pose pose;
                       for (int d = 0; d < 3; d++) pose.position[d] = v[d] * (k * kStep);
                       pose.velocity = v;
                       return pose;
                     }),
            wanted);
  EXPECT_EQ(posed.pose(0), moved.pose(0));
  EXPECT_EQ(posed.totals(0).power, moved.totals(0).power);
}

// A turn about an axis through the mesh's origin. Matrices of the two differ by the rounding of sines and of a
// quaternion, 1e-15 with lengths up to 4; forces by that times stiffness, velocities times 4 damping.
TEST_F(library_words, poses_turn_a_mesh_as_a_rotation_does)
{
  const double omega = std::acos(-1.);    // once in 2
  lsdcd::Wall moved = wall_of(kDamped + "motion rotate 0 0 0 0 1 0 2"),
              posed = wall_of(kDamped + "motion caller");
  const auto wanted = go_posed(moved, 50, no_pose),
             found = go_posed(posed, 50, [&](int k) {
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

TEST_F(library_words, a_mesh_with_poses_rests_where_it_was_placed_until_it_has_one)
{
  lsdcd::Wall posed = floor_wall("motion caller"), still = floor_wall();
  EXPECT_EQ(go_posed(posed, 5, no_pose), go_posed(still, 5, no_pose));
  EXPECT_EQ(posed.pose(0), still.pose(0));
}

// A sphere whose velocity is that of the plate below it, at the same time, feels no friction; half a step before, the plate below was
// turned by angle = omega dt / 2, and its velocity differs by omega x angle to first order: 10 times that, to a relative angle.
TEST_F(library_words, synchronous_steps_take_velocities_of_the_time_of_places)
{
  const double omega = 50, angle = omega * kDt / 2, x = 0.5, period = 2 * std::acos(-1.) / omega;
  const std::string words = "hooke 1000 0 0 10 1000 1 mesh $floor motion ";
  for (const bool by_motion : {false, true})
    for (const bool synchronous : {false, true}) {
      lsdcd::Wall wall = by_motion
                             ? wall_of(words + "rotate 0 0 0 0 0 1 $period", {{"period", period}})
                             : wall_of(words + "caller");
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

TEST_F(library_words, synchronous_steps_are_refused_beside_a_body)
{
  lsdcd::Wall wall = floor_wall("body mass 1 com 0 0 0 inertia 1 1 1 0 0 0");
  Grains grains(0.3, 0.2, 0.5);
  lsdcd_wall_step step = step_of();
  step.synchronous = 1;
  EXPECT_TRUE(
      begins(text_of([&] { wall.step(grains.spheres(), step); }), "synchronous is 1, and "));
}

TEST_F(library_words, poses_that_are_none_are_refused)
{
  lsdcd::Wall wall = floor_wall("motion caller");
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
}

TEST_F(library_words, a_mesh_with_poses_takes_no_motion)
{
  lsdcd::Wall wall = floor_wall("motion caller");
  for (const char *words : {"motion none", "motion linear 0 0 1", "servo force z 1 vmax 1"})
    EXPECT_TRUE(is_refused("mesh 'floor' has poses of the program, which alone move it",
                           [&] { wall.change(words); }));
}

// In C.
TEST_F(library_words, what_is_null_of_a_pose_is_that_of_the_mesh_as_it_was_made)
{
  lsdcd::Wall wall = floor_wall("motion caller");
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
TEST_F(library_words, all_contacts_are_found_where_a_pose_jumps)
{
  const api::Mesh mesh = hills();
  const lsdcd::Values values = {{"hills", mesh}};
  lsdcd::Random random(11);
  for (const std::size_t n : {1u, 2u}) {
    const std::string words = std::string("hooke 1000 300 20 10 0.5 1 mesh $hills motion caller ") +
                              (n > 1 ? "mesh $hills name other move 1 0 0.5 motion caller" : "");
    lsdcd::Wall wall(words, values);
    Grains grains = cloud();
    std::vector<api::Pose> poses(n);
    const double limit = n == 1 ? 0 : 20 * 10 * 2.3e-16 * kN;
    double contacts = 0;
    for (int k = 0; k < 60; k++) {
      const double size = 0.4 * std::pow(10., uniform(random, -5, 1));
      lsdcd::Wall fresh(words, values);
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

TEST_F(library_words, poses_that_differ_between_processes_are_refused)
{
  lsdcd::on_processes(2, [&](lsdcd::FakeHost &host) {
    const Process process(host);
    lsdcd::Wall wall = floor_wall("motion caller", &process.options);
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

TEST_F(library_words, inputs_that_differ_between_processes_are_refused)
{
  lsdcd::on_processes(2, [&](lsdcd::FakeHost &host) {
    const Process process(host);
    lsdcd::Wall wall = floor_wall("surface_vel v_speed 0 0", &process.options);
    Grains mine(0, 0, 0.49);
    wall.set_input("speed", 1);
    mine.step(wall);
    wall.set_input("speed", 1 + host.rank());
    EXPECT_TRUE(has(text_of([&] { mine.step(wall); }), "differ between the processes"));
  });
}

// ---- nodes -----------------------------------------------------------------------------------

// A plate of four vertices in another order than triangles have them, mirrored and shifted by its placement: the k-th node
// is the k-th vertex of the caller. A fifth is of no triangle.
TEST_F(library_words, nodes_lift_a_plate_vertex_by_vertex)
{
  const std::vector<double> vertices = {1, 1, 0, -1, -1, 0, 1, -1, 0, -1, 1, 0, 7, 7, 7};
  const std::vector<std::uint32_t> faces = {1, 2, 0, 1, 0, 3};
  lsdcd::Wall wall("hooke 1000 0 20 0 0 1 mesh $plate scale -1 1 1 move 0.25 0 1 nodes caller",
                   {{"plate", api::Mesh(vertices, faces)}});
  std::vector<double> placed = wall.nodes(0);
  ASSERT_EQ(placed.size(), vertices.size());
  EXPECT_TRUE(std::isnan(placed[12]));
  std::fill(placed.begin() + 12, placed.end(), 0);
  for (std::size_t k = 0; k < 12; k += 3) {
    EXPECT_EQ(placed[k], 0.25 - vertices[k]);
    EXPECT_EQ(placed[k + 1], vertices[k + 1]);
    EXPECT_EQ(placed[k + 2], 1);
  }

  // Lifted by 1/16, with a speed of 0.5 towards a sphere of radius 0.5 and mass 1 over the middle of a triangle.
  std::vector<double> at = placed, velocities(at.size(), 0);
  for (std::size_t k = 2; k < at.size(); k += 3) {
    at[k] += 0.0625;
    velocities[k] = 0.5;
  }
  wall.set_nodes(0, at, velocities);
  double middle[2] = {0, 0};
  for (int k = 0; k < 3; k++)
    for (int d = 0; d < 2; d++) middle[d] += at[3 * faces[k] + d] / 3;
  Grains grains(middle[0], middle[1], 1.5);
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
TEST_F(library_words, nodes_that_were_welded_stay_together)
{
  const std::vector<double> corners = {-2, -2, 0, 2, -2, 0, 2, 2, 0, -2, -2, 0, 2, 2, 0, -2, 2, 0};
  lsdcd::Wall wall("hooke 1000 0 0 0 0 0 mesh $plate nodes caller",
                   {{"plate", api::Mesh(corners)}});
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

TEST_F(library_words, nodes_that_make_no_sense_are_refused)
{
  lsdcd::Wall wall = floor_wall("nodes caller");
  std::vector<double> at = wall.nodes(0);
  at[4] = NAN;
  EXPECT_TRUE(is_refused("`positions[4]` is", [&] { wall.set_nodes(0, at); }));
  EXPECT_TRUE(is_refused("there are 3 numbers", [&] { wall.set_nodes(0, {1, 2, 3}); }));
}

TEST_F(library_words, a_mesh_with_nodes_takes_no_motion)
{
  lsdcd::Wall wall = floor_wall("nodes caller");
  for (const char *words : {"motion none", "motion linear 0 0 1", "servo force z 1 vmax 1"})
    EXPECT_TRUE(is_refused("its nodes alone move this mesh", [&] { wall.change(words); }));
}

// ---- bodies ----------------------------------------------------------------------------------

// A sphere at rest pushes a plate of mass 2 down.
TEST_F(library_words, a_body_tells_where_it_is_and_its_energy)
{
  lsdcd::Wall wall = floor_wall("body mass 2 com 0 0 0 inertia 1 1 2 0 0 0 joint slider 0 0 2 "
                                "spring 30 0.5 0.1 limits -1 0.5 motor 0.3 load 0 0 -0.7 "
                                "velocity 0 0 0.2 gravity 0 0 -9.81");
  Grains grains(0.3, 0.2, 0.49);
  grains.step(wall, 20);
  const api::BodyState a = wall.body(0);
  EXPECT_LT(a.velocity[2], 0.2);
  EXPECT_NEAR(a.coordinate, a.centre[2], 1e-15);
  EXPECT_EQ(a.quaternion[0], 1);
  EXPECT_NEAR(a.energy,
              0.5 * 2 * a.velocity[2] * a.velocity[2] + 0.5 * 30 * std::pow(a.coordinate - 0.1, 2),
              1e-12);
}

TEST_F(library_words, a_body_tells_the_forces_of_its_stop_and_joint)
{
  lsdcd::Wall wall = floor_wall("body mass 2 com 0 0 0 inertia 1 1 2 0 0 0 joint slider 0 0 1 "
                                "limits 0 1 load 3 0 -4 moment 0 -2 0");
  Grains grains(0.3, 0.2, 5);
  grains.step(wall, 10);
  const api::BodyState state = wall.body(0);
  EXPECT_EQ(state.stop_force, 4);
  EXPECT_EQ(state.energy, 0);
  // The joint bears what the body may not follow.
  EXPECT_EQ(state.reaction_force[0], -3);
  EXPECT_EQ(state.reaction_torque[1], 2);
}

// ---- sub-models ------------------------------------------------------------------------------

TEST(sub_model_facts, are_refused_without_a_size_and_past_the_last)
{
  lsdcd_sub_model_facts facts = {};
  EXPECT_EQ(lsdcd_sub_model_get_facts(0, &facts), LSDCD_ERROR_ARGUMENT);
  facts.size = sizeof facts;
  EXPECT_EQ(lsdcd_sub_model_get_facts(100000, &facts), LSDCD_ERROR_ARGUMENT);
  EXPECT_EQ(lsdcd_sub_model_get_facts(0, &facts), LSDCD_OK);
}

TEST(keyword_facts, are_refused_without_a_size_and_past_the_last)
{
  lsdcd_keyword_facts facts = {};
  EXPECT_EQ(lsdcd_keyword_get_facts(0, &facts), LSDCD_ERROR_ARGUMENT);
  facts.size = sizeof facts;
  EXPECT_EQ(lsdcd_keyword_get_facts(100000, &facts), LSDCD_ERROR_ARGUMENT);
  EXPECT_EQ(lsdcd_keyword_get_facts(0, &facts), LSDCD_OK);
  EXPECT_STREQ(facts.name, "mesh");
}

}    // namespace
}    // namespace test_library_words
