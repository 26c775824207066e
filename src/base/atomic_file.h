// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A file that appears under its name whole, or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace lsdcd {

// It is written under a temporary name in the same directory and then renamed. If several
// processes write it at once, the last one wins. A name that is no regular file, such as
// /dev/stdout, is refused. All but the destructor throw InputError with the file and
// the system's message.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string &path);
  ~AtomicFile();    // without commit() nothing is left
  AtomicFile(const AtomicFile &) = delete;
  AtomicFile &operator=(const AtomicFile &) = delete;

  void write_at(std::uint64_t offset, const void *data, std::size_t bytes);
  void commit();    // writes it to the disk, then renames it

 private:
  [[noreturn]] void fail(const char *what) const;

  std::string path_, temporary_;
  int file_ = -1;
};

// Does the name of a file end so? False if it is only the ending.
inline bool ends_in(const std::string &path, const std::string &ending)
{
  return path.size() > ending.size() &&
         path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
}

// A file of these bytes.
void write_whole_file(const std::string &path, const std::string &bytes);

}    // namespace lsdcd
