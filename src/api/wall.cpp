// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_wall_*: a wall is made, asked and freed.
#include "api/call_threads.h"
#include "api/refusals.h"
#include "api/wall_handle.h"
#include "backend/cuda_available.h"
#include "base/input_words.h"
#include "wall/wall_outputs.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

using namespace lsdcd;

namespace {

std::unique_ptr<GpuArrays> gpu_of(const lsdcd_wall_options &o)
{
  if (o.device != LSDCD_CPU && o.device != LSDCD_CUDA)
    refuse_option("lsdcd_wall_options", "device is neither LSDCD_CPU nor LSDCD_CUDA");
  if (o.device == LSDCD_CPU && o.stream)
    refuse_option("lsdcd_wall_options", "stream is given, but device is LSDCD_CPU");
  if (o.device == LSDCD_CPU) return nullptr;
  std::string why;
  if (!cuda_available(&why))
    throw ApiError(LSDCD_ERROR_DEVICE, "CUDA: " + why + "; use LSDCD_CPU, with arrays of the host");
  return make_gpu_arrays(o.stream);
}

// Where the arrays of spheres are, the wall computes.
WallBackend backend_of(const lsdcd_wall_options &o, lsdcd_wall &made)
{
  if (!made.gpu) return {};
  const auto make = [stream = o.stream,
                     device = made.gpu->device()](const EngineSettings &settings) {
    return make_cuda_engine_in_place(settings, device, stream);
  };
  const auto to_cpu = [&caller = made.caller](const HostSpheres &spheres, CpuArrays arrays) {
    return arrays == CpuArrays::tags ? spheres : caller.tagged(caller.spheres_on_cpu());
  };
  return {make, true, to_cpu};
}

// A body has its lsdcd_body_state, and a mesh with a motion its pose.
bool is_of_moving_mesh(OutputPart part)
{
  return part == OutputPart::body || part == OutputPart::motion;
}

struct OutputInfo {
  std::string name;
  const char *unit, *text;
};

constexpr std::size_t kTotals = 49;
static_assert(sizeof(lsdcd_wall_totals) ==
                  offsetof(lsdcd_wall_totals, force) + kTotals * sizeof(double),
              "lsdcd_wall_totals has the rows of wall_outputs(), in their order");

}    // namespace

namespace lsdcd {

void check_can_go_on(const lsdcd_wall &wall)
{
  if (!wall.failed.empty())
    throw ApiError(
        LSDCD_ERROR_INPUT,
        "a step of this wall failed half-way, so it cannot go on: " + wall.failed +
            ". Free it and make another one, which may go on from what was saved before");
}

void check_mesh(const lsdcd_wall &wall, int mesh, int least)
{
  const int n = static_cast<int>(wall.in->meshes().size());
  if (mesh < least || mesh >= n)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "mesh is " + std::to_string(mesh) + "; this wall has " +
                                             std::to_string(n) + ", counted from 0");
}

void note_late(lsdcd_wall &wall)
{
  if (!wall.tells_late() || wall.late.code != LSDCD_OK) return;
  wall.late = failure_of([&] { wall.in->poll_diagnostics(wall.caller.tagged({})); });
}

void tell_late(lsdcd_wall &wall)
{
  if (!wall.tells_late()) return;
  note_late(wall);
  std::vector<Real> none;
  wall.caller.agree(wall.late, none);
}

std::unique_ptr<lsdcd_wall> make_wall(const lsdcd_wall_options *options,
                                      const std::function<GivenWall(lsdcd_wall &)> &given)
{
  lsdcd_wall_options o = {};
  if (options) o = checked(options, "lsdcd_wall_options");
  check_threads(o.threads);
  const CallThreads threads(o.threads);
  auto made = std::make_unique<lsdcd_wall>(o);
  made->gpu = gpu_of(o);
  made->caller.gpu = made->gpu.get();
  const GivenWall wall = given(*made);
  made->in = std::make_unique<Wall>(made->caller, wall.spec, WallUnits(), backend_of(o, *made),
                                    wall.material, StepClock{o.time, 0, 0, 0});
  made->made = made_parts(*made->in, made->caller.box());
  note_vertices(*made);
  made->in->begin_run(0, false);
  made->caller.tell_what_show_threw();
  return made;
}

}    // namespace lsdcd

extern "C" {

int lsdcd_wall_get_totals(lsdcd_wall *wall, int mesh, const double *about,
                          lsdcd_wall_totals *totals)
{
  return guard_wall(wall, [&] {
    lsdcd_wall_totals out = checked(totals, "lsdcd_wall_totals");
    check_mesh(*wall, mesh, -1);
    const Vec3 point = about ? checked_vector(about, "about") : Vec3{0, 0, 0};
    tell_late(*wall);
    Wall &in = *wall->in;
    double *to = out.force;
    for (const WallOutput &output : wall_outputs()) {
      if (is_of_moving_mesh(output.part)) continue;
      for (int d = 0; d < output.row.n; d++) *to++ = output_value(in, mesh, output, d);
    }
    if (!about) return copy_out(out, totals);
    const StepTotals &all = in.totals();
    const MeshTotals t = mesh < 0 ? all.of_all() : all.mesh(mesh);
    const Vec3 torque = t.torque_at_origin - cross(point, t.force);
    for (int k = 0; k < 3; k++) out.torque[k] = torque[k];
    copy_out(out, totals);
  });
}

int lsdcd_wall_get_outputs(lsdcd_wall *wall, int mesh, const char *names, double *to, size_t n)
{
  return guard_wall(wall, [&] {
    need(names, "names");
    if (n > 0) need(to, "to");
    check_mesh(*wall, mesh, -1);
    std::istringstream in(names);
    const std::vector<std::string> all{std::istream_iterator<std::string>(in), {}};
    if (all.size() != n)
      throw ApiError(LSDCD_ERROR_ARGUMENT, "n is " + std::to_string(n) + ", but names has " +
                                               counted(all.size(), "word"));
    struct Place {
      const WallOutput *output;
      int d;
    };
    std::vector<Place> places;
    for (const std::string &name : all) {
      Place place;
      place.output = find_output(wall->in->spec(), name, place.d);
      if (!place.output)
        throw ApiError(LSDCD_ERROR_ARGUMENT, "names: " + why_no_output(wall->in->spec(), name));
      places.push_back(place);
    }
    tell_late(*wall);
    std::vector<Real> numbers;
    for (const Place &place : places)
      numbers.push_back(output_value(*wall->in, mesh, *place.output, place.d));
    std::copy(numbers.begin(), numbers.end(), to);
  });
}

int lsdcd_output_info(size_t k, const char **name, const char **unit, const char **text)
{
  return guard([&] {
    need(name, "name");
    need(unit, "unit");
    need(text, "text");
    static const std::vector<OutputInfo> all = [] {
      std::vector<OutputInfo> made;
      for (const WallOutput &output : wall_outputs())
        for (int d = 0; d < output.row.n; d++)
          made.push_back({output_name(output.row, d), output.row.unit, output.row.text});
      return made;
    }();
    if (k >= all.size())
      throw ApiError(LSDCD_ERROR_ARGUMENT, "k is " + std::to_string(k) + "; there are " +
                                               std::to_string(all.size()) + " numbers");
    *name = all[k].name.c_str();
    *unit = all[k].unit;
    *text = all[k].text;
  });
}

int lsdcd_wall_get_contacts(lsdcd_wall *wall, lsdcd_wall_contacts *contacts)
{
  return guard_wall(wall, [&] {
    const lsdcd_wall_contacts to = checked(contacts, "lsdcd_wall_contacts");
    if (!wall->in->spec().each_contact)
      throw ApiError(LSDCD_ERROR_ARGUMENT,
                     "this wall does not keep its contacts: say each_contact when "
                     "the wall is made");
    if (wall->is_restored)
      throw ApiError(LSDCD_ERROR_ARGUMENT,
                     "the wall has made no step since it was restored, and saved numbers have no "
                     "contacts: ask after its first step");
    tell_late(*wall);
    std::vector<WallContact> found;
    wall->in->for_contacts([&](const WallContact &c) { found.push_back(c); });
    contacts->contacts = found.size();
    if (found.size() > to.room) return;
    for (std::size_t i = 0; i < found.size(); i++) {
      const WallContact &c = found[i];
      if (to.sphere) to.sphere[i] = c.sphere;
      if (to.mesh) to.mesh[i] = c.mesh;
      if (to.overlap) to.overlap[i] = c.overlap;
      if (to.has_ended) to.has_ended[i] = c.has_ended;
      const auto put = [&](double *by_cause, double *plastic, const Real *losses) {
        for (int k = 0; k < kListedCauses; k++)
          if (by_cause) by_cause[kListedCauses * i + k] = losses ? losses[k] : 0;
        if (plastic) plastic[i] = losses ? losses[kListedCauses] : 0;
      };
      put(to.dissipated_power, to.dissipated_power_plastic, c.losses ? c.losses->power : nullptr);
      put(to.dissipated, to.dissipated_plastic, c.losses ? c.losses->energy : nullptr);
      for (int k = 0; k < 3; k++) {
        if (to.force) to.force[3 * i + k] = c.force[k];
        if (to.point) to.point[3 * i + k] = c.point[k];
      }
    }
  });
}

int lsdcd_wall_get_impacts(lsdcd_wall *wall, int mesh, lsdcd_wall_impacts *impacts)
{
  return guard_wall(wall, [&] {
    const lsdcd_wall_impacts to = checked(impacts, "lsdcd_wall_impacts");
    check_mesh(*wall, mesh, 0);
    if (!(wall->in->spec().impact_speed > 0))
      throw ApiError(LSDCD_ERROR_ARGUMENT,
                     "this wall does not record impacts: say impacts V when the wall is made, with "
                     "the least speed V");
    tell_late(*wall);
    const std::vector<ImpactSpectrum::Row> rows = wall->in->impacts(mesh).rows();
    impacts->bins = rows.size();
    if (rows.size() > to.room) return;
    for (std::size_t k = 0; k < rows.size(); k++) {
      if (to.begins) to.begins[k] = rows[k].begins;
      if (to.ends) to.ends[k] = rows[k].ends;
      if (to.impacts) to.impacts[k] = rows[k].impacts;
      if (to.energy) to.energy[k] = rows[k].energy;
    }
  });
}

int lsdcd_wall_get_pose(lsdcd_wall *wall, int mesh, double *matrix)
{
  return guard_wall(wall, [&] {
    need(matrix, "matrix");
    check_mesh(*wall, mesh, 0);
    const Pose &pose = wall->in->meshes()[mesh].pose();
    for (int k = 0; k < 3; k++)
      for (int d = 0; d < 4; d++) matrix[4 * k + d] = d < 3 ? pose.row[k][d] : pose.shift[k];
  });
}

void lsdcd_wall_free(lsdcd_wall *wall)
{
  if (wall && wall->gpu)
    guard([&] {
      wall->gpu->run([&] {
        wall->gpu->wait();
        wall->in.reset();
      });
    });
  delete wall;
}
}
