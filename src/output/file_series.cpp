// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "output/file_series.h"

#include "base/atomic_file.h"
#include "base/number_words.h"

#include <algorithm>
#include <charconv>
#include <fstream>

namespace lsdcd {

namespace {

const std::string kTime = "<DataSet timestep=\"", kFile = "\" part=\"0\" file=\"", kEnd = "\"/>";

std::string with_star_as(const std::string &path, const std::string &text)
{
  const std::size_t star = path.find('*');
  return star == std::string::npos ? path : path.substr(0, star) + text + path.substr(star + 1);
}

std::string as_xml(const std::string &text)
{
  std::string xml;
  for (const char c : text)
    xml += c == '&'   ? std::string("&amp;")
           : c == '<' ? std::string("&lt;")
           : c == '"' ? std::string("&quot;")
                      : std::string(1, c);
  return xml;
}

}    // namespace

std::string wrong_series_name(const std::string &name, const std::string &end)
{
  if (!ends_in(name, end))
    return "the file name '" + name + "' must end in " + end + ", by which other programs know it";
  const std::size_t star = name.find('*');
  if (star == std::string::npos) return "";
  if (name.find('/', star) != std::string::npos)
    return "'" + name + "' has its * in the name of a folder; put it into the file's own name";
  if (name.find('*', star + 1) != std::string::npos)
    return "'" + name + "' has more than one *; only one is the step: leave the others out";
  return "";
}

std::string file_of_step(const std::string &path, long long step)
{
  return with_star_as(path, std::to_string(step));
}

FileSeries::FileSeries(const std::string &path) : files_(path.substr(path.rfind('/') + 1))
{
  const std::string list = with_star_as(path, "series");
  path_ = list.substr(0, list.rfind('.')) + ".pvd";
}

// It reads only the lines that it writes itself.
void FileSeries::read()
{
  std::ifstream in(path_);
  for (std::string line; std::getline(in, line);) {
    const std::size_t file = line.find(kFile);
    if (line.compare(0, kTime.size(), kTime) != 0 || file == std::string::npos) continue;
    const std::size_t at = file + kFile.size();
    double time = 0;
    if (read_real(line.substr(kTime.size(), file - kTime.size()), time))
      entries_.push_back({time, line.substr(at, line.rfind(kEnd) - at)});
  }
}

void FileSeries::add(long long step, double time)
{
  const std::string file = as_xml(file_of_step(files_, step));
  const auto left_behind = [&](const Entry &e) { return e.time > time || e.file == file; };
  entries_.erase(std::remove_if(entries_.begin(), entries_.end(), left_behind), entries_.end());
  entries_.push_back({time, file});
}

void FileSeries::write() const
{
  std::string text = "<?xml version=\"1.0\"?>\n"
                     "<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const Entry &e : entries_) {
    char time[32];
    const auto end =
        std::to_chars(time, time + sizeof time, e.time, std::chars_format::general, 17).ptr;
    text += kTime + std::string(time, end) + kFile + e.file + kEnd + "\n";
  }
  text += "</Collection>\n</VTKFile>\n";
  write_whole_file(path_, text);
}

}    // namespace lsdcd
