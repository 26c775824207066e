// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The program that LSDCD is part of: its processes, its box and its log.
#pragma once

#include "base/error_text.h"
#include "base/real.h"
#include "box/periodic_box.h"
#include "host/host_names.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsdcd {

// One process among all of a program.
struct Ranks {
  int rank = 0, processes = 1;         // rank 0 is the first process
  int node_rank = 0, node_size = 1;    // of this process among those of its node, and their number
  bool fills_memory =
      true;    // it fills the memory of its node; the first process is one that does
};

// Memory that one process of each node fills, and that all processes of the node read.
struct NodeMemory {
  std::shared_ptr<char>
      block;    // aligned to 64 bytes; all processes of the node give it up together
  std::size_t bytes = 0;
  bool is_shared = false;    // false: each process has a copy of the block
};

// The processes that get what another one sends.
enum class Receivers { all, that_fill_memory };

// The program that LSDCD is part of, one object per process. The default is one process, an unbounded box and no log.
// Override what your program has.
class Host {
 public:
  virtual ~Host() = default;

  const Ranks &ranks() const { return ranks_; }
  int rank() const { return ranks_.rank; }
  int processes() const { return ranks_.processes; }
  bool is_first() const { return ranks_.rank == 0; }

  // Collective: all processes call these in the same order.

  // Replaces each of the n numbers by its sum over all processes.
  virtual void sum(Real * /*numbers*/, int /*n*/) {}
  // Replaces each of the n numbers by the largest of all processes.
  virtual void max(Real * /*numbers*/, int /*n*/) {}
  // Does sum() and max() in one message, where the host can: n sums and m largest numbers.
  virtual void sum_and_max(Real *sums, int n, Real *largest, int m)
  {
    sum(sums, n);
    max(largest, m);
  }
  // Sends `bytes` bytes of the process `from` to the receivers, which get them in place of their own; other processes
  // may pass null. Only the first process sends to those that fill memory.
  virtual void broadcast(void * /*data*/, std::size_t /*bytes*/, int /*from*/,
                         Receivers /*to*/ = Receivers::all)
  {
  }
  // Returns the numbers of all processes, by rank, on the first process, and none on the others.
  virtual std::vector<Real> gather(const std::vector<Real> &mine);
  // Makes memory that all processes of a node share. `bytes` is read on processes that fill memory, and only they may
  // write to the block, before publish(). Throws on all processes where one has no room.
  virtual NodeMemory node_memory(std::size_t bytes);
  virtual void publish(const NodeMemory & /*memory*/) {}
  // Returns the sum of force times velocity over the nodes of a mesh that are this process's, if the program has their
  // velocities of the whole step, which they have now; else nothing. `force`: on each node, x y z, node after node.
  virtual std::optional<Real> power_on_nodes(int /*mesh*/, const std::vector<Real> & /*force*/)
  {
    return {};
  }

  // A process may call these on its own.

  virtual PeriodicBox box() const    // the same on all processes
  {
    return PeriodicBox::anywhere();
  }
  void log(const std::string &text) { show(text, false); }
  void warn(const std::string &text) { show(text, true); }
  const HostNames &names() const { return names_; }
  // Names the sphere that has this tag: "sphere 7".
  virtual std::string sphere_text(std::int64_t tag) const
  {
    return names_.sphere + (" " + std::to_string(tag));
  }

 protected:
  // Shows a text once, by the first process.
  virtual void show(const std::string & /*text*/, bool /*is_warning*/) {}

  Ranks ranks_;
  HostNames names_;
};

// The functions below are collective: all processes call them together.

// Returns the lowest rank where `here`; the number of processes where there is none.
int lowest_rank(Host &host, bool here);

// Replaces each number by its sum over all processes, which must fit into 64 bits, by Host::sum(). Each goes as two
// numbers of 32 bits, of which 2^21 processes have sums of at most 2^53: they are exact, as is each part of
// them, in whatever order a program adds.
void sum_exactly(Host &host, std::vector<std::int64_t> &numbers);

// Replaces `text` on all processes by that of the process `from`.
void broadcast_text(Host &host, std::string &text, int from = 0);

// Throws InputError on all processes if `error` is not empty on one of them, with the text of the lowest such rank.
void fail_together(Host &host, const std::string &error);

// Runs `work` on processes where `here` is true. What it throws on one of them is thrown on all, as InputError; a
// process on its own throws it as it is.
template <class Work>
void run_collectively(Host &host, bool here, Work &&work)
{
  if (host.processes() > 1)
    fail_together(host, here ? error_of(std::forward<Work>(work)) : "");
  else if (here)
    work();
}

}    // namespace lsdcd
