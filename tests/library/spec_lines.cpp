// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Of a wall that is there, and of the words of a script. Structs are taken apart by the names of all their members, so that a new
// one does not compile before it is here.
#include "spec_lines.h"

#include "api/wall_handle.h"
#include "base/input_error.h"
#include "base/number_words.h"
#include "input/keywords.h"
#include "input/wall_command.h"
#include "motion/motion_table.h"

#include <cstddef>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace {

using namespace lsdcd;

// Numbers have all their digits, and words of an enum are its numbers.
class Lines {
 public:
  template <class T>
  void put(const std::string &name, const T &value)
  {
    if constexpr (std::is_enum_v<T>)
      text_ << name << " = " << static_cast<int>(value) << "\n";
    else if constexpr (std::is_floating_point_v<T>)
      text_ << name << " = " << exact_text(value) << "\n";
    else
      text_ << name << " = " << value << "\n";
  }
  void put(const std::string &name, const Vec3 &v)
  {
    put(name, exact_text(v.x) + " " + exact_text(v.y) + " " + exact_text(v.z));
  }
  template <std::size_t n>
  void put(const std::string &name, const int (&inputs)[n])
  {
    std::string all;
    for (const int input : inputs) all += (all.empty() ? "" : " ") + std::to_string(input);
    put(name, all);
  }
  template <class Model>
  void put(const std::string &name, const Chosen<Model> &chosen)
  {
    const auto &[model, numbers] = chosen;
    put(name + ".model", model);
    put(name + ".numbers", Vec3{numbers[0], numbers[1], numbers[2]});
  }
  void put(const std::string &name, const FileEvery &file)
  {
    const auto &[of, every] = file;
    put(name + ".name", of);
    put(name + ".every", every);
  }
  void put(const std::string &of, const ContactLaw &law)
  {
    const auto &[normal, k_normal, modulus, surface_energy, damping, eta, tangential, k_tangent,
                 gamma_tangent, xgammat, mu, rolling, twisting, heat, cohesion, limit_damping,
                 for_shapes, keeps_forces, keeps_at_nodes, keeps_losses, keeps_touch] = law;
    put(of + "normal", normal);
    put(of + "k_normal", k_normal);
    put(of + "modulus", modulus);
    put(of + "surface_energy", surface_energy);
    put(of + "damping", damping);
    put(of + "eta", eta);
    put(of + "tangential", tangential);
    put(of + "k_tangent", k_tangent);
    put(of + "gamma_tangent", gamma_tangent);
    put(of + "xgammat", xgammat);
    put(of + "mu", mu);
    put(of + "rolling", rolling);
    put(of + "twisting", twisting);
    put(of + "heat", heat);
    put(of + "cohesion", cohesion);
    put(of + "limit_damping", limit_damping);
    put(of + "for_shapes", for_shapes);
    put(of + "keeps_forces", keeps_forces);
    put(of + "keeps_at_nodes", keeps_at_nodes);
    put(of + "keeps_losses", keeps_losses);
    put(of + "keeps_touch", keeps_touch);
  }
  void put(const std::string &of, const std::vector<LawOfTypes> &laws)
  {
    put(of + "s", laws.size());
    for (std::size_t k = 0; k < laws.size(); k++) {
      const auto &[first_type, last_type, law, name] = laws[k];
      const std::string row = of + std::to_string(k) + ".";
      put(row + "first_type", first_type);
      put(row + "last_type", last_type == kAnyType ? 0 : last_type);
      put(row, law);
      put(row + "name", name);
    }
  }
  void put(const std::string &of, const MotionTerm &term)
  {
    const auto &[kind, velocity, amplitude, point, axis, period, angle, input, displacement, speed,
                 table_file, table_options, table] = term;
    const auto &[has_axis, linear, repeats, degrees] = table_options;
    put(of + "kind", kind);
    put(of + "velocity", velocity);
    put(of + "amplitude", amplitude);
    put(of + "point", point);
    put(of + "axis", axis);
    put(of + "period", period);
    put(of + "angle", angle);
    put(of + "input", input);
    put(of + "displacement", displacement);
    put(of + "speed", speed);
    put(of + "table_file", table_file);
    put(of + "table.has_axis", has_axis);
    put(of + "table.linear", linear);
    put(of + "table.repeats", repeats);
    put(of + "table.degrees", degrees);
    std::string rows;
    if (table)
      for (const Real number : table->rows().numbers)
        rows += (rows.empty() ? "" : " ") + exact_text(number);
    put(of + "table.columns", table ? table->rows().columns : 0);
    put(of + "table.rows", rows);
  }
  void put(const std::string &of, const Servo &servo)
  {
    const auto &[present, holds, turns, axis, point, target, target_input, max_gain, max_speed, lo,
                 hi, position, velocity] = servo;
    put(of + "present", present);
    put(of + "holds", holds);
    put(of + "turns", turns);
    put(of + "axis", axis);
    put(of + "point", point);
    put(of + "target", target);
    put(of + "target_input", target_input);
    put(of + "max_gain", max_gain);
    put(of + "max_speed", max_speed);
    put(of + "lo", lo);
    put(of + "hi", hi);
    put(of + "position", position);
    put(of + "velocity", velocity);
  }
  void put(const std::string &of, const BodySpec &body)
  {
    const auto &[present, density, mass_properties, joint, drive, load, moment, motor_input,
                 load_input, moment_input, velocity, omega, has_gravity, gravity, coat] = body;
    const auto &[mass, centre, inertia] = mass_properties;
    const auto &[xx, yy, zz, xy, xz, yz] = inertia;
    const auto &[kind, point, axis] = joint;
    const auto &[stiffness, damping, rest, lo, hi, motor] = drive;
    const auto &[coated, spacing, radius] = coat;
    put(of + "present", present);
    put(of + "density", density);
    put(of + "mass", mass);
    put(of + "centre", centre);
    put(of + "moments", Vec3{xx, yy, zz});
    put(of + "products", Vec3{xy, xz, yz});
    put(of + "joint", kind);
    put(of + "point", point);
    put(of + "axis", axis);
    put(of + "stiffness", stiffness);
    put(of + "damping", damping);
    put(of + "rest", rest);
    put(of + "lo", lo);
    put(of + "hi", hi);
    put(of + "motor", motor);
    put(of + "load", load);
    put(of + "moment", moment);
    put(of + "motor_input", motor_input);
    put(of + "load_input", load_input);
    put(of + "moment_input", moment_input);
    put(of + "velocity", velocity);
    put(of + "omega", omega);
    put(of + "has_gravity", has_gravity);
    put(of + "gravity", gravity);
    put(of + "coat", coated);
    put(of + "coat.spacing", spacing);
    put(of + "coat.radius", radius);
  }
  void put(const std::string &of, const MeshSpec &mesh_spec)
  {
    const auto &[name, file, mesh, welded_vertex, placement, weld, laws, motion, body, has_nodes,
                 node_group, pressure, pressure_input, surface, surface_input, has_temperature,
                 temperature, temperature_input, wear_factor, torque_about_mesh, torque_about, stl,
                 fields, spectrum, cache_file] = mesh_spec;
    const auto &[velocity, angular, centre] = surface;
    put(of + "name", name);
    put(of + "file", file);
    put(of + "vertices", mesh ? mesh->report.hi.x : 0);
    put(of + "welded_vertices", welded_vertex ? welded_vertex->size() : 0);
    for (int k = 0; k < 3; k++) put(of + "placement.row" + std::to_string(k), placement.row(k));
    put(of + "placement.shift", placement.shift());
    put(of + "weld", weld);
    put(of + "law", laws);
    put(of + "posed", motion.is_posed());
    put(of + "motions", motion.terms().size());
    for (std::size_t k = 0; k < motion.terms().size(); k++)
      put(of + "motion" + std::to_string(k) + ".", motion.terms()[k]);
    put(of + "servo.", motion.servo());
    put(of + "body.", body);
    put(of + "has_nodes", has_nodes);
    put(of + "node_group", node_group);
    put(of + "pressure", pressure);
    put(of + "pressure_input", pressure_input);
    put(of + "surface.velocity", velocity);
    put(of + "surface.angular", angular);
    put(of + "surface.centre", centre);
    put(of + "surface_input", surface_input);
    put(of + "has_temperature", has_temperature);
    put(of + "temperature", temperature);
    put(of + "temperature_input", temperature_input);
    put(of + "wear_factor", wear_factor);
    put(of + "torque_about_mesh", torque_about_mesh);
    put(of + "torque_about", torque_about);
    put(of + "stl", stl);
    put(of + "fields", fields);
    put(of + "spectrum", spectrum);
    put(of + "cache_file", cache_file);
  }
  void put(const WallSpec &spec)
  {
    const auto &[laws, meshes, inputs, corner, side, device, grid_length, rmax, nearest,
                 memory_budget, wear, wear_deform, average_every, contacts, each_contact, energy,
                 friction_heat, impact_speed, shapes, periodic, brief] = spec;
    const auto &[model, per_work] = wear;
    const auto &[every, factor] = wear_deform;
    put("law", laws);
    put("meshes", meshes.size());
    for (std::size_t k = 0; k < meshes.size(); k++)
      put("mesh" + std::to_string(k) + ".", meshes[k]);
    put("inputs", inputs.size());
    put("corner", corner);
    put("side", side);
    put("device", device);
    put("grid_length", grid_length);
    put("rmax", rmax);
    put("nearest", nearest);
    put("memory_budget", memory_budget);
    put("wear.model", model);
    put("wear.per_work", per_work);
    put("wear_deform.every", every);
    put("wear_deform.factor", factor);
    put("average_every", average_every);
    put("contacts", contacts);
    put("each_contact", each_contact);
    put("energy", energy);
    put("friction_heat", friction_heat);
    put("impact_speed", impact_speed);
    put("shapes", shapes);
    put("periodic", periodic);
    put("brief", brief);
  }
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

std::string lines_of(const WallSpec &spec)
{
  Lines lines;
  lines.put(spec);
  return lines.text();
}

}    // namespace

std::string spec_lines_of(const lsdcd_wall *wall)
{
  const PeriodicBox box = wall->caller.box();
  Lines lines;
  lines.put("options.corner", box.corner);
  lines.put("options.edges", Vec3{box.edge[0].x, box.edge[1].y, box.edge[2].z});
  lines.put("options.periodic",
            Vec3{Real(box.periodic[0]), Real(box.periodic[1]), Real(box.periodic[2])});
  lines.put("options.margin", box.margin);
  lines.put("options.threads", wall->threads);
  lines.put(wall->in->spec());
  return lines.text();
}

extern "C" {

LSDCD_API const char *spec_of_wall(const lsdcd_wall *wall)
{
  return told([&] { return spec_lines_of(wall); });
}

// Of words behind wall/lsdcd, between blanks.
LSDCD_API const char *spec_by_words(const char *given)
{
  return told([&] {
    std::istringstream in(given);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return lines_of(parse_wall(words).wall);
  });
}

// The keywords of a script, a line for each: its name, its values and its default.
LSDCD_API const char *keyword_lines()
{
  return told([&] {
    std::string all;
    for (const Keyword &row : keywords())
      all += std::string(row.name) + "\t" + row.values + "\t" + row.fallback + "\n";
    return all;
  });
}
}
