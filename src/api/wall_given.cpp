// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "api/wall_given.h"

#include "api/law_given.h"
#include "api/objects.h"
#include "api/refusals.h"
#include "law/sub_models.h"
#include "output/file_series.h"
#include "wall/spec/run_files.h"
#include "wall/spec/settings.h"
#include "wall/spec/spec_check.h"
#include "wall/spec/spec_ranges.h"
#include "wall/spec/spec_text.h"

#include <cmath>
#include <memory>
#include <string>
#include <type_traits>

namespace lsdcd {

namespace {

Vec3 checked_axis(const double *axis, const std::string &field)
{
  const Vec3 v = checked_vector(axis, field);
  if (v == Vec3{0, 0, 0}) refuse_field(field, "0 0 0", "give a direction, as 0 0 1");
  return unit_vector(v);
}

void check_zero(const double *values, int n, const std::string &field, const char *kind)
{
  for (int k = 0; k < n; k++)
    if (values[k] != 0)
      refuse_field(n == 1 ? field : element(field, static_cast<std::size_t>(k)), values[k],
                   std::string(kind) + " does not use it: leave it 0");
}

template <class T>
void need_elements(const T *array, std::size_t n, const std::string &field)
{
  if (n > 0 && !array)
    refuse_field(field, "null",
                 "give an array of " + std::to_string(n) + ", or say that there are 0");
}

void check_no_rows(const lsdcd_motion &given, const std::string &field, const char *kind)
{
  if (given.rows)
    refuse_field(field + ".rows", "an array",
                 std::string(kind) + " does not use it: leave it null");
  const double n_rows = static_cast<double>(given.n_rows), columns = given.columns;
  check_zero(&n_rows, 1, field + ".n_rows", kind);
  check_zero(&columns, 1, field + ".columns", kind);
}

// Other kinds of motion leave at 0 what a table alone uses.
void check_no_table(const lsdcd_motion &given, const std::string &field, const char *kind)
{
  check_no_rows(given, field, kind);
  if (given.file)
    refuse_field(field + ".file", in_quotes(given.file),
                 std::string(kind) + " does not use it: leave it null");
  const struct {
    const char *name;
    int value;
  } unused[] = {
      {".straight", given.straight}, {".repeats", given.repeats}, {".degrees", given.degrees}};
  for (const auto &u : unused) {
    const double value = u.value;
    check_zero(&value, 1, field + u.name, kind);
  }
}

bool is_zero(const double *vector)
{
  return vector[0] == 0 && vector[1] == 0 && vector[2] == 0;
}

MotionTerm table_of(const lsdcd_motion &given, const std::string &field)
{
  const char *const kind = "LSDCD_TABLE";
  check_zero(given.velocity, 3, field + ".velocity", kind);
  check_zero(given.amplitude, 3, field + ".amplitude", kind);
  check_zero(&given.period, 1, field + ".period", kind);
  check_zero(&given.angle, 1, field + ".angle", kind);
  MotionTerm term;
  term.kind = MotionKind::table;
  term.point = checked_vector(given.point, field + ".point");
  TableRows rows;
  rows.options.linear = checked_flag(given.straight, field + ".straight");
  rows.options.repeats = checked_flag(given.repeats, field + ".repeats");
  rows.options.degrees = checked_flag(given.degrees, field + ".degrees");
  if (given.file) {
    check_no_rows(given, field, "a table of a file");
    rows.options.has_axis = !is_zero(given.axis);
    if (rows.options.has_axis) term.axis = checked_axis(given.axis, field + ".axis");
    term.table_file = given.file;
    term.table_options = rows.options;
    return term;
  }
  rows.columns = checked_choice(given.columns, field + ".columns", 9, "2, 4, 5, 7 or 8");
  if (given.n_rows == 0) refuse_field(field + ".n_rows", "0", "give two rows or more");
  need_elements(given.rows, given.n_rows, field + ".rows");
  rows.options.has_axis = rows.columns == 2 || rows.columns == 5;
  if (rows.options.has_axis)
    term.axis = checked_axis(given.axis, field + ".axis");
  else
    check_zero(given.axis, 3, field + ".axis", "a table without angles about an axis");
  rows.numbers.assign(given.rows,
                      given.rows + given.n_rows * static_cast<std::size_t>(rows.columns));
  term.table_options = rows.options;
  try {
    term.table = std::make_shared<const MotionTable>(
        rows, [&](std::size_t row) { return "`" + field + ".rows`, row " + std::to_string(row); });
  } catch (const InputError &e) {
    throw ApiError(LSDCD_ERROR_ARGUMENT, e.what());
  }
  return term;
}

MotionTerm motion_of(const lsdcd_motion &given, const std::string &field)
{
  const struct {
    MotionKind kind;
    const char *name;
    bool velocity, amplitude, axis;
  } kinds[] = {{MotionKind::linear, "LSDCD_LINEAR", true, false, false},
               {MotionKind::wiggle, "LSDCD_WIGGLE", false, true, false},
               {MotionKind::cosine, "LSDCD_COSINE", false, true, false},
               {MotionKind::rotate, "LSDCD_ROTATE", false, false, true},
               {MotionKind::transrot, "LSDCD_TRANSROT", true, false, true},
               {MotionKind::riggle, "LSDCD_RIGGLE", false, false, true},
               {MotionKind::table, "LSDCD_TABLE", false, false, false}};
  const auto &kind = kinds[checked_choice(
      given.kind, field + ".kind", 7,
      "LSDCD_LINEAR, LSDCD_WIGGLE, LSDCD_COSINE, LSDCD_ROTATE, LSDCD_TRANSROT, LSDCD_RIGGLE or "
      "LSDCD_TABLE")];
  if (kind.kind == MotionKind::table) return table_of(given, field);
  check_no_table(given, field, kind.name);
  MotionTerm term;
  term.kind = kind.kind;
  if (kind.velocity)
    term.velocity = checked_vector(given.velocity, field + ".velocity");
  else
    check_zero(given.velocity, 3, field + ".velocity", kind.name);
  if (kind.amplitude)
    term.amplitude = checked_vector(given.amplitude, field + ".amplitude");
  else
    check_zero(given.amplitude, 3, field + ".amplitude", kind.name);
  if (kind.axis) {
    term.point = checked_vector(given.point, field + ".point");
    term.axis = checked_axis(given.axis, field + ".axis");
  } else {
    check_zero(given.point, 3, field + ".point", kind.name);
    check_zero(given.axis, 3, field + ".axis", kind.name);
  }
  if (kind.kind == MotionKind::riggle)
    term.angle = checked_number(given.angle, field + ".angle");
  else
    check_zero(&given.angle, 1, field + ".angle", kind.name);
  if (kind.kind == MotionKind::linear)
    check_zero(&given.period, 1, field + ".period", kind.name);
  else if (given.period < 0)
    refuse_field(field + ".period", given.period, other_way_text(term.kind));
  else
    term.period = checked_number(given.period, field + ".period", kPeriodRange);
  return term;
}

// Reads a field as its row in wall/spec/settings.h says.
template <class Kind, class Given, class T>
void read_setting(const Kind &kind, Given given, const std::string &field, T &to)
{
  if constexpr (std::is_same_v<Kind, WordSetting>) {
    to = static_cast<T>(checked_choice(given, field, static_cast<int>(kind.n), kind.names));
  } else if constexpr (std::is_same_v<Kind, FlagSetting>) {
    to = checked_flag(given, field);
  } else if constexpr (std::is_same_v<Kind, LengthSetting> || std::is_same_v<Kind, SpeedSetting>) {
    to = number_or(0, given, field, kAbove0);
  } else if constexpr (std::is_same_v<Kind, NearestSetting>) {
    to = checked_choice(given, field, kMaxNearest + 1,
                        "0 for all, or 1 to " + std::to_string(kMaxNearest));
  } else if constexpr (std::is_same_v<Kind, MemorySetting>) {
    const double bytes = checked_number(given, field, 0, 1e15);
    if (bytes > 0) to = static_cast<std::size_t>(bytes);
  } else if constexpr (std::is_same_v<Kind, StepsSetting>) {
    to = steps_or_none(given, field, kind.none, kStepsRange);
  } else if constexpr (std::is_same_v<Kind, ShareSetting>) {
    to = checked_number(given, field, kShareRange);
  } else {
    static_assert(std::is_same_v<Kind, FactorSetting>);
    if (given != -1 && given != 0) to = checked_number(given, field, kWearFactorRange);
    if (given == -1) to = 0;
  }
}

// `limited`: the law of the wall has limit_damping, which then holds for those of its meshes, too.
void add_laws(const lsdcd_wall_mesh &given, const std::string &field, bool limited, MeshSpec &mesh)
{
  const auto add = [&](const lsdcd_law *law, const std::string &of, int first, int last) {
    NamedLaw made = law_of(law, of);
    if (limited && !made.law.limit_damping && !made.law.is_classic()) made.name += " limit_damping";
    made.law.limit_damping = made.law.limit_damping || limited;
    mesh.laws.push_back({first, last, made.law, made.name});
  };
  if (given.law) add(given.law, field + ".law", LawOfTypes().first_type, kAnyType);
  need_elements(given.type_laws, given.n_type_laws, field + ".type_laws");
  for (std::size_t k = 0; k < given.n_type_laws; k++) {
    const std::string of = element(field + ".type_laws", k);
    const lsdcd_type_law row = checked(given.type_laws + k, "lsdcd_type_law", of);
    if (row.first_type < 1)
      refuse_field(of + ".first_type", std::to_string(row.first_type), "types count from 1");
    if (row.last_type != 0 && row.last_type < row.first_type)
      refuse_field(of + ".last_type", std::to_string(row.last_type),
                   "it is at least first_type, " + std::to_string(row.first_type) +
                       ", or 0 for all types from there on");
    add(row.law, of + ".law", row.first_type, row.last_type ? row.last_type : kAnyType);
  }
}

void read_surface(const lsdcd_wall_mesh &given, const std::string &field, MeshSpec &mesh)
{
  mesh.surface.velocity = checked_vector(given.surface_velocity, field + ".surface_velocity");
  mesh.surface.angular =
      checked_vector(given.surface_angular_velocity, field + ".surface_angular_velocity");
  mesh.surface.centre = checked_vector(given.surface_centre, field + ".surface_centre");
}

void read_motion(const lsdcd_wall_mesh &given, const std::string &field, MeshSpec &mesh)
{
  mesh.pressure = checked_number(given.pressure, field + ".pressure");
  if (checked_flag(given.posed_by_caller, field + ".posed_by_caller")) mesh.motion.begin_posed();
  for (const MotionTerm &term : motions_of(given.motions, given.n_motions, field + ".motions"))
    mesh.motion.add(term);
  if (given.servo) mesh.motion.servo() = servo_of(given.servo, field + ".servo");
  if (given.body) mesh.body = body_of(given.body, field + ".body", true);
}

FileEvery file_of(const char *name, int every, const std::string &field, const char *end)
{
  if (!name || !*name) {
    if (every != 0)
      refuse_field(field + "_every", std::to_string(every),
                   "`" + field + "` has no file: give its name, or leave this 0");
    return {};
  }
  const std::string wrong = wrong_series_name(name, end);
  if (!wrong.empty()) refuse_field(field, in_quotes(name), wrong);
  if (every < kStepsRange.least)
    refuse_field(field + "_every", std::to_string(every), "it is a number of steps, 1 or more");
  return {name, every};
}

MeshSpec mesh_spec_of(const lsdcd_wall_mesh &given, std::size_t k, const WallSpec &wall)
{
  const std::string field = element("meshes", k);
  MeshSpec mesh;
  if (!given.mesh) refuse_field(field + ".mesh", "null", "give a mesh");
  mesh.mesh = {given.mesh->in, &given.mesh->in->mesh};
  mesh.welded_vertex = {given.mesh->in, &given.mesh->in->welded_vertex};
  mesh.weld = 0;    // it is welded
  mesh.name = given.name && *given.name ? given.name : "mesh " + std::to_string(k + 1);
  mesh.placement = placement_of(given.placement, field + ".placement");
  add_laws(given, field, wall.law().limit_damping, mesh);
  read_motion(given, field, mesh);
  read_surface(given, field, mesh);
  mesh.temperature = checked_number(given.temperature, field + ".temperature");
  mesh.has_temperature = wall.law().has_heat() || mesh.temperature != 0;
  mesh.torque_about = checked_vector(given.torque_about, field + ".torque_about");
  mesh.torque_about_mesh = checked_flag(given.torque_about_moves, field + ".torque_about_moves");
#define LSDCD_READ_PLAIN(of_c, member, kind, rule)                                                 \
  read_setting(kind, given.of_c, field + "." #of_c, mesh.member);
#define LSDCD_READ(of_c, member, kind, ...) LSDCD_READ_PLAIN(of_c, member, kind, )
  LSDCD_MESH_SETTINGS(LSDCD_READ, LSDCD_READ_PLAIN)
#undef LSDCD_READ
#undef LSDCD_READ_PLAIN
  mesh.fields = file_of(given.fields, given.fields_every, field + ".fields", ".vtp");
  mesh.spectrum = file_of(given.spectrum, given.spectrum_every, field + ".spectrum", ".csv");
  mesh.stl = file_of(given.stl, given.stl_every, field + ".stl", ".stl");
  if (given.cache) mesh.cache_file = given.cache;
  return mesh;
}

void read_wear(const lsdcd_wall_spec &given, WallSpec &wall)
{
  const int model =
      checked_choice(given.wear, "wear", 3, "LSDCD_NO_WEAR, LSDCD_ARCHARD or LSDCD_FINNIE");
  const WearModel models[] = {WearModel::none, WearModel::archard, WearModel::finnie};
  wall.wear.model = models[model];
  wall.wear.per_work =
      checked_number(given.wear_coefficient, "wear_coefficient", kWearCoefficientRange);
  if (model == LSDCD_NO_WEAR)
    check_zero(&given.wear_coefficient, 1, "wear_coefficient", "LSDCD_NO_WEAR");
  if (model == LSDCD_ARCHARD)
    wall.wear.per_work /= checked_number(given.hardness, "hardness", kHardnessRange);
  else
    check_zero(&given.hardness, 1, "hardness",
               model == LSDCD_FINNIE ? "LSDCD_FINNIE" : "LSDCD_NO_WEAR");
  wall.wear_deform.every = steps_or_none(given.wear_deform_every, "wear_deform_every",
                                         "wear moves no mesh", kStepsRange);
  if (given.wear_deform_every == 0)
    check_zero(&given.wear_deform_factor, 1, "wear_deform_factor",
               "a wall without wear_deform_every");
  else
    wall.wear_deform.factor = number_or(wall.wear_deform.factor, given.wear_deform_factor,
                                        "wear_deform_factor", kWearDeformFactorRange);
}

void read_search(const lsdcd_wall_spec &given, bool on_device, WallSpec &wall)
{
#define LSDCD_READ_PLAIN(of_c, member, kind, rule)                                                 \
  read_setting(kind, given.of_c, #of_c, wall.member);
#define LSDCD_READ(of_c, member, kind, ...) LSDCD_READ_PLAIN(of_c, member, kind, )
  LSDCD_WALL_SETTINGS(LSDCD_READ, LSDCD_READ_PLAIN)
#undef LSDCD_READ
#undef LSDCD_READ_PLAIN
  const int device =
      checked_choice(given.device, "device", 3, "LSDCD_CPU, LSDCD_CUDA or LSDCD_AUTO");
  if (on_device && device != LSDCD_CPU)
    refuse_field(
        "device", device == LSDCD_CUDA ? "LSDCD_CUDA" : "LSDCD_AUTO",
        "it is for arrays of the host; leave it 0, as the wall computes where the arrays of "
        "its spheres are");
  const Device devices[] = {Device::cpu, Device::cuda, Device::automatic};
  wall.device = on_device ? Device::automatic : devices[device];
  if (wall.shapes && on_device)
    refuse_field("shapes", "1",
                 "grains that are no spheres have walls for arrays of the host alone; leave it 0");
}

// Refuses an output that would replace a file that a mesh was read from, in the first step of the wall or a later one.
void check_files(const lsdcd_wall_spec &given, const WallSpec &wall)
{
  constexpr long long kBeforeAllSteps = 0;
  for (std::size_t k = 0; k < given.n_meshes; k++) {
    const std::string &read = given.meshes[k].mesh->in->file;
    if (read.empty()) continue;
    for (const RunFile &file : files_of(wall))
      check_apart(file, {"mesh", read}, "`" + element("meshes", k) + ".mesh`", kBeforeAllSteps);
  }
}

WallSpec read_spec(const lsdcd_wall_spec *pointer, bool on_device)
{
  const lsdcd_wall_spec given = checked(pointer, "lsdcd_wall_spec");
  WallSpec wall;
  const NamedLaw law = law_of(given.law, "law");
  wall.laws.front().law = law.law;
  wall.laws.front().name = law.name;
  read_search(given, on_device, wall);
  read_wear(given, wall);
  need_elements(given.meshes, given.n_meshes, "meshes");
  check_mesh_count(given.n_meshes, SpecNames::fields);
  for (std::size_t k = 0; k < given.n_meshes; k++)
    wall.meshes.push_back(
        mesh_spec_of(checked(given.meshes + k, "lsdcd_wall_mesh", element("meshes", k)), k, wall));
  leave_out_zero_cohesion(wall);
  check_spec(wall, SpecNames::fields);
  check_files(given, wall);
  return wall;
}

}    // namespace

WallSpec wall_spec_of(const lsdcd_wall_spec *given, bool on_device)
{
  try {
    return read_spec(given, on_device);
  } catch (const ApiError &) {
    throw;
  } catch (const InputError &e) {
    throw ApiError(LSDCD_ERROR_ARGUMENT, e.what());
  }
}

Placement placement_of(const double *numbers, const std::string &field)
{
  Placement placement;
  bool any = false;
  for (std::size_t k = 0; k < 12; k++) any |= checked_number(numbers[k], element(field, k)) != 0;
  if (!any) return placement;
  const Vec3 row[3] = {{numbers[0], numbers[1], numbers[2]},
                       {numbers[4], numbers[5], numbers[6]},
                       {numbers[8], numbers[9], numbers[10]}};
  if (dot(row[0], cross(row[1], row[2])) == 0)
    refuse_field(field, "a matrix with the determinant 0",
                 "a placement must keep the mesh three-dimensional; lsdcd_place_scale() and its "
                 "neighbours make one");
  placement.set(row, {numbers[3], numbers[7], numbers[11]});
  return placement;
}

std::vector<MotionTerm> motions_of(const lsdcd_motion *given, std::size_t n,
                                   const std::string &field)
{
  need_elements(given, n, field);
  std::vector<MotionTerm> terms;
  for (std::size_t k = 0; k < n; k++) {
    const std::string of = element(field, k);
    terms.push_back(motion_of(checked(given + k, "lsdcd_motion", of), of));
  }
  return terms;
}

Servo servo_of(const lsdcd_servo *pointer, const std::string &field)
{
  const lsdcd_servo given = checked(pointer, "lsdcd_servo", field);
  Servo servo;
  servo.present = true;
  servo.turns = checked_flag(given.turns, field + ".turns");
  servo.axis = checked_axis(given.axis, field + ".axis");
  if (servo.turns)
    servo.point = checked_vector(given.point, field + ".point");
  else
    check_zero(given.point, 3, field + ".point", "a servo that does not turn");
  servo.target = checked_number(given.target, field + ".target");
  servo.max_speed = checked_number(given.max_speed, field + ".max_speed", kServoSpeedRange);
  servo.max_gain = number_or(servo.max_gain, given.max_gain, field + ".max_gain", kServoGainRange);
  if (given.lo == 0 && given.hi == 0) return servo;
  servo.lo = checked_number(given.lo, field + ".lo", kServoLoRange);
  servo.hi = checked_number(given.hi, field + ".hi", kServoHiRange);
  return servo;
}

BodySpec body_of(const lsdcd_rigid_body *pointer, const std::string &field, bool begins)
{
  const lsdcd_rigid_body given = checked(pointer, "lsdcd_rigid_body", field);
  const auto vector = [&](const double *values, const char *name) {
    return checked_vector(values, field + "." + name);
  };
  BodySpec body;
  body.present = true;
  if (begins) {
    body.density = given.density;
    const double *i = given.inertia;
    if (given.density != 0 && given.mass != 0)
      refuse_field(field + ".density", given.density,
                   "the body has the mass " + number_text(given.mass) +
                       ", too; give a density, or mass, centre and inertia");
    body.mass = {given.mass, vector(given.centre, "centre"), {i[0], i[1], i[2], i[3], i[4], i[5]}};
    body.velocity = vector(given.velocity, "velocity");
    body.omega = vector(given.angular_velocity, "angular_velocity");
    body.coat = {checked_flag(given.coat, field + ".coat"), given.coat_spacing, given.coat_radius};
  }
  Joint &j = body.joint;
  j.kind = static_cast<JointKind>(
      checked_choice(given.joint, field + ".joint", 5,
                     "LSDCD_FREE, LSDCD_HINGE, LSDCD_SLIDER, LSDCD_PLANAR or LSDCD_BALL"));
  if (j.has_point())
    j.point = vector(given.point, "point");
  else
    check_zero(given.point, 3, field + ".point", "this joint");
  if (j.has_coordinate() || j.kind == JointKind::planar)
    j.axis = checked_axis(given.axis, field + ".axis");
  else
    check_zero(given.axis, 3, field + ".axis", "this joint");
  body.drive.stiffness = given.stiffness;
  body.drive.damping = given.damping;
  body.drive.rest = given.rest;
  body.drive.motor = given.motor;
  if (given.lo != 0 || given.hi != 0) {
    if (begins && given.lo <= given.hi && (given.lo > 0 || given.hi < 0))
      refuse_field(
          field + (given.lo > 0 ? ".lo" : ".hi"), given.lo > 0 ? given.lo : given.hi,
          "the coordinate begins at 0, which lo <= 0 <= hi hold; lsdcd_wall_set_body() has "
          "stops for a body that goes on elsewhere");
    body.drive.lo = given.lo;
    body.drive.hi = given.hi;
  }
  body.load = vector(given.load, "load");
  body.moment = vector(given.moment, "moment");
  body.has_gravity = true;
  body.gravity = vector(given.gravity, "gravity");
  return body;
}

}    // namespace lsdcd
