// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A host of several processes, each a thread and a node of its own, for tests of the wall without LAMMPS and MPI.
#pragma once

#include "host/host.h"

#include <functional>
#include <string>
#include <vector>

namespace lsdcd {

class FakeHost;

// Calls `work` on each of n processes, and returns when all are done. Throws what a process threw,
// and std::logic_error where the processes do not make the same collective calls in the same order.
void on_processes(int n, const std::function<void(FakeHost &)> &work);

class FakeHost : public Host {
 public:
  PeriodicBox simulation;                      // its box, which a test gives
  std::vector<std::string> lines, warnings;    // of this process, whatever its rank

  void sum(Real *numbers, int n) override;
  void max(Real *numbers, int n) override;
  void broadcast(void *data, std::size_t bytes, int from, Receivers to = Receivers::all) override;
  PeriodicBox box() const override { return simulation; }

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

// Returns the lines or warnings of the first of n processes, after `work` on each.
inline std::vector<std::string> shown(std::vector<std::string> FakeHost::*what, int n,
                                      const std::function<void(FakeHost &)> &work)
{
  std::vector<std::string> first;
  on_processes(n, [&](FakeHost &host) {
    work(host);
    if (host.rank() == 0) first = host.*what;
  });
  return first;
}

}    // namespace lsdcd
