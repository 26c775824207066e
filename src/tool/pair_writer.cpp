// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/pair_writer.h"

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "output/vtk_array.h"
#include "tool/csv_file.h"

#include <vector>

namespace lsdcd {

namespace {

std::int64_t number_of(std::uint32_t triangle)
{
  return triangle == kNoWallTriangle ? -1 : static_cast<std::int64_t>(triangle);
}

class CsvPairs : public PairWriter {
 public:
  CsvPairs(const std::string &path, bool with_segments) : file_(path), with_segments_(with_segments)
  {
    file_.add("pose,wall_triangle,body_triangle");
    file_.add(with_segments ? ",from_x,from_y,from_z,to_x,to_y,to_z\n" : "\n");
  }
  void write(std::size_t pose, const MeshCollision &of, const Collision &found) override
  {
    for (std::size_t i = 0; i < found.pairs.size(); i++) {
      file_.add(pose, ',');
      file_.add(number_of(of.wall_triangle(found.pairs[i])), ',');
      file_.add(number_of(of.body_triangle(found.pairs[i])), with_segments_ ? ',' : '\n');
      if (!with_segments_) continue;
      const MeetingSegment &s = found.segments[i];
      const Real numbers[6] = {s.from.x, s.from.y, s.from.z, s.to.x, s.to.y, s.to.z};
      for (int k = 0; k < 6; k++) {
        if (s.flat)
          file_.add(k < 5 ? "nan," : "nan\n");
        else
          file_.add(numbers[k], k < 5 ? ',' : '\n');
      }
    }
    file_.flush();
  }
  void commit() override { file_.commit(); }

 private:
  CsvFile file_;
  bool with_segments_;
};

class VtpSegments : public PairWriter {
 public:
  explicit VtpSegments(const std::string &path) : file_(path) {}
  void write(std::size_t pose, const MeshCollision &of, const Collision &found) override
  {
    for (std::size_t i = 0; i < found.pairs.size(); i++) {
      const MeetingSegment &s = found.segments[i];
      if (s.flat) continue;
      points_.insert(points_.end(), {s.from.x, s.from.y, s.from.z, s.to.x, s.to.y, s.to.z});
      pose_.push_back(static_cast<std::int64_t>(pose));
      wall_.push_back(number_of(of.wall_triangle(found.pairs[i])));
      body_.push_back(number_of(of.body_triangle(found.pairs[i])));
    }
  }
  void commit() override
  {
    std::vector<std::int64_t> ends, corners;
    for (std::size_t i = 0; i < pose_.size(); i++) {
      const auto begin = static_cast<std::int64_t>(2 * i);
      corners.insert(corners.end(), {begin, begin + 1});
      ends.push_back(begin + 2);
    }
    std::string text = std::string(kVtkHead) + "<Piece NumberOfPoints=\"" +
                       std::to_string(corners.size()) + "\" NumberOfLines=\"" +
                       std::to_string(ends.size()) + "\">\n<CellData>\n";
    text += data_array("Int64", "pose", pose_);
    text += data_array("Int64", "wall_triangle", wall_);
    text += data_array("Int64", "body_triangle", body_);
    text += "</CellData>\n<Points>\n";
    text += data_array("Float64", "points", points_, " NumberOfComponents=\"3\"");
    text += "</Points>\n<Lines>\n";
    text += data_array("Int64", "connectivity", corners);
    text += data_array("Int64", "offsets", ends);
    text += std::string("</Lines>\n") + kVtkEnd;
    file_.write_at(0, text.data(), text.size());
    file_.commit();
  }

 private:
  AtomicFile file_;
  std::vector<double> points_;
  std::vector<std::int64_t> pose_, wall_, body_;
};

}    // namespace

std::unique_ptr<PairWriter> open_pairs(const std::string &path)
{
  if (!ends_in(path, ".csv")) throw InputError("--output " + path + ": end the name in .csv");
  return std::make_unique<CsvPairs>(path, false);
}

std::unique_ptr<PairWriter> open_segments(const std::string &path)
{
  if (ends_in(path, ".csv")) return std::make_unique<CsvPairs>(path, true);
  if (ends_in(path, ".vtp")) return std::make_unique<VtpSegments>(path);
  throw InputError("--segments " + path + ": end the name in .csv or .vtp");
}

}    // namespace lsdcd
