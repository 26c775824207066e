// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Files of one name and many steps, and the list of them that ParaView opens as one.
#pragma once

#include <string>
#include <vector>

namespace lsdcd {

// FILE with the step in place of its first '*'.
std::string file_of_step(const std::string &path, long long step);

// VTK's collection (.pvd): the files of a series with their times, in a file beside them that is
// named as they are, with "series" for the step.
class FileSeries {
 public:
  // `path` has a '*', and not in a folder's name.
  explicit FileSeries(const std::string &path);

  const std::string &path() const { return path_; }    // of the list

  // Goes on with what an earlier run listed; nothing where there is no such list.
  void read();

  // Puts the file of this step last, and forgets those that it leaves behind: the same file, and
  // what a run listed that was at a later time.
  void add(long long step, double time);

  void write() const;    // whole or not at all; throws InputError that names the list

 private:
  struct Entry {
    double time;
    std::string file;    // without its folder, as XML has it
  };

  std::string files_, path_;
  std::vector<Entry> entries_;
};

}    // namespace lsdcd
