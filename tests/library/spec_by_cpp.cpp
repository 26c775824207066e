// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Structs of C as a program has them in C++. All are taken apart by the names of all their members, so that a new one does not
// compile before it is here.
#include "spec_lines.h"

#include "lsdcd.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace {

lsdcd::SubModel model_of(const lsdcd_sub_model &given, const std::string &field)
{
  const auto &[name, numbers] = given;
  if (!name) return {};
  lsdcd_sub_model_facts facts = {};
  facts.size = sizeof facts;
  std::size_t k = 0;
  while (lsdcd_sub_model_get_facts(k++, &facts) == LSDCD_OK)
    if (field == facts.field && std::string(name) == facts.name) break;
  lsdcd::SubModel model(name);
  model.numbers.assign(numbers, numbers + facts.n);
  return model;
}

lsdcd::Law law_of(const lsdcd_law &given)
{
  const auto &[size, style, normal, tangential, damping, rolling, twisting, heat, cohesion,
               limit_damping] = given;
  lsdcd::Law law;
  auto &[style_, normal_, tangential_, damping_, rolling_, twisting_, heat_, cohesion_,
         limit_damping_] = law;
  style_ = model_of(style, "style");
  normal_ = model_of(normal, "normal");
  tangential_ = model_of(tangential, "tangential");
  damping_ = model_of(damping, "damping");
  rolling_ = model_of(rolling, "rolling");
  twisting_ = model_of(twisting, "twisting");
  heat_ = model_of(heat, "heat");
  cohesion_ = model_of(cohesion, "cohesion");
  limit_damping_ = limit_damping != 0;
  (void) size;
  return law;
}

std::string text_or_none(const char *text)
{
  return text ? text : "";
}

lsdcd::WallMesh mesh_of(const lsdcd_wall_mesh &given, const lsdcd::Mesh &any)
{
  const auto &[size, mesh, name, placement, law, type_laws, n_type_laws, posed_by_caller, motions,
               n_motions, servo, surface_velocity, surface_angular_velocity, surface_centre,
               temperature, torque_about, torque_about_moves, wear_factor, cache, fields, stl,
               spectrum, fields_every, stl_every, spectrum_every, nodes_by_caller, pressure, body] =
      given;
  lsdcd::WallMesh out(any);
  auto &[mesh_, name_, placement_, law_, type_laws_, posed_, motions_, servo_, body_,
         surface_velocity_, surface_angular_velocity_, surface_centre_, temperature_, torque_about_,
         torque_about_moves_, wear_factor_, cache_, fields_, stl_, spectrum_, fields_every_,
         stl_every_, spectrum_every_, nodes_by_caller_, pressure_] = out;
  mesh_ = mesh;
  name_ = text_or_none(name);
  std::copy_n(placement, 12, const_cast<double *>(placement_.numbers().data()));
  if (law) law_ = law_of(*law);
  for (std::size_t k = 0; k < n_type_laws; k++) {
    const auto &[row_size, first_type, last_type, row_law] = type_laws[k];
    type_laws_.push_back({first_type, last_type, law_of(*row_law)});
    (void) row_size;
  }
  posed_ = posed_by_caller != 0;
  for (std::size_t k = 0; k < n_motions; k++)
    static_cast<lsdcd_motion &>(motions_.emplace_back()) = motions[k];
  if (servo) static_cast<lsdcd_servo &>(servo_.emplace()) = *servo;
  if (body) static_cast<lsdcd_rigid_body &>(body_.emplace(1)) = *body;
  std::copy_n(surface_velocity, 3, surface_velocity_.begin());
  std::copy_n(surface_angular_velocity, 3, surface_angular_velocity_.begin());
  std::copy_n(surface_centre, 3, surface_centre_.begin());
  temperature_ = temperature;
  std::copy_n(torque_about, 3, torque_about_.begin());
  torque_about_moves_ = torque_about_moves != 0;
  wear_factor_ = wear_factor == 0 ? 1 : wear_factor == -1 ? 0 : wear_factor;
  cache_ = text_or_none(cache);
  fields_ = text_or_none(fields);
  stl_ = text_or_none(stl);
  spectrum_ = text_or_none(spectrum);
  fields_every_ = fields_every;
  stl_every_ = stl_every;
  spectrum_every_ = spectrum_every;
  nodes_by_caller_ = nodes_by_caller != 0;
  pressure_ = pressure;
  (void) size;
  return out;
}

lsdcd::WallSpec spec_of(const lsdcd_wall_spec &given, const lsdcd::Mesh &any)
{
  const auto &[size, law, meshes, n_meshes, corner, side, nearest, cell, memory, rmax, device, wear,
               wear_coefficient, hardness, wear_deform_every, wear_deform_factor, periodic_ends,
               brief, average_every, each_contact, energy, friction_heat, impact_speed, shapes] =
      given;
  lsdcd::WallSpec out;
  auto &[law_, meshes_, corner_, side_, nearest_, cell_, memory_, rmax_, device_, wear_,
         wear_coefficient_, hardness_, wear_deform_every_, wear_deform_factor_, periodic_ends_,
         brief_, average_every_, each_contact_, energy_, friction_heat_, impact_speed_, shapes_] =
      out;
  law_ = law_of(*law);
  for (std::size_t k = 0; k < n_meshes; k++) meshes_.push_back(mesh_of(meshes[k], any));
  corner_ = corner;
  side_ = side;
  nearest_ = nearest;
  cell_ = cell;
  memory_ = memory;
  rmax_ = rmax;
  device_ = device;
  wear_ = wear;
  wear_coefficient_ = wear_coefficient;
  hardness_ = hardness;
  wear_deform_every_ = wear_deform_every;
  wear_deform_factor_ = wear_deform_factor == 0 ? 1 : wear_deform_factor;
  periodic_ends_ = periodic_ends != 0;
  brief_ = brief != 0;
  average_every_ = average_every;
  each_contact_ = each_contact != 0;
  energy_ = energy != 0;
  friction_heat_ = friction_heat;
  impact_speed_ = impact_speed;
  shapes_ = shapes != 0;
  (void) size;
  return out;
}

}    // namespace

extern "C" {

// What a wall of these structs is made of, by way of lsdcd.hpp.
LSDCD_API const char *spec_by_cpp(const lsdcd_wall_spec *spec)
{
  return told([&] {
    const lsdcd::Mesh any(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0});
    return spec_lines_of(lsdcd::Wall(spec_of(*spec, any)).get());
  });
}
}
