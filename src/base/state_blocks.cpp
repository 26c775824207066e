// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/state_blocks.h"

#include <xxhash.h>

#include <algorithm>
#include <cmath>

#if XXH_VERSION_NUMBER < 800
#error "xxHash 0.8 or later is needed: earlier ones have no stable XXH3"
#endif

namespace lsdcd {

namespace {

constexpr int kFormat = 2;    // of the list of blocks
constexpr std::size_t kBytes = 6;

std::size_t numbers_for(std::size_t bytes)
{
  return (bytes + kBytes - 1) / kBytes;
}

}    // namespace

std::uint64_t checksum(const Real *numbers, std::size_t n)
{
  return XXH3_64bits(numbers, n * sizeof(Real)) >> 11;
}

const Real State::kMark = -0x4c5344434453;    // "LSDCDS"

void StateWriter::put(const std::string &text)
{
  put(text.size());
  for (std::size_t at = 0; at < text.size(); at += kBytes) {
    std::uint64_t number = 0;
    for (std::size_t k = std::min(kBytes, text.size() - at); k-- > 0;)
      number = number << 8 | static_cast<unsigned char>(text[at + k]);
    put(number);
  }
}

void StateReader::fail(const std::string &problem) const
{
  throw StateError(where_ + " " + problem);
}

const Real *StateReader::take_numbers(std::size_t n)
{
  if (n > left_) fail("ends early");
  const Real *const from = at_;
  at_ += n;
  left_ -= n;
  return from;
}

std::int64_t StateReader::take_integer()
{
  const Real number = *take_numbers(1);
  if (!(std::fabs(number) <= 0x1p53) || number != std::floor(number))
    fail("has a number where an integer is expected");
  return static_cast<std::int64_t>(number);
}

std::size_t StateReader::take_count()
{
  const std::int64_t n = take_integer();
  if (n < 0) fail("has a count below 0");
  if (static_cast<std::uint64_t>(n) > left_) fail("ends early");
  return static_cast<std::size_t>(n);
}

void StateReader::take(std::string &text)
{
  const std::int64_t size = take_integer();
  if (size < 0 || numbers_for(static_cast<std::size_t>(size)) > left_) fail("ends early");
  text.clear();
  while (text.size() < static_cast<std::size_t>(size)) {
    std::int64_t number = take_integer();
    for (std::size_t k = 0; k < kBytes && text.size() < static_cast<std::size_t>(size); k++) {
      text += static_cast<char>(number & 0xff);
      number >>= 8;
    }
  }
}

State::State(const std::string &kind, const Real *numbers, std::size_t n) : kind_(kind)
{
  const std::string data = "the data of the " + kind;
  if (n == 0 || numbers[0] != kMark)
    throw StateError(data + " are of a different program or version");
  StateReader head(numbers + 1, n - 1, data);
  const std::int64_t format = head.next<std::int64_t>();
  if (format != kFormat)
    head.fail(format > kFormat ? "are of a later version" : "are of an earlier version");
  const Real sum = head.next<Real>();
  const std::size_t size = head.take_count();
  const Real *const from = head.take_numbers(size);
  if (sum != static_cast<Real>(checksum(from, size)))
    head.fail("are damaged: their checksum is not that of what was written");
  StateReader in(from, size, data);
  const std::string found = in.next<std::string>();
  if (found != kind) throw StateError("these are data of the " + found + ", not of the " + kind);
  add_blocks(in);
}

void State::add_blocks(StateReader &in)
{
  while (in.left() > 0) {
    Block block;
    in(block.name, block.version);
    const std::size_t size = in.take_count();
    const Real *const from = in.take_numbers(size);
    block.numbers.assign(from, from + size);
    blocks_.push_back(std::move(block));
  }
}

void State::add(const std::string &name, int version, const State &inside)
{
  StateWriter out;
  inside.write_blocks(out);
  blocks_.push_back({name, version, out.all()});
}

void State::write_blocks(StateWriter &out) const
{
  for (const Block &block : blocks_) out(block.name, block.version, block.numbers);
}

std::vector<Real> State::numbers() const
{
  StateWriter blocks, all;
  blocks(kind_);
  write_blocks(blocks);
  all(kMark, kFormat, checksum(blocks.all().data(), blocks.all().size()), blocks.all());
  return all.all();
}

std::string State::where(const std::string &name) const
{
  return "the block '" + name + "'" + of_ + " in the data of the " + kind_;
}

void State::check_version(const Block &block, int version) const
{
  block.is_read = true;
  if (block.version > version)
    throw StateError(where(block.name) + " is of version " + std::to_string(block.version) +
                     ", and this program knows it up to version " + std::to_string(version));
}

const State::Block *State::block_of(const std::string &name, int version) const
{
  for (const Block &block : blocks_)
    if (block.name == name) {
      check_version(block, version);
      return &block;
    }
  return nullptr;
}

std::vector<State> State::inside(const std::string &name, int version) const
{
  std::vector<State> all;
  for (const Block &block : blocks_) {
    if (block.name != name) continue;
    check_version(block, version);
    State &one = all.emplace_back(kind_);
    one.of_ = " of " + name + " " + std::to_string(all.size()) + of_;
    StateReader in(block.numbers.data(), block.numbers.size(),
                   "the block '" + name + "' number " + std::to_string(all.size()) +
                       " in the data of the " + kind_);
    one.add_blocks(in);
  }
  return all;
}

std::string State::unread() const
{
  std::string names;
  for (const Block &block : blocks_)
    if (!block.is_read) names += (names.empty() ? "'" : ", '") + block.name + "'" + of_;
  return names;
}

}    // namespace lsdcd
