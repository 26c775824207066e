// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// An open-addressing hash table from keys that the caller stores to their indices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace lsdcd {

inline std::uint64_t mix_bits(std::uint64_t h)
{
  h ^= h >> 32;
  h *= 0x9e3779b97f4a7c15u;
  h ^= h >> 29;
  h *= 0xd6e8feb86659fd93u;
  return h ^ (h >> 32);
}

template <class Word>
std::uint64_t hash_three(Word a, Word b, Word c)
{
  static_assert(sizeof(Word) == 8, "hashed as bits");
  std::uint64_t bits[3];
  const Word words[3] = {a, b, c};
  std::memcpy(bits, words, sizeof bits);
  return mix_bits(mix_bits(mix_bits(bits[0]) + bits[1]) + bits[2]);
}

class HashIndex {
 public:
  HashIndex() : buckets_(1024, Bucket{0, kNone}) {}

  static constexpr int kNone = -1;

  // Returns the index stored under this hash for which is_same(index) holds, or kNone.
  template <class IsSame>
  int find(std::uint64_t hash, IsSame is_same) const
  {
    return buckets_[find_bucket(static_cast<std::uint32_t>(hash), is_same)].index;
  }

  // Returns the index that find() would find. Where there is none, it stores `fresh` and returns that.
  template <class IsSame>
  int find_or_insert(std::uint64_t hash, int fresh, IsSame is_same)
  {
    const auto tag = static_cast<std::uint32_t>(hash);
    Bucket &bucket = buckets_[find_bucket(tag, is_same)];
    if (bucket.index != kNone) return bucket.index;
    bucket = {tag, fresh};
    if (++n_used_ > buckets_.size() / 2) grow();
    return fresh;
  }

 private:
  struct Bucket {
    std::uint32_t tag;
    int index;
  };

  template <class IsSame>
  std::size_t find_bucket(std::uint32_t tag, IsSame is_same) const
  {
    const std::size_t mask = buckets_.size() - 1;
    std::size_t at = tag & mask;
    while (buckets_[at].index != kNone && !(buckets_[at].tag == tag && is_same(buckets_[at].index)))
      at = (at + 1) & mask;
    return at;
  }

  void grow()
  {
    std::vector<Bucket> old(2 * buckets_.size(), Bucket{0, kNone});
    std::swap(old, buckets_);
    const auto never = [](int) { return false; };
    for (const Bucket &bucket : old)
      if (bucket.index != kNone) buckets_[find_bucket(bucket.tag, never)] = bucket;
  }

  std::vector<Bucket> buckets_;    // a power of two of them
  std::size_t n_used_ = 0;
};

}    // namespace lsdcd
