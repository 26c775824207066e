// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/io/whole_file.h"

#include "base/input_error.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace lsdcd {

FileBytes read_whole_file(const std::string &path, const CheckBeginning &check)
{
  constexpr std::size_t kBeginning = 65536;
  const auto fail = [&](const char *why) {
    return InputError(path + ": cannot read the mesh: " + why +
                      "; give the path of a mesh file that this user can read");
  };
  std::unique_ptr<std::FILE, int (*)(std::FILE *)> file(std::fopen(path.c_str(), "rb"),
                                                        std::fclose);
  if (!file) throw fail(std::strerror(errno));
  struct stat info;
  if (fstat(fileno(file.get()), &info) != 0) throw fail(std::strerror(errno));
  if (S_ISDIR(info.st_mode)) throw fail("it is a directory");
  if (S_ISCHR(info.st_mode) || S_ISBLK(info.st_mode)) throw fail("it is a device");

  // The size is a hint: a pipe has none, and a file may grow while it is read.
  std::size_t capacity = kBeginning, most = kAllBytes;
  const std::size_t size = static_cast<std::size_t>(std::max<off_t>(info.st_size, 0));
  FileBytes bytes{std::unique_ptr<char[]>(new char[capacity])};
  for (;;) {
    bytes.size += std::fread(bytes.data.get() + bytes.size, 1, capacity - bytes.size, file.get());
    if (std::ferror(file.get())) throw fail(std::strerror(errno));
    if (bytes.size < capacity || bytes.size == most) return bytes;
    if (capacity == kBeginning && check)
      most = std::max(capacity, check(bytes.data.get(), capacity, size));
    capacity = std::min(std::max(2 * capacity, size + 1), most);
    std::unique_ptr<char[]> larger(new char[capacity]);
    std::memcpy(larger.get(), bytes.data.get(), bytes.size);
    bytes.data = std::move(larger);
  }
}

}    // namespace lsdcd
