// What a wall asks of the program that it is part of.
#pragma once

#include "base/real.h"

#include <cstddef>
#include <cstdint>
#include <string>

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

  // Of this process alone. Spheres are counted from 0, in the order of the last step.

  virtual std::int64_t tag(int sphere) = 0;            // the ID of a sphere; 0: spheres have none
  virtual std::int64_t highest_tag() = 0;              // of its spheres; 0: none, or no IDs
  virtual Real radius_of_tag(std::int64_t tag) = 0;    // length; 0: this process has no such sphere
  virtual void log(const std::string &text) = 0;       // shown once, by the first process
  virtual void warn(const std::string &text) = 0;      // shown once, by the first process
};

}    // namespace lsdcd
