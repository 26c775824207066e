// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a wall asks of the program that it is part of.
#pragma once

#include "base/error_text.h"
#include "base/real.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lsdcd {

// There is one object per process. All processes call the collective functions, in the same order.
class Host {
 public:
  virtual ~Host() = default;

  // Collective.

  // Each of the n numbers becomes the sum over all processes.
  virtual void sum(Real *numbers, int n) = 0;
  // Each of the n numbers becomes the largest of all processes.
  virtual void max(Real *numbers, int n) = 0;
  // The number becomes the largest of all processes. Returns the lowest rank that has it.
  virtual int max_rank(Real &number) = 0;
  // `bytes` bytes of the process `from` replace those of the others.
  virtual void broadcast(void *data, std::size_t bytes, int from) = 0;

  // The numbers of all processes, by rank, on the first process; the others get none.
  virtual std::vector<Real> gather(const std::vector<Real> &mine) = 0;
  // Throws InputError on all processes if a text is not empty: that of the lowest such rank.
  virtual void fail_together(const std::string &error) = 0;

  // Values of the program's variables with these names in this step, in this order: finite, and the
  // same on all processes. The program ends the run where there is no such variable or number.
  virtual std::vector<Real> variables(const std::vector<std::string> &names) = 0;

  // Of this process alone. Spheres are counted from 0, in the order of the last step.

  virtual int rank() const = 0;                        // from 0, which is the first process
  virtual std::int64_t tag(int sphere) = 0;            // the ID of a sphere; 0: spheres have none
  virtual std::int64_t highest_tag() = 0;              // of its spheres; 0: none, or no IDs
  virtual Real radius_of_tag(std::int64_t tag) = 0;    // length; 0: this process has no such sphere
  virtual void log(const std::string &text) = 0;       // shown once, by the first process
  virtual void warn(const std::string &text) = 0;      // shown once, by the first process
};

// Runs `work` where `here`. What it throws is thrown on all processes, as InputError. Collective.
template <class Work>
void run_collectively(Host &host, bool here, Work &&work)
{
  host.fail_together(here ? error_of(work) : "");
}

}    // namespace lsdcd
