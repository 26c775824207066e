// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/named_numbers.h"

#include "base/input_error.h"

#include <cstdint>
#include <cstring>

namespace lsdcd {

namespace {

void put(std::string &bytes, const void *what, std::size_t size)
{
  bytes.append(static_cast<const char *>(what), size);
}

void put_size(std::string &bytes, std::uint64_t size)
{
  put(bytes, &size, sizeof size);
}

// Reads what was put, and never past the end.
class Reader {
 public:
  Reader(const char *at, std::uint64_t size) : at_(at), left_(size) {}

  bool done() const { return left_ == 0; }
  const char *take(std::uint64_t n, std::uint64_t size)
  {
    if (n > left_ / size) throw InputError("the data end early");
    const char *const from = at_;
    at_ += n * size;
    left_ -= n * size;
    return from;
  }
  std::uint64_t take_size()
  {
    std::uint64_t size;
    std::memcpy(&size, take(1, sizeof size), sizeof size);
    return size;
  }

 private:
  const char *at_;
  std::uint64_t left_;
};

}    // namespace

void NamedNumbers::set(const std::string &name, std::vector<Real> numbers)
{
  all_[name] = std::move(numbers);
}

const std::vector<Real> &NamedNumbers::at(const std::string &name, std::size_t least) const
{
  const auto found = all_.find(name);
  if (found == all_.end() || found->second.size() < least)
    throw InputError("the numbers of '" + name + "' are missing");
  return found->second;
}

std::string NamedNumbers::bytes() const
{
  std::string list;
  for (const auto &[name, numbers] : all_) {
    put_size(list, name.size());
    list += name;
    put_size(list, numbers.size());
    put(list, numbers.data(), numbers.size() * sizeof(Real));
  }
  std::string all;
  put_size(all, list.size());
  return all + list;
}

NamedNumbers NamedNumbers::from(const char *bytes)
{
  NamedNumbers all;
  std::uint64_t size;
  std::memcpy(&size, bytes, sizeof size);
  Reader reader(bytes + sizeof size, size);
  while (!reader.done()) {
    const std::uint64_t length = reader.take_size();
    const std::string name(reader.take(length, 1), length);
    const std::uint64_t n = reader.take_size();
    std::vector<Real> numbers(n <= size ? n : 0);
    const char *const from = reader.take(n, sizeof(Real));
    if (n > 0) std::memcpy(numbers.data(), from, n * sizeof(Real));
    all.set(name, std::move(numbers));
  }
  return all;
}

}    // namespace lsdcd
