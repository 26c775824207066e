// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "grid/cache/grid_cache.h"

#include "backend/threads.h"
#include "grid/cache/cache_format.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zstd.h>

namespace lsdcd {

namespace {

// Reads all of it. False: errno says why, and 0 means that the file ends too early.
bool read_at(int file, std::uint64_t offset, void *to, std::size_t bytes)
{
  char *at = static_cast<char *>(to);
  while (bytes > 0) {
    const ssize_t n = pread(file, at, bytes, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n == 0) errno = 0;
    if (n <= 0) return false;
    at += n;
    offset += n;
    bytes -= n;
  }
  return true;
}

// The magic itself may be damaged: most of its bytes must match.
bool looks_like_ours(const char *start, std::size_t bytes)
{
  std::size_t same = 0;
  for (std::size_t i = 0; i < bytes; i++) same += start[i] == kMagic[i];
  return 2 * same >= bytes;
}

}    // namespace

CachedGrid::CachedGrid(const std::string &path, const GridKey &wanted)
{
  open_and_check(path, wanted);
}

CachedGrid::~CachedGrid()
{
  if (file_ >= 0) close(file_);
}

void CachedGrid::refuse(CacheState state, const std::string &problem)
{
  state_ = state;
  problem_ = problem;
}

void CachedGrid::open_and_check(const std::string &path, const GridKey &wanted)
{
  // Opening a pipe must not wait for a writer.
  file_ = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  struct stat about;
  if (file_ < 0 && errno == ENOENT) return;    // missing
  if (file_ < 0 || fstat(file_, &about) != 0)
    return refuse(CacheState::foreign, std::string("cannot be read: ") + std::strerror(errno));
  if (!S_ISREG(about.st_mode)) return refuse(CacheState::foreign, "is not a file");
  file_bytes_ = about.st_size;

  Front front = {};
  const std::size_t have = std::min(file_bytes_, sizeof front);
  if (!read_at(file_, 0, &front, have))
    return refuse(CacheState::foreign, std::string("cannot be read: ") + std::strerror(errno));
  if (!looks_like_ours(front.magic, std::min(have, sizeof front.magic)))
    return refuse(CacheState::foreign, "is not a grid cache");
  const bool magic = std::memcmp(front.magic, kMagic, sizeof kMagic) == 0;
  if (have < sizeof front || !magic || front.header_bytes < sizeof front ||
      front.header_bytes > file_bytes_)
    return refuse(CacheState::damaged, "is damaged: its first bytes are wrong");

  std::vector<char> header(front.header_bytes);
  if (!read_at(file_, 0, header.data(), header.size()) || !(check_of(header) == front.check))
    return refuse(CacheState::damaged, "is damaged: its header fails the checksum");

  Unpacker take(header, sizeof front);
  GridKey key = {};
  take(key);
  if (front.format != kFormat || !(key.version == wanted.version))
    return refuse(CacheState::other_version, "was written by a different version of LSDCD");
  if (!(key.mesh == wanted.mesh))
    return refuse(CacheState::other_mesh, "belongs to a different mesh");
  if (!(key.settings == wanted.settings))
    return refuse(CacheState::other_settings, "belongs to different settings or radii");

  std::uint64_t block_bytes = 0;
  take(block_bytes);
  each_field(report_, take);
  const std::size_t n_frames = frames_in(block_bytes);
  std::uint64_t end = header.size();
  for (std::size_t i = 0; i < n_frames && take.has(1); i++) {
    Frame frame = {end, 0, {0, 0}};
    take(frame.bytes);
    take(frame.content);
    end += frame.bytes;
    frames_.push_back(frame);
  }
  if (!take.done()) return refuse(CacheState::damaged, "is damaged: its header is too short");
  if (end != file_bytes_)
    return refuse(CacheState::damaged, "is damaged: it has " + std::to_string(file_bytes_) +
                                           " bytes, " + std::to_string(end) + " were written");
  block_bytes_ = block_bytes;
  state_ = CacheState::usable;
}

bool CachedGrid::read_frame(const Frame &frame, std::vector<char> &packed, char *to,
                            std::size_t size) const
{
  return read_at(file_, frame.offset, packed.data(), frame.bytes) &&
         ZSTD_decompress(to, size, packed.data(), frame.bytes) == size &&
         hash_of(to, size) == frame.content;
}

bool CachedGrid::read(char *block)
{
  if (state_ != CacheState::usable) return false;
  std::size_t room = 0;
  for (const Frame &frame : frames_) room = std::max<std::size_t>(room, frame.bytes);
  const std::int64_t n = frames_.size(), at_once = threads();
  std::vector<std::vector<char>> packed(at_once, std::vector<char>(room));
  std::vector<char> good(n, 0);
  for (std::int64_t first = 0; first < n; first += at_once) {
    const std::int64_t last = std::min(n, first + at_once);
#pragma omp parallel for schedule(static, 1) num_threads(at_once) if (at_once > 1)
    for (std::int64_t i = first; i < last; i++)
      good[i] = read_frame(frames_[i], packed[i - first], block + i * kFrameBytes,
                           frame_size(i, block_bytes_));
    for (std::int64_t i = first; i < last; i++)
      if (!good[i]) {
        refuse(CacheState::damaged, "is damaged: part " + std::to_string(i + 1) + " of " +
                                        std::to_string(n) + " fails its checksum");
        return false;
      }
  }
  return true;
}

}    // namespace lsdcd
