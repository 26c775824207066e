// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "flow/pass_file.h"

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/number_words.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <tuple>

namespace lsdcd {

namespace {

const char *const kPassHeader = "# step time id type diameter x y z vx vy vz direction\n";

// The header and the first `n` whole rows of a file, or all where there are fewer: `n` becomes how many. Steps do not tell
// which ones these are, as the host may count them anew.
std::string first_rows(const std::string &path, std::int64_t &n)
{
  std::string kept = kPassHeader, line;
  std::ifstream file(path);
  std::int64_t rows = 0;
  while (rows < n && std::getline(file, line) && !file.eof()) {
    if (line.empty() || line[0] == '#') continue;
    kept += line + '\n';
    rows++;
  }
  n = rows;
  return kept;
}

std::string whole_text(Real number)
{
  return std::to_string(static_cast<std::int64_t>(number));
}

}    // namespace

void PassFile::open(std::int64_t kept)
{
  rows_ = kept;
  if (kept > 0) write_whole_file(path_, first_rows(path_, rows_));
  file_.reset(std::fopen(path_.c_str(), kept > 0 ? "a" : "w"));
  if (!file_ || (kept == 0 && std::fputs(kPassHeader, file_.get()) < 0) ||
      std::fflush(file_.get()) != 0)
    throw InputError(path_ + ": cannot be written: " + std::strerror(errno) +
                     "; give the keyword file a name in a folder that is there");
}

bool PassFile::add(std::vector<Passage> rows)
{
  std::stable_sort(rows.begin(), rows.end(), [](const Passage &a, const Passage &b) {
    return std::tie(a.step, a.id) < std::tie(b.step, b.id);
  });
  std::string text;
  for (const Passage &p : rows) {
    text += whole_text(p.step) + ' ' + exact_text(p.time) + ' ' + whole_text(p.id) + ' ' +
            whole_text(p.type);
    for (const Real number : {p.diameter, p.x.x, p.x.y, p.x.z, p.v.x, p.v.y, p.v.z})
      text += ' ' + exact_text(number);
    text += ' ' + whole_text(p.direction) + '\n';
  }
  rows_ += static_cast<std::int64_t>(rows.size());
  return std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size() &&
         std::fflush(file_.get()) == 0;
}

}    // namespace lsdcd
