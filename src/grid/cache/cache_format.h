// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The layout of a cache file: a front that every version has, the rest of the header, then frames
// of zstd, each with kFrameBytes of the block.
#pragma once

#include "grid/cache/grid_cache.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>
#include <xxhash.h>

namespace lsdcd {

constexpr char kMagic[16] = {'L', 'S', 'D', 'C', 'D', ' ', 'g', 'r',
                             'i', 'd', ' ', 'c', 'a', 'c', 'h', 'e'};
constexpr std::uint64_t kFormat = 3;
constexpr std::size_t kFrameBytes = std::size_t(1) << 20;
constexpr int kLevel = 1;    // of zstd

struct Front {
  char magic[16];
  std::uint64_t format;
  std::uint64_t header_bytes;    // front included
  Hash check;                    // of the header with this field zero
};

inline Hash hash_of(const void *data, std::size_t bytes)
{
  const XXH128_hash_t h = XXH3_128bits(data, bytes);
  return {h.low64, h.high64};
}

// The check of a header whose front has a zero there.
inline Hash check_of(std::vector<char> header)
{
  const Hash zero = {0, 0};
  std::memcpy(header.data() + offsetof(Front, check), &zero, sizeof zero);
  return hash_of(header.data(), header.size());
}

class Packer {
 public:
  template <class T>
  void operator()(const T &value)
  {
    static_assert(std::is_trivially_copyable<T>::value, "kept as bytes");
    const char *at = reinterpret_cast<const char *>(&value);
    bytes.insert(bytes.end(), at, at + sizeof value);
  }
  void operator()(const std::string &text)
  {
    (*this)(std::uint64_t(text.size()));
    bytes.insert(bytes.end(), text.begin(), text.end());
  }
  std::vector<char> bytes;
};

class Unpacker {
 public:
  Unpacker(const std::vector<char> &bytes, std::size_t at) : bytes_(bytes), at_(at) {}
  template <class T>
  void operator()(T &value)
  {
    if (!has(sizeof value)) return;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
  }
  void operator()(std::string &text)
  {
    std::uint64_t size = 0;
    (*this)(size);
    if (!has(size)) return;
    text.assign(bytes_.data() + at_, size);
    at_ += size;
  }
  bool done() const { return good_ && at_ == bytes_.size(); }
  bool has(std::uint64_t n) { return good_ = good_ && n <= bytes_.size() - at_; }

 private:
  const std::vector<char> &bytes_;
  std::size_t at_;
  bool good_ = true;
};

// The bindings name every member, so that a new member does not compile until it is
// listed here too.
template <class Report, class Visit>
void each_field(Report &r, Visit &visit)
{
  auto &[length, cutoff, length_chosen, too_fine, list_kind, lists, records, record_bytes, bytes,
         seconds, device] = r;
  const auto all = [&](auto &...field) { (visit(field), ...); };
  all(length, cutoff, length_chosen, too_fine, list_kind, lists, records, record_bytes, bytes,
      seconds, device);
}

inline std::size_t frames_in(std::size_t bytes)
{
  return (bytes + kFrameBytes - 1) / kFrameBytes;
}

inline std::size_t frame_size(std::size_t frame, std::size_t bytes)
{
  return std::min(kFrameBytes, bytes - frame * kFrameBytes);
}

}    // namespace lsdcd
