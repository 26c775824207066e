// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "grid/cache/load_or_build.h"

#include "grid/cache/grid_cache.h"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>

namespace lsdcd {

namespace {

class StopWatch {
 public:
  std::string text() const
  {
    const std::chrono::duration<double> passed = Clock::now() - start_;
    char text[32];
    std::snprintf(text, sizeof text, "%.3f s", passed.count());
    return text;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

std::uint64_t of_first(Host &host, std::uint64_t number)
{
  host.broadcast(&number, sizeof number, 0);
  return number;
}

// Gives up the last block first.
void allocate(Host &host, NodeMemory &memory, std::size_t bytes)
{
  memory = NodeMemory();
  memory = host.node_memory(bytes);
}

// `cached`: null but on the first process.
bool read(const std::string &file, CachedGrid *cached, Host &host, NodeMemory &memory,
          LoadedGrid &out)
{
  const StopWatch watch;
  const bool usable = cached && cached->state() == CacheState::usable;
  const std::uint64_t bytes = of_first(host, usable ? cached->block_bytes() : 0);
  if (bytes == 0) return false;
  allocate(host, memory, bytes);
  bool good = false;
  run_collectively(host, cached, [&] { good = cached->read(memory.block.get()); });
  out.from_cache = of_first(host, good);
  if (!out.from_cache) return false;
  host.broadcast(memory.block.get(), memory.bytes, 0, Receivers::that_fill_memory);
  host.publish(memory);
  if (cached) {
    out.report = cached->report();
    out.cache_text = "not built now, read from cache '" + file + "' in " + watch.text();
  }
  return true;
}

void build(const WeldedMesh &mesh, const AnyGridSettings &settings, bool on_cuda, Host &host,
           NodeMemory &memory, LoadedGrid &out)
{
  std::unique_ptr<TriangleGrid> grid;
  std::size_t bytes = 0;
  run_collectively(host, host.ranks().fills_memory, [&] {
    grid = std::make_unique<TriangleGrid>(build_any_grid(mesh, settings, on_cuda));
    bytes = flat_bytes(*grid);
    out.report = grid->report;
  });
  allocate(host, memory, bytes);
  if (grid) move_flat(*grid, memory.block.get());
  host.publish(memory);
}

void write(const std::string &file, const GridKey &key, const CachedGrid &cached, const char *block,
           LoadedGrid &out)
{
  const StopWatch watch;
  const bool missing = cached.state() == CacheState::missing;
  if (!missing) out.cache_warning = "cache '" + file + "' " + cached.problem();
  if (cached.state() == CacheState::foreign) {
    out.cache_warning += "; it stays as it is, and the grid is not kept: name another file";
    return;
  }
  std::size_t written;
  try {
    written = write_grid_cache(file, key, out.report, block, flat_view(block).block_bytes);
  } catch (const std::exception &e) {
    out.cache_warning += (missing ? "the grid is not kept: cache " : "; it was not replaced: ") +
                         std::string(e.what());
    return;
  }
  if (!missing) out.cache_warning += "; the grid was built and the file replaced";
  char size[32];
  std::snprintf(size, sizeof size, "%.1f MB", written / 1e6);
  out.cache_text = "written to cache '" + file + "', " + size + " in " + watch.text();
}

}    // namespace

LoadedGrid load_or_build_grid(const std::string &cache_file, const WeldedMesh &mesh,
                              const AnyGridSettings &settings, bool on_cuda, Host &host,
                              NodeMemory &memory)
{
  LoadedGrid out;
  GridKey key = {};
  std::unique_ptr<CachedGrid> cached;
  run_collectively(host, host.is_first() && !cache_file.empty(), [&] {
    key = grid_key(mesh, settings);
    cached = std::make_unique<CachedGrid>(cache_file, key);
  });
  if (!cache_file.empty() && read(cache_file, cached.get(), host, memory, out)) return out;
  build(mesh, settings, on_cuda, host, memory, out);
  if (cached) write(cache_file, key, *cached, memory.block.get(), out);
  return out;
}

}    // namespace lsdcd
