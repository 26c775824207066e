// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Distances of blocks of points to a mesh, on the CPU or a CUDA device.
#pragma once

#include "grid/triangle_grid.h"
#include "mesh/wall_mesh.h"
#include "tool/answer_writer.h"

#include <memory>
#include <string>

namespace lsdcd {

class PointAnswers {
 public:
  virtual ~PointAnswers() = default;
  virtual void answer(const PointBlock &points, AnswerBlock &answers) = 0;

  SideKind sides = SideKind::none;
  bool sides_by_normals = false;
  GridReport report;
};

// By a tree on a CPU, by a grid of these settings on a GPU. Their cutoff is 0 for any distance. device: auto, cpu or cuda.
// `estimate`: of a mesh without sides those that are probable. Throws InputError.
std::unique_ptr<PointAnswers> make_point_answers(const WallMesh &mesh, const GridSettings &settings,
                                                 const std::string &device, bool estimate);

}    // namespace lsdcd
