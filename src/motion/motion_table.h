// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A motion that rows of numbers give: where a mesh is at some times, and a curve through these places.
#pragma once

#include "base/quaternion.h"
#include "motion/pose.h"
#include "motion/step_clock.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace lsdcd {

struct TableOptions {
  bool has_axis = false;    // rows have an angle about the axis of the motion
  bool linear = false;      // straight between rows, at constant velocities; else a cubic spline
  bool repeats = false;     // the last row is the first of the next period
  bool degrees = false;     // of angles and rotation vectors; else radians

  bool operator==(const TableOptions &o) const
  {
    return has_axis == o.has_axis && linear == o.linear && repeats == o.repeats &&
           degrees == o.degrees;
  }
};

// Rows as a file or a caller has them, one behind the other. A row is a time and, by the number of columns,
//   2  an angle,
//   4  a displacement x y z,
//   5  a displacement and an angle,
//   7  a displacement and a rotation vector,
//   8  a displacement and a quaternion w x y z.
struct TableRows {
  TableOptions options;
  int columns = 0;
  std::vector<Real> numbers;

  std::size_t count() const { return columns > 0 ? numbers.size() / columns : 0; }
  bool operator==(const TableRows &o) const
  {
    return options == o.options && columns == o.columns && numbers == o.numbers;
  }
};

// A row of a table, or between two rows, at one time.
struct TablePlace {
  Vec3 shift = {0, 0, 0}, velocity = {0, 0, 0};
  Real angle = 0, speed = 0;    // about the axis; radians, radians/time
  Quaternion turn;              // else
  Vec3 angular = {0, 0, 0};     // in the frame of the box
};

// The curve through the rows of a table. Velocities are its derivative. Before the first row and from the last one on the mesh rests,
// unless the table repeats.
//
// The spline has continuous accelerations. At the ends its third derivative is continuous one row further in
// ("not a knot"), or the ends are joined where the table repeats. Its error is of the order of the fourth
// power of the time between rows. Angles and displacements are splined as they are; the rotations of
// vectors and quaternions as quaternions, which are then of length 1 again: between two rows the mesh turns by
// less than half a turn. Straight between rows it turns about one axis at a constant speed.
class MotionTable {
 public:
  using PlaceOf = std::function<std::string(std::size_t)>;

  // `place_of` names a row, counted from 0, in errors. Throws InputError with a row's number that is wrong, and what
  // to give.
  MotionTable(TableRows rows, const PlaceOf &place_of);

  const TableRows &rows() const { return rows_; }
  bool turns() const { return channels_ > 3; }
  bool turns_about_axis() const { return channels_ == 4; }
  Real begin() const { return times_.front(); }
  Real end() const { return times_.back(); }

  TablePlace at(Time t) const;
  // Returns the mean velocities of the step that ends at time t, where the mesh is at `end`, in a TablePlace whose places are not set.
  // In a step in which the mesh turns by half a turn or more, it turns the shorter way.
  TablePlace mean_before(const TablePlace &end, Time t, Real step) const;
  // Returns the times of the rows, and those in the middle between two rows.
  std::vector<Real> typical_times() const;
  // Returns whether no row shifts the mesh along this unit vector, or turns it about another axis. Angles about the axis of the term are
  // not looked at.
  bool keeps(const Vec3 &direction, Real rounding) const;

 private:
  void read(const PlaceOf &place_of);
  void read_rotation(std::size_t row, const Real *numbers, const PlaceOf &place_of);
  void close(const PlaceOf &place_of);
  void fit();
  Real &value(std::size_t row, int channel) { return values_[row * channels_ + channel]; }
  Real value(std::size_t row, int channel) const { return values_[row * channels_ + channel]; }
  Time in_period(Time t) const;
  void follow(TablePlace &place, std::size_t row, Real since) const;

  TableRows rows_;
  std::vector<Real> times_;
  int channels_ = 3;            // of each row: x y z, then an angle or a quaternion
  std::vector<Real> values_;    // by row
  std::vector<Real> slopes_;    // of the spline at rows; none where it is straight between them
  Real turned_sign_ = 1;    // -1: the quaternion of the next period is that of this one times -1
};

// Returns the rows of a text file: numbers with spaces, tabs or commas between them, a row a line; the rest of a line
// behind # is not read. Throws InputError with the file and the line.
MotionTable read_motion_table(const std::string &file, const TableOptions &options);

}    // namespace lsdcd
