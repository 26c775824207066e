// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Distances of blocks of points to a mesh, on the CPU or a CUDA device.
#pragma once

#include "base/progress.h"
#include "mesh/welded_mesh.h"
#include "tool/answer_writer.h"

#include <memory>
#include <string>

namespace lsdcd {

class PointAnswers {
 public:
  virtual ~PointAnswers() = default;
  virtual void answer(const PointBlock &points, AnswerBlock &answers) = 0;

  SideKind sides = SideKind::none;
  // The set-up, for the report.
  struct Report {
    std::size_t bytes = 0;
    double seconds = 0;
    std::string device;
  } report;
};

// By a tree, the same answers on each device: auto (a GPU where there is one), cpu or cuda. `cutoff`: nothing as far as
// this is found; 0: any distance. `estimate`: of a mesh without sides those that are probable. Throws InputError.
std::unique_ptr<PointAnswers> make_point_answers(const WeldedMesh &mesh, Real cutoff,
                                                 const std::string &device, bool estimate,
                                                 const ProgressListener &progress);

}    // namespace lsdcd
