// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "host/host.h"

#include "base/input_error.h"
#include "base/large_memory.h"

#include <cstdint>

namespace lsdcd {

// The sizes come first, then the numbers of one process after the other.
std::vector<Real> Host::gather(const std::vector<Real> &mine)
{
  if (processes() == 1) return mine;
  std::vector<Real> sizes(static_cast<std::size_t>(processes()), 0), all, of_one;
  sizes[static_cast<std::size_t>(rank())] = static_cast<Real>(mine.size());
  sum(sizes.data(), processes());
  for (int from = 0; from < processes(); from++) {
    of_one = mine;
    of_one.resize(static_cast<std::size_t>(sizes[static_cast<std::size_t>(from)]));
    broadcast(of_one.data(), of_one.size() * sizeof(Real), from);
    if (is_first()) all.insert(all.end(), of_one.begin(), of_one.end());
  }
  return all;
}

NodeMemory Host::node_memory(std::size_t bytes)
{
  NodeMemory memory;
  memory.bytes = bytes;
  run_collectively(*this, true, [&] {
    if (bytes > 0)
      memory.block = {static_cast<char *>(LargeMemory::allocate(bytes)), LargeMemory::free};
  });
  return memory;
}

int lowest_rank(Host &host, bool here)
{
  Real first = here ? host.processes() - host.rank() : 0;
  host.max(&first, 1);
  return host.processes() - static_cast<int>(first);
}

void sum_exactly(Host &host, std::vector<std::int64_t> &numbers)
{
  constexpr int kMostProcesses = 1 << 21;
  if (host.processes() == 1) return;
  if (host.processes() > kMostProcesses)
    throw InputError("forces on the nodes of a mesh are summed over at most " +
                     std::to_string(kMostProcesses) + " processes: use fewer of them");
  std::vector<Real> halves;
  for (const std::int64_t x : numbers) {
    halves.push_back(static_cast<Real>(x >> 32));    // rounded down
    halves.push_back(static_cast<Real>(static_cast<std::uint32_t>(x)));
  }
  host.sum(halves.data(), static_cast<int>(halves.size()));
  for (std::size_t k = 0; k < numbers.size(); k++) {
    const auto high = static_cast<std::uint64_t>(static_cast<std::int64_t>(halves[2 * k])),
               low = static_cast<std::uint64_t>(halves[2 * k + 1]);
    numbers[k] = static_cast<std::int64_t>((high << 32) + low);
  }
}

void broadcast_text(Host &host, std::string &text, int from)
{
  std::uint64_t size = text.size();
  host.broadcast(&size, sizeof size, from);
  text.resize(size);
  host.broadcast(&text[0], size, from);
}

void fail_together(Host &host, const std::string &error)
{
  const int from = lowest_rank(host, !error.empty());
  if (from == host.processes()) return;
  std::string text = error;
  broadcast_text(host, text, from);
  throw InputError(text);
}

}    // namespace lsdcd
