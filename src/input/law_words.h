// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The words of contact laws: of the wall, of one of its meshes, and of atom types with a mesh.
#pragma once

#include "base/input_words.h"
#include "law/sub_models.h"
#include "wall/spec/wall_spec.h"

#include <string>
#include <vector>

namespace lsdcd {

// "hooke|hooke/history|... kn kt|NULL ... [limit_damping] mesh FILE [keywords], or granular ..."
std::string law_syntax();
// Reads the style and its numbers. The law's name becomes the style, and with `granular` all its words.
void read_law(Tokens &w, LawOfTypes &of, const std::string &syntax);
// A sub-model beside a classic style: "cdt MU", and those that there are: all of the family but `none`.
void read_beside_style(Tokens &w, LawOfTypes &of, Family family);
std::vector<const SubModel *> rows_beside_style(Family family);

// [types I] STYLE NUMBERS, after `law`.
void read_law_of_mesh(Tokens &w, MeshSpec &mesh, InputNames &);

// Reads a range of types as LAMMPS's: 2, 1*3, 2*, *3, *
void read_types(Tokens &w, LawOfTypes &of);

// Once all is read: applies coarse_grain to numbers of the script; what a mesh's law leaves out is the wall's; refuses other sub-models.
void finish_laws(WallSpec &settings);

}    // namespace lsdcd
