// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The tables of `lsdcd accuracy`.
#pragma once

#include "study/accuracy.h"
#include "tool/accuracy_rows.h"

#include <string>
#include <vector>

namespace lsdcd {

struct AccuracyOptions {
  std::vector<std::string> tables = {"table2"};
  std::vector<std::string> devices = {"auto"}, orders = {"random"};
  // The one of those that `tessellation` tries that gives the paper's Table 2.
  CylinderMesh shape;
  Real cube = 100, largest = 1;
  double spheres = 1e7, most_spheres = 0, most_triangles = 1e5, memory = 16384;
  bool rim_caps = false;
  std::string inside = "exact";
  std::uint64_t seed = 1;
  int repeats = 5;
  std::string csv, commit = LSDCD_COMMIT;
};

extern const std::vector<std::string> kAccuracyTables;

// The tables named, on one device and in one order.
void make_accuracy_tables(const AccuracyOptions &options, const std::vector<std::string> &tables,
                          Device device, Order order, AccuracyRows &rows);

}    // namespace lsdcd
