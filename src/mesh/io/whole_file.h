// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// All bytes of a mesh file; private to the mesh room.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <string>

namespace lsdcd {

struct FileBytes {
  std::unique_ptr<char[]> data;    // not a vector, which would be cleared first
  std::size_t size = 0;
};

constexpr std::size_t kAllBytes = std::numeric_limits<std::size_t>::max();

// Looks at the first `n` bytes of a longer file before the rest is read. `size` is the file's, 0 where
// it has none, as a pipe. Returns how many bytes are read at most; throws if the file cannot be one of
// its format.
using CheckBeginning =
    std::function<std::size_t(const char *bytes, std::size_t n, std::size_t size)>;

// Throws InputError that names the file, why it cannot be read, and the remedy.
FileBytes read_whole_file(const std::string &path, const CheckBeginning &check = {});

}    // namespace lsdcd
