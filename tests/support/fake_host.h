// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A host of several processes, each a thread, for tests of the wall without LAMMPS and MPI.
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

class FakeHost : public Host {
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
  int max_rank(Real &number) override;
  void broadcast(void *data, std::size_t bytes, int from) override;
  std::vector<Real> gather(const std::vector<Real> &mine) override;
  void fail_together(const std::string &error) override;
  std::vector<Real> variables(const std::vector<std::string> &names) override;
  void check_variables(const std::vector<std::string> &names) override;
  // Each process is a node of its own.
  std::unique_ptr<NodeMemory> node_memory() override;
  int rank() const override { return rank_; }
  PeriodicBox box() const override { return simulation; }
  SphereGroup group() const override { return wall_group; }
  Spheres spheres_on_cpu() override { return spheres; }
  std::int64_t tag(int sphere) override { return tags.at(sphere); }
  std::int64_t highest_tag() override;
  Real radius_of_tag(std::int64_t tag) override;
  void log(const std::string &text) override { lines.push_back(text); }
  void warn(const std::string &text) override { warnings.push_back(text); }

 private:
  friend void on_processes(int, const std::function<void(FakeHost &)> &);
  struct Meeting;
  using Bytes = std::vector<char>;
  // Waits until all processes have come with the same call. Returns the bytes of each.
  std::vector<Bytes> meet(const std::string &call, const void *data, std::size_t bytes);
  std::vector<std::vector<Real>> meet(const std::string &call, const std::vector<Real> &numbers);

  int rank_ = 0;
  Meeting *meeting_ = nullptr;
};

}    // namespace lsdcd
