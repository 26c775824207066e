// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The data of a restart file: numbers in blocks that have a name and a version.
//
// As numbers a state is kMark, the format of the list, a checksum of what follows the next number, how many numbers
// there are in all, the kind of the state, and its blocks. A block is its name, its version, how many numbers follow, and these; they may be blocks again. A text
// is its length and its bytes, six in a number, so that each number is an integer below 2^48 and exact.
#pragma once

#include "base/input_error.h"
#include "base/vec3.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace lsdcd {

// Returns the upper 53 bits of the 64-bit XXH3 of the numbers' bytes, so that a number holds it exactly.
std::uint64_t checksum(const Real *numbers, std::size_t n);

// The data end early, are damaged, of something else or of another version. Hosts add what to do.
struct StateError : InputError {
  using InputError::InputError;
};

// Both call each_number(numbers, value) for a struct, a template that its room declares once for reading and
// writing: it passes the members, in the order of the file, to numbers(...). Integers are exact up to 2^53.
class StateWriter {
 public:
  template <class... T>
  void operator()(const T &...values)
  {
    (put(values), ...);
  }
  const std::vector<Real> &all() const { return numbers_; }

 private:
  void put(const Vec3 &v) { (*this)(v.x, v.y, v.z); }
  void put(const std::string &text);
  template <class T>
  void put(const std::vector<T> &list)
  {
    put(list.size());
    for (const T &one : list) put(one);
  }
  template <class T>
  void put(const T &value)
  {
    if constexpr (std::is_same_v<T, long double>) {    // in two parts
      const Real high = static_cast<Real>(value);
      (*this)(high, static_cast<Real>(value - high));
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      numbers_.push_back(static_cast<Real>(value));
    } else if constexpr (std::is_array_v<T>) {
      for (const auto &one : value) put(one);
    } else {
      each_number(*this, const_cast<T &>(value));    // which only reads it here
    }
  }

  std::vector<Real> numbers_;
};

// Throws StateError, which names `where`, before it reads past the end.
class StateReader {
 public:
  StateReader(const Real *numbers, std::size_t n, std::string where) :
      at_(numbers), left_(n), where_(std::move(where))
  {
  }

  template <class... T>
  void operator()(T &...values)
  {
    (take(values), ...);
  }
  template <class T>
  T next()
  {
    T value = {};
    take(value);
    return value;
  }
  const Real *take_numbers(std::size_t n);    // where these are
  // Returns how many things follow, of one number each at least.
  std::size_t take_count();
  std::size_t left() const { return left_; }
  [[noreturn]] void fail(const std::string &problem) const;

 private:
  void take(Vec3 &v) { (*this)(v.x, v.y, v.z); }
  void take(std::string &text);
  template <class T>
  void take(std::vector<T> &list)
  {
    list.clear();
    for (std::size_t n = take_count(); n > 0; n--) list.push_back(next<T>());
  }
  template <class T>
  void take(T &value)
  {
    if constexpr (std::is_same_v<T, long double>) {
      const Real high = next<Real>();
      value = static_cast<long double>(high) + next<Real>();
    } else if constexpr (std::is_floating_point_v<T>) {
      value = *take_numbers(1);
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      value = static_cast<T>(take_integer());
    } else if constexpr (std::is_array_v<T>) {
      for (auto &one : value) take(one);
    } else {
      each_number(*this, value);
    }
  }
  std::int64_t take_integer();

  const Real *at_;
  std::size_t left_;
  std::string where_;
};

// Blocks in the order in which they were added. Several may have one name.
class State {
 public:
  // `kind`: what the state is of, as "wall": data of another kind are refused.
  explicit State(std::string kind) : kind_(std::move(kind)) {}
  // Reads at most n numbers. Throws StateError where they are no state of this kind, or not what was written.
  State(const std::string &kind, const Real *numbers, std::size_t n);

  template <class T>
  void add(const std::string &name, int version, const T &value)
  {
    StateWriter out;
    out(value);
    blocks_.push_back({name, version, out.all()});
  }
  void add(const std::string &name, int version, const State &inside);

  // Reads a block that this program knows in versions up to `version`; a later one is refused, and so is a block that
  // is longer than what was read. False: there is none, and `value` stays as it is.
  template <class T>
  bool find(const std::string &name, int version, T &value) const
  {
    const Block *block = block_of(name, version);
    if (!block) return false;
    StateReader in(block->numbers.data(), block->numbers.size(), where(name));
    in(value);
    if (in.left() > 0) in.fail("is too long");
    return true;
  }
  // Reads a block as find() does. Throws StateError where the block is not there.
  template <class T>
  void read(const std::string &name, int version, T &value) const
  {
    if (!find(name, version, value)) throw StateError(where(name) + " is missing");
  }
  // All blocks of this name, with the blocks in them.
  std::vector<State> inside(const std::string &name, int version) const;

  // Blocks that nobody has read, as "'nodes' of mesh 2", for a warning or an error; empty: all were read.
  std::string unread() const;

  std::vector<Real> numbers() const;

 private:
  static const Real kMark;    // what the numbers of every state begin with

  struct Block {
    std::string name;
    int version;
    std::vector<Real> numbers;
    mutable bool is_read = false;
  };

  void add_blocks(StateReader &in);
  void write_blocks(StateWriter &out) const;
  const Block *block_of(const std::string &name, int version) const;
  void check_version(const Block &block, int version) const;
  std::string where(const std::string &name) const;

  std::string kind_, of_;    // of_: " of mesh 2", for messages
  std::vector<Block> blocks_;
};

}    // namespace lsdcd
