// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/reports/creation_text.h"

#include "base/input_words.h"
#include "base/number_words.h"
#include "base/version.h"
#include "effects/effects.h"
#include "law/coarse_grain.h"
#include "law/sub_models.h"
#include "wall/spec/spec_text.h"
#include "wall/spec/spec_words.h"

namespace lsdcd {

namespace {

std::string in_a_line(const WallSpec &settings, const std::deque<MeshPart> &meshes,
                      const std::string &device)
{
  std::string t;
  for (const MeshPart &m : meshes)
    t += "mesh " + m.spec.name + " of " + counted(m.grid.report().facets, "facet") + ", ";
  if (settings.coarse_grain != 1) t += "coarse_grain " + number_text(settings.coarse_grain) + ", ";
  return t + law_name(settings.laws.front()) + ", " + device;
}

// In the columns of the mesh report.
std::string mesh_lines(const MeshPart &m, const BodyCoats &coats)
{
  std::string t = m.grid.mesh_text();
  const Real wear = m.spec.wear_factor;
  const struct {
    const char *label;
    std::string text;
  } lines[] = {
      {"placement   ", placement_text(m.spec.placement)},
      {"motion      ", m.mover.text(m.bounds(0))},
      {"servo       ", m.mover.servo_text()},
      {"body        ", m.body ? m.body->body_text() : ""},
      {"coat        ", coats.text(m.index)},
      {"nodes       ", m.nodes() ? std::to_string(m.nodes()->count()) + ", which move" : ""},
      {"wear        ", wear == 1 ? "" : number_text(wear) + " times as fast"},
      {"recedes     ", m.surface->recedes_text()}};
  for (const auto &line : lines)
    if (!line.text.empty()) t += "\n  " + (line.label + line.text);
  return t;
}

std::string law_text(const LawOfTypes &row)
{
  const ContactLaw &l = row.law;
  std::string t = law_name(row);
  if (l.is_classic())
    t += ", kn " + number_text(l.k_normal) + ", kt " + number_text(l.k_tangent) + ", gamman " +
         number_text(l.eta) + ", gammat " + number_text(l.gamma_tangent) + ", xmu " +
         number_text(l.mu) + (l.limit_damping ? ", limit_damping" : "");
  else if (l.damping == DampingModel::viscoelastic && t.find(" damping ") == std::string::npos)
    t += " (no damping is named: viscoelastic, with the coefficient " + number_text(l.eta) + ")";
  if (l.is_classic())
    for (const SubModel *row : rows_of(l)) {
      if (!is_beside_style(row->family)) continue;
      t += ", " + std::string(family_word(row->family)) + " " + row->name;
      const Real *numbers = row->family == Family::rolling ? l.rolling.numbers : l.cohesion.numbers;
      for (std::size_t k = 0; k < row->parameters.size(); k++) t += " " + number_text(numbers[k]);
    }
  return t;
}

// The wall's, then those of meshes and of types with them.
std::string contact_lines(const WallSpec &settings)
{
  std::string t = "\n  contact     " + law_text(settings.laws.front());
  const auto of_types = [](const LawOfTypes &row) {
    return row.is_of_all() ? "" : "types " + types_text(row);
  };
  for (std::size_t k = 1; k < settings.laws.size(); k++)
    t += "\n    " + of_types(settings.laws[k]) + ": " + law_text(settings.laws[k]);
  for (std::size_t m = 0; m < settings.meshes.size(); m++)
    for (const LawOfTypes &row : settings.meshes[m].laws)
      t += "\n    mesh " + std::to_string(m + 1) + (row.is_of_all() ? "" : ", ") + of_types(row) +
           ": " + law_text(row);
  return t;
}

std::string coarse_grain_lines(const WallSpec &settings)
{
  if (settings.coarse_grain == 1) return "";
  std::vector<CoarseGrained> laws;
  const auto add = [&](const std::string &of, const LawOfTypes &row) {
    laws.push_back({of + (row.is_of_all() ? "" : " types " + types_text(row)), row.becomes});
  };
  for (const LawOfTypes &row : settings.laws) add("wall", row);
  for (std::size_t m = 0; m < settings.meshes.size(); m++)
    for (const LawOfTypes &row : settings.meshes[m].laws) add("mesh " + std::to_string(m + 1), row);
  return "\n  larger      " + coarse_grain_line(settings.coarse_grain, laws);
}

std::string effect_lines(const HostNames &names, const WallSpec &settings,
                         const EngineSettings &engine)
{
  std::string effects, kept;
  for (const Effect &e : effects_of(engine)) {
    effects += (effects.empty() ? "" : ", ") + e.name;
    if (e.bytes_per_contact > 0)
      kept += ", " + std::to_string(e.bytes_per_contact) + " for " + e.name;
  }
  std::string per = std::string("per ") + names.sphere;
  per.resize(12, ' ');    // as the other lines
  std::string t = "\n  effects     " + effects + "\n  " + per;
  if (settings.law().has_history())
    t += "8 bytes, and per contact " + std::to_string(sizeof(Spring)) +
         " for its spring and place" + kept + ", which move and restart with the " + names.sphere;
  else
    t += "nothing stored, exchanged or restarted";
  if (settings.contacts)
    t += "; " + std::to_string(settings.contact_columns() * sizeof(Real)) + " bytes for contacts";
  return t;
}

std::string search_lines(const WallSpec &settings)
{
  return "\n  search      " +
         (settings.nearest > 0 ? "nearest " + std::to_string(settings.nearest)
                               : std::string("all that can touch")) +
         "\n  corners     " + word_of(settings.corner, kCornerWords) + ", side " +
         word_of(settings.side, kSideWords);
}

}    // namespace

std::string creation_text(const HostNames &names, const WallSpec &settings,
                          const std::deque<MeshPart> &meshes, const BodyCoats &coats,
                          const EngineSettings &engine, const std::string &material,
                          const std::string &device)
{
  if (settings.brief) return in_a_line(settings, meshes, device);
  std::string t;
  for (const MeshPart &m : meshes) t += (t.empty() ? "" : "\n") + mesh_lines(m, coats);
  if (!material.empty()) t += "\n" + material;
  return t + contact_lines(settings) + coarse_grain_lines(settings) +
         effect_lines(names, settings, engine) + search_lines(settings) + "\n  device      " +
         device + "\n  version     " + version();
}

}    // namespace lsdcd
