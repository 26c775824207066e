// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "output/file_series.h"

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/number_words.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace fs = std::filesystem;

namespace lsdcd {

namespace {

const std::string kBegin = "<?xml version=\"1.0\"?>\n"
                           "<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
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

// How many bytes the character of UTF-8 at this place has; 0: it is none.
std::size_t bytes_of_character(const std::string &text, std::size_t at)
{
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned first = byte(at);
  const std::size_t n = first < 0x80   ? 1
                        : first < 0xc2 ? 0
                        : first < 0xe0 ? 2
                        : first < 0xf0 ? 3
                        : first < 0xf5 ? 4
                                       : 0;
  for (std::size_t k = 1; k < n; k++)
    if (at + k >= text.size() || byte(at + k) >> 6 != 2) return 0;
  return n;
}

// Can as_xml() have made it, and programs read it?
bool is_xml(const std::string &text)
{
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t n = bytes_of_character(text, at);
    const unsigned char c = text[at];
    const auto begins = [&](const char *name) {
      return text.compare(at, std::strlen(name), name) == 0;
    };
    if (n == 0 || c < ' ' || c == '<' || c == '"') return false;
    if (c == '&' && !begins("&amp;") && !begins("&lt;") && !begins("&quot;")) return false;
    at += n;
  }
  return true;
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

std::string FileSeries::begin(bool continues)
{
  std::error_code failed;
  if (!fs::is_regular_file(path_, failed)) return "";
  std::ifstream in(path_, std::ios::binary);
  std::string there((std::istreambuf_iterator<char>(in)), {});
  there.erase(std::remove(there.begin(), there.end(), '\r'), there.end());
  std::istringstream lines(there);
  for (std::string line; continues && std::getline(lines, line);)
    if (Entry entry; read_entry(line, entry)) entries_.push_back(entry);
  const bool is_whole = continues ? there == text() : there.compare(0, kBegin.size(), kBegin) == 0;
  if (is_whole) return "";
  std::string kept = path_ + ".old";
  for (int k = 2; fs::exists(kept, failed); k++) kept = path_ + ".old" + std::to_string(k);
  fs::rename(path_, kept, failed);
  if (failed)
    throw InputError("the list '" + path_ +
                     "' is damaged or of another program, and cannot be renamed to '" + kept +
                     "': " + failed.message());
  return "the list '" + path_ + "' is damaged or of another program, and is kept as '" + kept +
         "'" +
         (continues ? ": the new one has " +
                          counted(static_cast<std::int64_t>(entries_.size()), "file") + " of it"
                    : "");
}

// Reads a line as write() writes it. False: it is something else.
bool FileSeries::read_entry(const std::string &line, Entry &entry)
{
  const std::size_t file = line.find(kFile), at = file + kFile.size();
  if (line.compare(0, kTime.size(), kTime) != 0 || file == std::string::npos ||
      line.size() < at + kEnd.size() ||
      line.compare(line.size() - kEnd.size(), kEnd.size(), kEnd) != 0)
    return false;
  entry.file = line.substr(at, line.size() - kEnd.size() - at);
  return is_number(line.substr(kTime.size(), file - kTime.size()), &entry.time) &&
         is_xml(entry.file);
}

void FileSeries::add(long long step, double time)
{
  const std::string file = as_xml(file_of_step(files_, step));
  const auto left_behind = [&](const Entry &e) { return e.time > time || e.file == file; };
  entries_.erase(std::remove_if(entries_.begin(), entries_.end(), left_behind), entries_.end());
  entries_.push_back({time, file});
}

std::string FileSeries::text() const
{
  std::string text = kBegin;
  for (const Entry &e : entries_) {
    char time[32];
    const auto end =
        std::to_chars(time, time + sizeof time, e.time, std::chars_format::general, 17).ptr;
    text += kTime + std::string(time, end) + kFile + e.file + kEnd + "\n";
  }
  return text + "</Collection>\n</VTKFile>\n";
}

void FileSeries::write() const
{
  write_whole_file(path_, text());
}

}    // namespace lsdcd
