// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/keywords.h"

#include "base/atomic_file.h"
#include "grid/triangle_grid.h"
#include "input/body_words.h"
#include "input/law_words.h"
#include "input/motion_words.h"
#include "input/servo_words.h"
#include "input/value_words.h"
#include "output/file_series.h"
#include "wall/spec/settings.h"
#include "wall/spec/spec_words.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace lsdcd {

namespace {

// Of files, means and worn meshes that are due every so many steps.
constexpr NumberRange kStepsRange = {1, std::numeric_limits<int>::max()};

void read_mesh(Tokens &w, MeshSpec &s, InputNames &)
{
  if (w.done()) w.fail("the file name is missing");
  s.file = s.name = w.take();
}

Real nonzero(Tokens &w, const char *what)
{
  const Real value = w.number(what);
  if (value == 0) w.fail(std::string(what) + " must not be zero");
  return value;
}

void read_scale(Tokens &w, MeshSpec &s, InputNames &)
{
  Vec3 f;
  f.x = f.y = f.z = nonzero(w, "the factor");
  if (w.number_follows()) {
    f.y = nonzero(w, "the y factor");
    f.z = nonzero(w, "the z factor (give one factor or three)");
  }
  s.placement.scale(f);
}

void read_rotate(Tokens &w, MeshSpec &s, InputNames &)
{
  Vec3 axis;
  axis.x = w.number("the axis (x)");
  axis.y = w.number("the axis (y)");
  axis.z = w.number("the axis (z)");
  const Real degrees = w.number("the angle");
  if (axis == Vec3{0, 0, 0}) w.fail("the axis must not be 0 0 0");
  s.placement.rotate(axis, degrees);
}

void read_move(Tokens &w, MeshSpec &s, InputNames &)
{
  Vec3 shift;
  shift.x = w.number("x");
  shift.y = w.number("y");
  shift.z = w.number("z");
  s.placement.move(shift);
}

void read_matrix(Tokens &w, MeshSpec &s, InputNames &)
{
  const char *const names[3][4] = {
      {"m11", "m12", "m13", "tx"}, {"m21", "m22", "m23", "ty"}, {"m31", "m32", "m33", "tz"}};
  Vec3 m[3], shift;
  for (int i = 0; i < 3; i++) {
    m[i] = read_vector(w, names[i][0], names[i][1], names[i][2]);
    shift[i] = w.number(names[i][3]);
  }
  w.refuse_number(": a matrix has three rows of four numbers");
  try {
    s.placement.matrix(m, shift);
  } catch (const InputError &e) {
    w.fail(e.what());
  }
}

void read_cache(Tokens &w, MeshSpec &s, InputNames &)
{
  if (w.done()) w.fail("the file name is missing");
  const std::string file = w.take();
  if (file == "none") return;
  s.cache_file = file;
}

// A family's sub-models beside a classic style: "cdt MU | epsd2 MU", and a line about each.
struct BesideStyle {
  std::string syntax, help;

  explicit BesideStyle(Family family)
  {
    for (const SubModel *row : rows_beside_style(family)) {
      syntax += (syntax.empty() ? "" : " | ") + syntax_of(*row);
      help += (help.empty() ? "" : "; ") + std::string(row->name) + ": " + row->help;
    }
  }
};

void read_rolling(Tokens &w, WallCommand &s)
{
  read_beside_style(w, s.wall.laws.front(), Family::rolling);
}

void read_cohesion(Tokens &w, WallCommand &s)
{
  read_beside_style(w, s.wall.laws.front(), Family::cohesion);
}

const BesideStyle kRolling(Family::rolling), kCohesion(Family::cohesion);

void read_wear(Tokens &w, WallCommand &s)
{
  s.wall.wear.model =
      static_cast<WearModel>(1 + w.choice({std::begin(kWearWords) + 1, std::end(kWearWords)}));
  if (s.wall.wears_by_impact()) {
    OkaWear &oka = s.wall.wear.oka;
    s.wall.wear.per_work = w.number("E90", 0);
    oka.hardness = w.number("Hv", kAboveZero);
    for (const auto &[name, exponent] : {std::pair{"n1", &oka.n1}, std::pair{"n2", &oka.n2},
                                         std::pair{"k2", &oka.k2}, std::pair{"k3", &oka.k3}})
      *exponent = w.number(name, 0);
    oka.speed = w.number("v", kAboveZero);
    oka.diameter = w.number("D", kAboveZero);
    oka.least_speed = w.number("least", kAboveZero);
  } else {
    s.wall.wear.per_work = w.number("K", 0);
    if (s.wall.wear.model == WearModel::archard) s.wall.wear.per_work /= w.number("H", kAboveZero);
  }
  if (w.done() || w.peek() != "deform") return;
  w.take();
  if (w.done() || w.take() != "every") w.fail("'every N' is missing");
  s.wall.wear_deform.every = static_cast<int>(w.whole("N", kStepsRange));
  if (w.done() || w.peek() != "factor") return;
  w.take();
  s.wall.wear_deform.factor = w.number("F", kAboveZero);
}

void read_name(Tokens &w, MeshSpec &s, InputNames &)
{
  if (w.done()) w.fail("the name is missing");
  s.name = w.take();
  Real number;
  if (is_number(s.name, &number))
    w.fail("the name of a mesh is no number, as meshes have numbers, too");
}

void read_torque_about(Tokens &w, MeshSpec &s, InputNames &)
{
  s.torque_about_mesh = !w.done() && w.peek() == "mesh";
  if (s.torque_about_mesh) w.take();
  if (s.torque_about_mesh && !w.number_follows()) return;
  s.torque_about = read_vector(w, "x", "y", "z");
}

void read_temperature(Tokens &w, MeshSpec &s, InputNames &inputs)
{
  s.has_temperature = true;
  read_value(w, "T", s.temperature, s.temperature_input, inputs);
}

void read_nodes(Tokens &w, MeshSpec &s, InputNames &)
{
  if (w.done()) w.fail("the group of the nodes is missing");
  s.has_nodes = true;
  s.node_group = w.take();
}

void read_pressure(Tokens &w, MeshSpec &s, InputNames &inputs)
{
  read_value(w, "P", s.pressure, s.pressure_input, inputs);
}

void read_draw(Tokens &w, WallCommand &s)
{
  s.picture.draw = static_cast<Draw>(w.choice({"edges", "faces", "contours"}));
  if (!w.number_follows()) return;
  s.picture.type = static_cast<int>(w.whole("the atom type", 1, 1e6));
}

void read_cut(Tokens &w, WallCommand &s)
{
  s.picture.cut = true;
  s.picture.cut_normal.x = w.number("the normal (x)");
  s.picture.cut_normal.y = w.number("the normal (y)");
  s.picture.cut_normal.z = w.number("the normal (z)");
  if (s.picture.cut_normal == Vec3{0, 0, 0}) w.fail("the normal must not be 0 0 0");
  s.picture.cut_offset = w.number("the offset");
}

void read_device(Tokens &w, WallCommand &s)
{
  s.wall.device = static_cast<Device>(w.choice(all_words(kDeviceWords)));
}

// Reads the values of a keyword as its row in wall/spec/settings.h says. `what`: what messages call them.
template <class Kind, class T>
void read_setting(const Kind &kind, Tokens &w, const std::string &what, T &to)
{
  if constexpr (std::is_same_v<Kind, WordSetting>) {
    to = static_cast<T>(w.choice({kind.words, kind.words + kind.n}));
  } else if constexpr (std::is_same_v<Kind, FlagSetting>) {
    to = true;
  } else if constexpr (std::is_same_v<Kind, LengthSetting>) {
    to = w.number_or("auto", 0, what.c_str(), {kAboveZero, Tokens::kHuge});
  } else if constexpr (std::is_same_v<Kind, NearestSetting>) {
    to = read_nearest(w);
  } else if constexpr (std::is_same_v<Kind, MemorySetting>) {
    to = read_memory(w);
  } else if constexpr (std::is_same_v<Kind, StepsSetting>) {
    to = static_cast<T>(w.whole(what.c_str(), kStepsRange));
  } else if constexpr (std::is_same_v<Kind, ShareSetting>) {
    to = w.number(what.c_str(), 0, 1);
  } else if constexpr (std::is_same_v<Kind, SpeedSetting>) {
    to = w.number(what.c_str(), kAboveZero);
  } else {
    static_assert(std::is_same_v<Kind, FactorSetting>);
    to = w.number(what.c_str(), 0);
  }
}

// "L" of "L | auto".
std::string first_value(const std::string &values)
{
  return values.substr(0, values.find(' '));
}

#define LSDCD_KEYWORD(member, kind, rule, name, values, unit, range, fallback, help)               \
  {name, values, unit, range, fallback, help, [](Tokens &w, WallCommand &s) {                      \
     read_setting(kind, w, first_value(values), s.wall.member);                                    \
   }},
#define LSDCD_MESH_KEYWORD(member, kind, rule, name, values, unit, range, fallback, help)          \
  {name, values, unit, range, fallback, help, nullptr, [](Tokens &w, MeshSpec &s, InputNames &) {  \
     read_setting(kind, w, first_value(values), s.member);                                         \
   }},

constexpr char kMoves[] =
    "moves the mesh, with the syntax of fix move and more; later motions carry earlier ones";
constexpr char kDrawsAlone[] = "LAMMPS alone draws pictures";

const Keyword kKeywords[] = {
    {"mesh", "FILE", "", "STL, OBJ, PLY, OFF", "",
     "the wall; more of them, each with its own keywords after it", nullptr, read_mesh},
    {"name", "NAME", "", "no number", "FILE", "what fix_modify and messages call the mesh", nullptr,
     read_name},
    {"scale", "s | sx sy sz", "", "not 0", "1",
     "multiply coordinates; scale, rotate, move and matrix act in the order given", nullptr,
     read_scale},
    {"rotate", "ax ay az degrees", "degrees", "axis not 0 0 0", "none",
     "right-handed rotation about an axis through the origin", nullptr, read_rotate},
    {"move", "x y z", "length", "", "0 0 0", "shift", nullptr, read_move},
    {"matrix", "m11 m12 m13 tx m21 m22 m23 ty m31 m32 m33 tz", "t: length", "determinant not 0",
     "none", "three rows, each with its shift behind it: a corner at x goes to m x + t", nullptr,
     read_matrix},
    {"weld", "tol", "length", ">= 0", "cracks of 1e-6 of a part",
     "corners closer than this are one vertex; 0: only equal ones", nullptr,
     [](Tokens &w, MeshSpec &s, InputNames &) { s.weld = w.number("the tolerance", 0); }},
    {"cache", "FILE | none", "", "", "none",
     "file that keeps the grid, so the next start need not build it", nullptr, read_cache},
    {"motion", kMotionSyntax, "velocity, length, time", "period > 0", "none", kMoves, nullptr,
     read_motion},
    {"wiggle", "x|y|z amplitude period", "length, time", "period > 0", "none",
     "the mesh moves as fix wall/gran's: by A - A cos(2 pi t/period)", nullptr, read_wiggle},
    {"servo", kServoSyntax, "force or torque, velocity or 1/time, length or radians",
     "vmax > 0, gain > 0, lo <= 0 <= hi", "none",
     "the mesh moves along or turns about an axis to push the spheres with TARGET, a number or "
     "v_NAME",
     nullptr, read_servo},
    {"body", kBodySyntax,
     "mass/volume; mass, length, mass length^2; force/length and force time/length, or torque and "
     "torque time",
     "D > 0, M > 0, K >= 0, C >= 0, lo <= 0 <= hi", "none",
     "the mesh is a rigid body that the spheres push, free or held by a joint; the values of "
     "motor, "
     "load and moment: each a number or v_NAME",
     nullptr, read_body},
    {"nodes", "GROUP", "", "", "none",
     "the vertices of the mesh are atoms of this group, which LAMMPS moves and the spheres push",
     nullptr, read_nodes},
    {"pressure", "P | v_NAME", "pressure", "", "0",
     "pushes the nodes to where normals point by the winding, out of a closed mesh; a number or "
     "v_NAME",
     nullptr, read_pressure},
    {"shear", "x|y|z v", "velocity", "", "none",
     "the surface moves while the mesh stays, as fix wall/gran's: surface_vel in one direction; v: "
     "a number or v_NAME",
     nullptr, read_shear},
    {"surface_vel", "vx vy vz", "velocity", "", "0 0 0",
     "the surface moves along itself while the mesh stays, as a conveyor's; each a number or "
     "v_NAME",
     nullptr, read_surface_vel},
    {"surface_angvel", "wx wy wz [cx cy cz]", "1/time, length", "", "0 0 0",
     "the surface turns about an axis through c (the origin) while the mesh stays, like a roll; "
     "each w a number or v_NAME",
     nullptr, read_surface_angvel},
    {"law", "[types I] STYLE numbers", "", "the wall's sub-models", "the wall's numbers",
     "numbers of contacts with this mesh, or of atom types I (2, 1*3, 2*) with it", nullptr,
     read_law_of_mesh},
    {"rolling", kRolling.syntax.c_str(), "", ">= 0", "none", kRolling.help.c_str(), read_rolling},
    {"cohesion", kCohesion.syntax.c_str(), "energy/volume", ">= 0", "none", kCohesion.help.c_str(),
     read_cohesion},
    {"wear",
     "archard K H | finnie K | oka E90 Hv n1 n2 k2 k3 v D least [deform every N [factor F]]",
     "K H: none, pressure; K: 1/pressure; E90: length^3/mass, Hv: GPa, v and least: velocity, "
     "D: length",
     ">= 0, H, Hv, v, D and least > 0, N >= 1, F > 0", "none",
     "volume that wears off the triangles: K F s/H, or by angle and energy of impacts, or by "
     "angle, speed and diameter of impacts faster than least; deform: every N steps F (1) times "
     "that is removed from the mesh",
     read_wear},
    {"mesh_fields", "FILE every N", "", "*.vtp, N >= 1", "none",
     "stress, contacts, wear, energy and impacts of every triangle every N steps, for ParaView; * "
     "is "
     "the step, and "
     "a .pvd file lists them all",
     nullptr, [](Tokens &w, MeshSpec &s, InputNames &) { s.fields = read_file_every(w, ".vtp"); }},
    {"impact_spectrum", "FILE every N", "", "*.csv, N >= 1", "none",
     "number and energy of impacts in bins of their energy, of which ten are a factor of ten, "
     "every "
     "N steps; needs impacts; * is the step",
     nullptr,
     [](Tokens &w, MeshSpec &s, InputNames &) { s.spectrum = read_file_every(w, ".csv"); }},
    {"mesh_stl", "FILE every N", "", "*.stl, N >= 1", "none",
     "the mesh where it is, as a binary STL, every N steps; * is the step", nullptr,
     [](Tokens &w, MeshSpec &s, InputNames &) { s.stl = read_file_every(w, ".stl"); }},
    {"torque_about", "x y z | mesh [x y z]", "length", "", "0 0 0",
     "the point that f_ID[4] to f_ID[6] are about; mesh: it moves with the mesh and was at x y z "
     "(0 0 0) before",
     nullptr, read_torque_about},
    {"device", "auto | cpu | cuda", "", "", "auto", "where wall forces are computed", read_device},
    {"temperature", "T | v_NAME", "temperature", "", "none",
     "of the wall, for the sub-model heat; v_NAME: an equal-style variable", nullptr,
     read_temperature},
    {"contacts", "", "", "", "off", "per-atom array of 8 columns (9 with heat), as fix wall/gran's",
     [](Tokens &, WallCommand &s) { s.wall.contacts = true; }, nullptr, "write each_contact"},
    {"draw", "edges | faces | contours [type]", "", "", "edges 1",
     "what dump image shows, in the colour of an atom type: fix ID type DIAMETER 0 for lines, "
     "fix ID type 1 0 for faces",
     read_draw, nullptr, kDrawsAlone},
    {"cut", "nx ny nz d", "", "n not 0 0 0", "none", "dump image leaves out the part with n.x > d",
     read_cut, nullptr, kDrawsAlone},
};

const std::string kMotionOfProgram = std::string("caller | ") + kMotionSyntax;

// Keywords that only a program has, or with values of its own.
const Keyword kOfPrograms[] = {
    {"motion", kMotionOfProgram.c_str(), "velocity, length, time", "period > 0", "none", kMoves,
     nullptr, read_motion},
    {"nodes", "caller", "", "", "none",
     "the program moves the vertices of the mesh, which the spheres push", nullptr, read_nodes},
    {"device", "auto | cpu | cuda", "", "", "cpu",
     "where wall forces are computed; of arrays on a GPU it is not said", read_device},
    {"shapes", "", "", "", "off", "grains may be ellipsoids and superellipsoids",
     [](Tokens &, WallCommand &s) { s.wall.shapes = true; }},
};

const Keyword kSettings[] = {LSDCD_WALL_SETTINGS(LSDCD_KEYWORD)
                                 LSDCD_MESH_SETTINGS(LSDCD_MESH_KEYWORD)};

#undef LSDCD_KEYWORD
#undef LSDCD_MESH_KEYWORD

}    // namespace

FileEvery read_file_every(Tokens &w, const std::string &end)
{
  FileEvery file;
  if (w.done()) w.fail("the file name is missing");
  file.name = w.take();
  const std::string wrong = wrong_series_name(file.name, end);
  if (!wrong.empty()) w.fail(wrong);
  if (w.done() || w.take() != "every") w.fail("'every N' is missing");
  file.every = static_cast<int>(w.whole("N", kStepsRange));
  return file;
}

const std::vector<Keyword> &keywords()
{
  static const std::vector<Keyword> all = [] {
    std::vector<Keyword> rows(std::begin(kKeywords), std::end(kKeywords));
    rows.insert(rows.end(), std::begin(kSettings), std::end(kSettings));
    return rows;
  }();
  return all;
}

const std::vector<Keyword> &program_keywords()
{
  static const std::vector<Keyword> all = [] {
    std::vector<Keyword> rows;
    for (const Keyword &row : keywords())
      if (!row.answer_to_program) rows.push_back(row);
    for (const Keyword &own : kOfPrograms) {
      const Keyword *const same = find_keyword(rows, own.name);
      if (same)
        rows[static_cast<std::size_t>(same - rows.data())] = own;
      else
        rows.push_back(own);
    }
    return rows;
  }();
  return all;
}

const Keyword *find_keyword(const std::vector<Keyword> &rows, const std::string &name)
{
  for (const Keyword &row : rows)
    if (name == row.name) return &row;
  return nullptr;
}

bool Keyword::repeats() const
{
  for (const char *const word : {"scale", "rotate", "move", "matrix", "motion", "law"})
    if (word == std::string(name)) return true;
  return false;
}

std::string syntax_of(const Keyword &row)
{
  return std::string(row.name) + (*row.values ? " " : "") + row.values;
}

int read_nearest(Tokens &w)
{
  const Real n = w.number_or("all", 0, "N", {1, kMaxNearest});
  if (std::floor(n) != n) w.fail("N must be a whole number");
  return static_cast<int>(n);
}

std::size_t read_memory(Tokens &w)
{
  return static_cast<std::size_t>(w.number("the budget", 1, 1e9) * 1024 * 1024);
}

bool read_mesh_word(const std::string &word, Tokens &w, MeshSpec &mesh)
{
  for (const char *const shared : {"mesh", "scale", "rotate", "move", "matrix", "weld"})
    if (word == shared)
      for (const Keyword &row : keywords())
        if (word == row.name) {
          w.set_context(row.name, syntax_of(row));
          InputNames none;    // these have no variables
          row.read_of_mesh(w, mesh, none);
          return true;
        }
  return false;
}

bool is_twice(const std::string &word, std::vector<std::string> &seen)
{
  const bool repeats = std::any_of(keywords().begin(), keywords().end(),
                                   [&](const Keyword &k) { return word == k.name && k.repeats(); });
  const bool twice = !repeats && std::find(seen.begin(), seen.end(), word) != seen.end();
  seen.push_back(word);
  return twice;
}

}    // namespace lsdcd
