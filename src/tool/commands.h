// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The commands of lsdcd: each adds itself to the program.
#pragma once

#include "tool/command.h"

namespace lsdcd {

void add_inspect_command(Command &program);
// `exit_code`: set if the mesh is written but something cannot be repaired.
void add_repair_command(Command &program, int &exit_code);
void add_convert_command(Command &program);
void add_generate_command(Command &program);
void add_grid_command(Command &program);
void add_distance_command(Command &program);
void add_collide_command(Command &program);
void add_material_command(Command &program);
void add_timestep_command(Command &program);
void add_shape_command(Command &program);
void add_clump_command(Command &program);
void add_tradeoff_command(Command &program);
void add_accuracy_command(Command &program);
void add_effects_command(Command &program);
void add_check_command(Command &program, int &exit_code);
// Those of the Python package.
void add_report_command(Program &program);
void add_film_command(Program &program);

}    // namespace lsdcd
