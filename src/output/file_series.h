// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Files of one name and many steps, and the list of them that ParaView opens as one.
#pragma once

#include <string>
#include <vector>

namespace lsdcd {

// Is this no name of a file that is written every so many steps, with one '*' for the step or none? `end`: ".vtp".
// Empty: it is one; else what to write.
std::string wrong_series_name(const std::string &name, const std::string &end);

// Returns the name with the step in place of its first '*'.
std::string file_of_step(const std::string &path, long long step);

// VTK's collection (.pvd): a file with the names and times of the files of a series. It lies beside them
// and has their name, with "series" for the step.
class FileSeries {
 public:
  // `path` has a '*', and not in a folder's name.
  explicit FileSeries(const std::string &path);

  const std::string &path() const { return path_; }    // of the list

  // Before the first add(): goes on with the list that an earlier run wrote, if there is one, or begins anew. A file of this name that
  // is no such list, or, where it is to go on, not as write() leaves it, is renamed, and the entries that it has as whole lines are
  // taken. Returns what became of it, for a warning; empty: nothing to tell. Throws InputError where it cannot be renamed.
  std::string begin(bool continues);

  // Adds the file of this step at the end. Removes the same file and files of later times, which an
  // earlier run may have listed.
  void add(long long step, double time);

  void write() const;    // whole or not at all; throws InputError that names the list

 private:
  struct Entry {
    double time;
    std::string file;    // without its folder, escaped for XML
  };

  static bool read_entry(const std::string &line, Entry &entry);
  std::string text() const;    // of the list

  std::string files_, path_;
  std::vector<Entry> entries_;
};

}    // namespace lsdcd
