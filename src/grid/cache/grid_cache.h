// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A grid in a file, so that the next start does not build it again. A file is used only
// if it is whole and was written for the same mesh and settings by the same sources.
// Nothing in it is trusted before.
#pragma once

#include "grid/triangle_grid.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lsdcd {

struct Hash {
  std::uint64_t low, high;
};
inline bool operator==(const Hash &a, const Hash &b)
{
  return a.low == b.low && a.high == b.high;
}

// Everything that a flat block depends on.
struct GridKey {
  Hash version;    // of the sources that make it, and how this machine lays it out
  Hash mesh;       // placed and welded, bit for bit
  Hash settings;
};

GridKey grid_key(const WeldedMesh &mesh, const AnyGridSettings &settings);

// The state of the file with a cache's name.
enum class CacheState {
  usable,
  missing,
  damaged,
  other_version,
  other_mesh,
  other_settings,
  foreign,    // not a cache, or not readable: never replaced
};

// A cache file, opened and its header checked; the grid itself is read by read().
class CachedGrid {
 public:
  CachedGrid(const std::string &path, const GridKey &wanted);
  ~CachedGrid();
  CachedGrid(const CachedGrid &) = delete;
  CachedGrid &operator=(const CachedGrid &) = delete;

  CacheState state() const { return state_; }
  const std::string &problem() const { return problem_; }    // "is damaged: ...", or empty
  const GridReport &report() const { return report_; }       // of the build
  std::size_t block_bytes() const { return block_bytes_; }

  // Fills a block of block_bytes(), as flatten() made it. False if the file is damaged: state()
  // and problem() say how, and the block has no meaning.
  bool read(char *block);

 private:
  struct Frame {
    std::uint64_t offset, bytes;    // in the file
    Hash content;                   // of what it unpacks to
  };

  void open_and_check(const std::string &path, const GridKey &wanted);
  void refuse(CacheState state, const std::string &problem);
  bool read_frame(const Frame &frame, std::vector<char> &packed, char *to, std::size_t size) const;

  int file_ = -1;
  CacheState state_ = CacheState::missing;
  std::string problem_;
  GridReport report_;
  std::size_t block_bytes_ = 0, file_bytes_ = 0;
  std::vector<Frame> frames_;
};

// Writes a flat block, atomically; returns the bytes of the file. Throws InputError
// where it cannot be written.
std::size_t write_grid_cache(const std::string &path, const GridKey &key, const GridReport &report,
                             const char *block, std::size_t block_bytes);

}    // namespace lsdcd
