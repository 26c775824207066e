// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The program that calls lsdcd_wall_*, as the host of its wall.
#pragma once

#include "api/c_border.h"
#include "backend/gpu_arrays.h"
#include "wall/wall.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

// An error of this process, by its code; LSDCD_OK: there is none.
struct Failure {
  int code = LSDCD_OK;
  std::string text;
};

template <class Work>
Failure failure_of(const Work &work)
{
  Failure failure;
  failure.text = error_of([&] {
    try {
      work();
    } catch (const ApiError &e) {
      failure.code = e.code;
      throw;
    }
  });
  if (failure.code == LSDCD_OK && !failure.text.empty()) failure.code = LSDCD_ERROR_INPUT;
  return failure;
}

class WallCaller : public Host {
 public:
  // Throws ApiError where the options make no sense.
  explicit WallCaller(const lsdcd_wall_options &options);

  bool is_alone() const { return processes() == 1; }
  // Each number becomes the largest of all processes. Where a process has failed all throw ApiError, with the
  // failure of the lowest rank. Collective, a single message where nothing has failed.
  void agree(const Failure &mine, std::vector<Real> &numbers);

  void sum(Real *numbers, int n) override;
  void max(Real *numbers, int n) override;
  void broadcast(void *data, std::size_t bytes, int from, Receivers to = Receivers::all) override;
  PeriodicBox box() const override { return box_; }
  // By its place in the arrays of the last step; one of another process by its order of coming.
  std::string sphere_text(std::int64_t tag) const override;

  std::int64_t highest_tag() const { return highest_tag_; }
  // Numbers for spheres without one, 0, in the order of the array. `highest`: of all processes so far.
  void name_new_spheres(std::int64_t highest);

  // The spheres of the step that is under way.
  void set_spheres(const Spheres &spheres);
  Spheres spheres_on_cpu();                            // the same, in memory of the CPU
  std::vector<std::int64_t> tags;                      // of its spheres; 0: it has none yet
  HostSpheres tagged(const Spheres &spheres) const;    // with these

  const GpuArrays *gpu = nullptr;    // that has the arrays of spheres; null: the host has

  // Throws ApiError where a program's `show` has thrown since the last time. The call in which it did is done before.
  void tell_what_show_threw();

 private:
  void show(const std::string &text, bool is_warning) override;
  PeriodicBox box_;
  lsdcd_message *message_;
  void *data_;
  std::string show_threw_;    // empty: it has not
  lsdcd_host host_ = {};
  std::int64_t highest_tag_ = 0;
  Spheres spheres_;
  // Are spheres on a GPU copied, as somebody has asked for them in this step?
  bool are_copied_ = false;
  std::vector<Real> x_, v_, omega_, radius_, mass_, temperature_;
  std::vector<int> type_;
};

}    // namespace lsdcd
