// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a wall asks of the program that it is part of.
#pragma once

#include "base/error_text.h"
#include "engine/wall_engine.h"
#include "mesh/periodic_box.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace lsdcd {

// Memory that one process of each node fills, and that all processes of the node read.
class NodeMemory {
 public:
  virtual ~NodeMemory() = default;

  // Collective over all processes.

  // Gives up the last block and makes one of `bytes` (the writer's number counts), 64-byte aligned.
  // Only the writer may write to it, before publish(). Throws InputError on all processes.
  virtual char *allocate(std::size_t bytes) = 0;
  virtual void publish() = 0;

  // On processes that write: `bytes` bytes of the first process replace those of the others.
  virtual void broadcast_to_writers(void *data, std::size_t bytes) = 0;

  virtual bool
  writes() const = 0;    // is this the process of its node that does? The first process is
  virtual int node_rank() const = 0;     // from 0, which writes
  virtual int node_size() const = 0;     // processes of this node
  virtual bool is_shared() const = 0;    // false: each process has a copy of the block
  virtual const char *block() const = 0;
  virtual std::size_t bytes() const = 0;    // of the block
};

// The spheres that a wall acts on, as messages name them.
struct SphereGroup {
  std::string name;
  bool changes = false;    // spheres may join and leave it between steps
};

inline bool is_in_group(const Spheres &s, int i)
{
  return !s.mask || (s.mask[i] & s.group_bit);
}

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
  // same on all processes. Throws InputError where there is no such variable or number.
  virtual std::vector<Real> variables(const std::vector<std::string> &names) = 0;
  // Throws InputError where a variable with one of these names is missing.
  virtual void check_variables(const std::vector<std::string> &names) = 0;
  virtual std::unique_ptr<NodeMemory> node_memory() = 0;

  // Of this process alone. Spheres are counted from 0, in the order of the last step.

  virtual int rank() const = 0;             // from 0, which is the first process
  virtual PeriodicBox box() const = 0;      // the same on all processes
  virtual SphereGroup group() const = 0;    // likewise
  // The spheres of this process as they are now: places, radii, masses and group, in memory of the CPU.
  virtual Spheres spheres_on_cpu() = 0;
  // How far one of them is past a periodic face of the box, at most; length.
  virtual Real farthest_past(const PeriodicBox &box)
  {
    const Spheres s = spheres_on_cpu();
    const PeriodicFaces faces = periodic_faces(box);
    Real past = 0;
    for (int i = 0; i < s.n; i++)
      if (is_in_group(s, i)) past = std::max(past, faces.past(s.x[i]));
    return past;
  }
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

// A text of the process `from` replaces those of the others. Collective.
inline void broadcast_text(Host &host, std::string &text, int from = 0)
{
  std::uint64_t size = text.size();
  host.broadcast(&size, sizeof size, from);
  text.resize(size);
  host.broadcast(&text[0], size, from);
}

// An error of this process alone; the others may go on until the program ends them.
struct ProcessError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}    // namespace lsdcd
