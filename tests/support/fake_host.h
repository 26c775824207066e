// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A host of several processes, each a thread and a node of its own, for tests of the wall without LAMMPS and MPI.
#pragma once

#include "wall/host.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace lsdcd {

class FakeHost;

// Calls `work` on each of n processes, and returns when all are done. Throws what a process threw,
// and std::logic_error where the processes do not make the same collective calls in the same order.
void on_processes(int n, const std::function<void(FakeHost &)> &work);

class FakeHost : public WallHost {
 public:
  // What a test gives, and finds.
  std::vector<std::int64_t> tags;        // of the spheres of this process
  std::vector<Real> radii;               // of them
  std::map<std::string, Real> values;    // of variables
  Spheres spheres;                       // of this process
  PeriodicBox simulation;                // its box
  SphereGroup wall_group = {"all", false};
  std::vector<std::string> lines, warnings;    // of this process, whatever its rank

  void sum(Real *numbers, int n) override;
  void max(Real *numbers, int n) override;
  void broadcast(void *data, std::size_t bytes, int from, Receivers to = Receivers::all) override;
  std::vector<Real> variables(const std::vector<std::string> &names) override;
  void check_variables(const std::vector<std::string> &names) override;
  PeriodicBox box() const override { return simulation; }
  SphereGroup group() const override { return wall_group; }
  Spheres spheres_on_cpu() override { return spheres; }
  std::int64_t tag(int sphere) override { return tags.at(sphere); }
  std::int64_t highest_tag() override;
  Real radius_of_tag(std::int64_t tag) override;

 private:
  friend void on_processes(int, const std::function<void(FakeHost &)> &);
  struct Meeting;
  using Bytes = std::vector<char>;
  // Waits until all processes have come with the same call. Returns the bytes of each.
  std::vector<Bytes> meet(const std::string &call, const void *data, std::size_t bytes);
  std::vector<std::vector<Real>> meet(const std::string &call, const std::vector<Real> &numbers);

  void show(const std::string &text, bool is_warning) override
  {
    (is_warning ? warnings : lines).push_back(text);
  }

  Meeting *meeting_ = nullptr;
};

}    // namespace lsdcd
