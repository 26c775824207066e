// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/answer_writer.h"

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "contact/mesh_geometry.h"
#include "tool/csv_file.h"

#include <cmath>
#include <cstring>

namespace lsdcd {

namespace {

constexpr const char *kKinds[] = {"face", "edge", "vertex", "none"};

int kind_of(std::uint32_t feature)
{
  return feature == kNoFeature ? 3 : static_cast<int>(feature_kind(feature));
}

class CsvWriter : public AnswerWriter {
 public:
  CsvWriter(const std::string &path, bool with_ids, SideKind sides) :
      file_(path), with_ids_(with_ids), sides_(sides)
  {
    if (with_ids) file_.add("timestep,id,");
    file_.add("distance,closest_x,closest_y,closest_z,triangle,feature,index");
    file_.add(sides == SideKind::none    ? "\n"
              : sides == SideKind::exact ? ",side\n"
                                         : ",estimated_side,winding\n");
  }
  void write(const PointBlock &points, const AnswerBlock &a) override
  {
    for (std::size_t i = 0; i < points.size(); i++) {
      if (with_ids_) {
        file_.add(points.step[i], ',');
        file_.add(points.id[i], ',');
      }
      file_.add(a.distance[i], ',');
      for (int k = 0; k < 3; k++) file_.add(a.closest[3 * i + k], ',');
      const int kind = kind_of(a.feature[i]);
      add_index(a.triangle[i], a.triangle[i] != kNoFeature, ',');
      file_.add(kKinds[kind]);
      file_.add(",");
      add_index(feature_index(a.feature[i]), kind < 3, sides_ == SideKind::none ? '\n' : ',');
      const bool estimated = sides_ == SideKind::estimated;
      if (sides_ != SideKind::none) file_.add(static_cast<int>(a.side[i]), estimated ? ',' : '\n');
      if (estimated) file_.add(a.winding[i], '\n');
    }
    file_.flush();
  }
  void commit() override { file_.commit(); }

 private:
  // -1 where there is none.
  void add_index(std::uint32_t index, bool any, char after)
  {
    file_.add(any ? static_cast<std::int64_t>(index) : -1, after);
  }

  CsvFile file_;
  bool with_ids_;
  SideKind sides_;
};

// A record array; its header is written last, when the number of points is known.
class NpyWriter : public AnswerWriter {
 public:
  NpyWriter(const std::string &path, bool with_ids, SideKind sides) :
      file_(path), with_ids_(with_ids), sides_(sides)
  {
  }
  void write(const PointBlock &points, const AnswerBlock &a) override
  {
    bytes_.clear();
    for (std::size_t i = 0; i < points.size(); i++) {
      if (with_ids_) {
        add(points.step[i]);
        add(points.id[i]);
      }
      add(a.distance[i]);
      for (int k = 0; k < 3; k++) add(a.closest[3 * i + k]);
      const int kind = kind_of(a.feature[i]);
      add(index(a.triangle[i], a.triangle[i] != kNoFeature));
      add(index(feature_index(a.feature[i]), kind < 3));
      add(static_cast<std::int8_t>(kind < 3 ? kind : -1));
      if (sides_ != SideKind::none) add(a.side[i]);
      if (sides_ == SideKind::estimated) add(a.winding[i]);
    }
    file_.write_at(at_, bytes_.data(), bytes_.size());
    at_ += bytes_.size();
    n_ += points.size();
  }
  void commit() override
  {
    std::string head = "{'descr': [";
    if (with_ids_) head += "('timestep', '<i8'), ('id', '<i8'), ";
    head += "('distance', '<f8'), ('closest', '<f8', (3,)), ('triangle', '<i4'), ('index', '<i4'), "
            "('feature', '|i1')";
    if (sides_ == SideKind::exact) head += ", ('side', '|i1')";
    if (sides_ == SideKind::estimated) head += ", ('estimated_side', '|i1'), ('winding', '<f8')";
    head += "], 'fortran_order': False, 'shape': (" + std::to_string(n_) + ",)}";
    constexpr std::size_t kStart = 10;
    head.resize(kHeader - kStart - 1, ' ');
    head += '\n';
    const std::string start = {'\x93',
                               'N',
                               'U',
                               'M',
                               'P',
                               'Y',
                               1,
                               0,
                               static_cast<char>((kHeader - kStart) & 255),
                               static_cast<char>((kHeader - kStart) >> 8)};
    head = start + head;
    file_.write_at(0, head.data(), head.size());
    file_.commit();
  }

 private:
  static constexpr std::size_t kHeader = 384;    // bytes; a multiple of 64

  template <class T>
  void add(T value)
  {
    const std::size_t end = bytes_.size();
    bytes_.resize(end + sizeof value);
    std::memcpy(bytes_.data() + end, &value, sizeof value);
  }
  static std::int32_t index(std::uint32_t value, bool any)
  {
    return any ? static_cast<std::int32_t>(value) : -1;
  }

  AtomicFile file_;
  std::vector<char> bytes_;
  std::uint64_t at_ = kHeader;
  std::size_t n_ = 0;
  bool with_ids_;
  SideKind sides_;
};

}    // namespace

std::unique_ptr<AnswerWriter> open_answers(const std::string &path, bool with_ids, SideKind sides)
{
  if (path == "-" || ends_in(path, ".csv"))
    return std::make_unique<CsvWriter>(path, with_ids, sides);
  if (ends_in(path, ".npy")) return std::make_unique<NpyWriter>(path, with_ids, sides);
  throw InputError("--output '" + path + "' ends neither in .csv nor in .npy, and is not -");
}

}    // namespace lsdcd
