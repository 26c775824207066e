// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The contact law of two materials, with numbers of a material file.
#pragma once

#include "law/sub_models.h"

#include <string>
#include <vector>

namespace lsdcd {

// A number in place of the file's, in the caller's units. `of`: the material; empty: of the pair, or of the material for
// which the file lacks it. `key`: a property, or eta.
struct Override {
  std::string of, key;
  Real value;
};

// Particles of one material at a wall of another one, or of the same.
struct MaterialPair {
  std::string file;    // as find_material_file() takes it
  std::string particle, wall;
  std::string normal = "hertz/material";    // or another of normals_of_materials()
  std::vector<Override> overrides;
  // Beside the normal sub-model. By default the damping is by the restitution, and the tangential sub-model mindlin.
  std::vector<GivenSubModel> beside;
  bool limit_damping = false;
  Real coarse_grain =
      1;    // the law is of grains so many times as large as those that the numbers are of
};

// How messages call what a caller gives.
struct MaterialWords {
  const char *on, *with, *syntax;    // of the wall's material, of an override; of all
  const char *as_given;              // "as the input script says"
};

struct MaterialLaw {
  std::vector<GivenSubModel>
      sub_models;    // the normal one first; all numbers are there as given, NaN: derived
  ContactLaw law;
  std::string name;                  // "granular ...": its words, which give the same numbers
  std::string becomes;               // coarse_grain_text(); empty without
  std::string report;                // several lines: each number with its source
  std::vector<std::string> files;    // that have been read
};

// Numbers are in `units`, LAMMPS's name of them. LAMMPS's walls take one material for both sides, so that for two materials
// the modulus and Poisson's ratio are those of one with the same effective Young's and shear moduli. Reads the file. Throws
// InputError.
MaterialLaw law_of_materials(const MaterialPair &pair, const std::string &units,
                             const MaterialWords &words);
// Returns the law of each pair, as those of a wall's meshes and atom types, which share overrides: one that changes nothing in
// all pairs is refused.
std::vector<MaterialLaw> laws_of_materials(const std::vector<MaterialPair> &pairs,
                                           const std::string &units, const MaterialWords &words);

// Returns the normal sub-models whose numbers are properties of materials.
const std::vector<std::string> &normals_of_materials();

// Throws InputError where a normal sub-model takes no material, or an override is none.
void check_normal_of_materials(const std::string &normal);
void check_override(const Override &value);

// Throws InputError that a classic style takes no material, with what the materials give of its numbers.
[[noreturn]] void refuse_classic_of_materials(const std::string &style, const MaterialPair &pair,
                                              const std::string &units, const MaterialWords &words);

// "hertz/material 6.9e+10 0.97 0.23 damping coeff_restitution ..."
std::string text_of(const std::vector<GivenSubModel> &sub_models);

// Returns the contact of a material with itself for LAMMPS 29Sep2021's `pair_style granular`, which later versions take, too: with
// tsuji and its number in place of coeff_restitution, and with a velocity damping of 0 in place of none.
std::vector<GivenSubModel> sub_models_of_29sep2021(std::vector<GivenSubModel> sub_models);

}    // namespace lsdcd
