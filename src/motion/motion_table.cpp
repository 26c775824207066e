// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "motion/motion_table.h"

#include "base/byte_order_mark.h"
#include "base/file_kind.h"
#include "base/input_error.h"
#include "base/input_words.h"
#include "motion/cubic_spline.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

namespace lsdcd {

namespace {

const char *const kBlanks = " \t\r";

// A turn by the angle |a| about a.
Quaternion turn_by(const Vec3 &a)
{
  const Real angle = norm(a);
  return angle == 0 ? Quaternion() : rotation_about((1 / angle) * a, angle);
}

// From one unit quaternion to another, of which the turn is not taken the longer way.
Vec3 turn_between(const Quaternion &from, const Quaternion &to)
{
  const Quaternion turned = to * inverse(from);
  const Real sine = norm(turned.v);
  if (sine == 0) return {0, 0, 0};
  return (2 * std::atan2(sine, turned.w) / sine) * turned.v;
}

Quaternion at_channels(const Real *values)
{
  return {values[0], {values[1], values[2], values[3]}};
}

std::string numbers_text(const Real *numbers, int n)
{
  std::string text;
  for (int k = 0; k < n; k++) text += (k ? " " : "") + number_text(numbers[k]);
  return text;
}

// The word of a file that may be no text.
std::string shown(std::string word)
{
  constexpr std::size_t kLongest = 40;
  if (word.size() > kLongest) word = word.substr(0, kLongest) + "...";
  for (char &c : word)
    if (c < ' ' || c > '~') c = '?';
  return word;
}

// A line whose fields, between commas, are not all there would be taken for a row of fewer numbers.
bool has_empty_field(const std::string &line)
{
  if (line.find(',') == std::string::npos) return false;
  std::size_t begin = 0;
  while (begin <= line.size()) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    if (line.find_first_not_of(kBlanks, begin) >= end) return true;
    begin = end + 1;
  }
  return false;
}

const char *const kColumns =
    "a row is a time and an angle (2 numbers), a displacement x y z (4), a displacement and an "
    "angle (5), a displacement and a rotation vector (7), or a displacement and a quaternion w x "
    "y z (8)";

void check_columns(const TableRows &rows, const std::string &place)
{
  const int n = rows.columns;
  if (n != 2 && n != 4 && n != 5 && n != 7 && n != 8)
    throw InputError(place + ": there " + (n == 1 ? "is " : "are ") + counted(n, "number") +
                     " in a row: " + kColumns);
  const bool has_angle = n == 2 || n == 5;
  if (has_angle && !rows.options.has_axis)
    throw InputError(place + ": rows of " + std::to_string(n) +
                     " numbers end with an angle: give its axis, by axis Px Py Pz Rx Ry Rz");
  if (!has_angle && rows.options.has_axis)
    throw InputError(place + ": rows of " + std::to_string(n) +
                     " numbers have no angle about the axis that is given: leave the axis out, or "
                     "give rows of 2 or 5 numbers");
}

}    // namespace

MotionTable::MotionTable(TableRows rows, const PlaceOf &place_of) : rows_(std::move(rows))
{
  check_columns(rows_, place_of(0));
  read(place_of);
  if (rows_.options.repeats) close(place_of);
  if (!rows_.options.linear) fit();
}

void MotionTable::read(const PlaceOf &place_of)
{
  const int columns = rows_.columns;
  const std::size_t n = rows_.count();
  if (n < 2) throw InputError(place_of(0) + ": there is one row, and a motion needs two or more");
  channels_ = columns == 4 ? 3 : columns == 2 || columns == 5 ? 4 : 7;
  values_.assign(n * channels_, 0);
  for (std::size_t i = 0; i < n; i++) {
    const Real *row = &rows_.numbers[i * columns];
    for (int k = 0; k < columns; k++)
      if (!std::isfinite(row[k]))
        throw InputError(place_of(i) + ": number " + std::to_string(k + 1) +
                         " of the row is not finite");
    if (i > 0 && !(row[0] > times_.back()))
      throw InputError(place_of(i) + ": the time " + number_text(row[0]) +
                       " is not after that of the row before, " + number_text(times_.back()) +
                       ": times must ascend");
    times_.push_back(row[0]);
    if (columns >= 4) std::copy(row + 1, row + 4, &value(i, 0));
    if (turns()) read_rotation(i, row + (columns == 2 ? 1 : 4), place_of);
  }
  if (!rows_.options.repeats && times_.back() <= 0)
    throw InputError(place_of(n - 1) + ": the last row is at time " + number_text(times_.back()) +
                     ", and the motion begins at time 0, so the mesh would rest where that "
                     "row has it: give times from 0 on, or let the table repeat");
}

void MotionTable::read_rotation(std::size_t row, const Real *numbers, const PlaceOf &place_of)
{
  const Real unit = rows_.options.degrees ? kPi / 180 : 1;
  Real *const to = &value(row, 3);
  if (turns_about_axis()) {
    to[0] = unit * numbers[0];
    return;
  }
  if (rows_.columns == 7) {
    const Vec3 a = {unit * numbers[0], unit * numbers[1], unit * numbers[2]};
    if (row > 0) {
      const Real *const before = numbers - rows_.columns;
      const Vec3 from = {unit * before[0], unit * before[1], unit * before[2]};
      constexpr Real kHalfTurn = kPi * (1 + 1e-6);    // as six digits have it
      if (norm(a - from) > kHalfTurn)
        throw InputError(
            place_of(row) + ": the rotation vector " + numbers_text(numbers, 3) + " is " +
            number_text(norm(a - from) * 180 / kPi) + " degrees from that of the row before, " +
            numbers_text(before, 3) +
            ", and which way the mesh turns is not known beyond 180: give rows that are nearer to "
            "one another; or quaternions instead, between which the mesh turns the shorter way; "
            "or angles about one axis, which have no limit");
    }
    const Quaternion q = turn_by(a);    // its sign goes on from row to row, as a does
    to[0] = q.w;
    std::copy(&q.v.x, &q.v.x + 3, to + 1);
    return;
  }
  Real length = 0, along = 0;
  for (int k = 0; k < 4; k++) length += numbers[k] * numbers[k];
  length = std::sqrt(length);
  constexpr Real kOff = 1e-3;
  if (std::fabs(length - 1) > kOff)
    throw InputError(place_of(row) + ": the quaternion " + numbers_text(numbers, 4) +
                     " has the length " + number_text(length) + ", and must have 1 to 1e-3");
  for (int k = 0; k < 4; k++) to[k] = numbers[k] / length;
  if (row == 0) return;
  for (int k = 0; k < 4; k++) along += to[k] * value(row - 1, 3 + k);
  if (std::fabs(along) < kOff)
    throw InputError(place_of(row) + ": the quaternion " + numbers_text(numbers, 4) +
                     " is half a turn from that of the row before, and which way the mesh turns is "
                     "not known: give a row between them");
  for (int k = 0; k < 4 && along < 0; k++) to[k] = -to[k];
}

// The last row becomes the first one of the next period, where it is that but for the digits of a file.
void MotionTable::close(const PlaceOf &place_of)
{
  const std::size_t last = times_.size() - 1;
  const std::string place =
      place_of(last) + ": the table repeats, but its last row is not its first: ";
  Real size = 0;
  for (std::size_t i = 0; i <= last; i++)
    for (int k = 0; k < 3; k++) size = std::max(size, std::fabs(value(i, k) - value(0, k)));
  constexpr Real kDigits = 1e-6, kTurned = 1e-5;
  for (int k = 0; k < 3; k++) {
    if (std::fabs(value(last, k) - value(0, k)) > kDigits * size)
      throw InputError(place + "displacements are " + numbers_text(&value(last, 0), 3) + " and " +
                       numbers_text(&value(0, 0), 3) +
                       ". End it where it begins, or leave repeat out");
    value(last, k) = value(0, k);
  }
  if (turns_about_axis()) {
    const Real turned = value(last, 3) - value(0, 3),
               whole = 2 * kPi * std::round(turned / (2 * kPi));
    if (std::fabs(turned - whole) > kTurned)
      throw InputError(place + "from one to the other the mesh turns by " +
                       number_text(turned * 180 / kPi) +
                       " degrees. End it after whole turns, or leave repeat out");
    value(last, 3) = value(0, 3) + whole;
  } else if (turns()) {
    Real along = 0;
    for (int k = 3; k < channels_; k++) along += value(last, k) * value(0, k);
    turned_sign_ = along < 0 ? -1 : 1;
    const Quaternion from = at_channels(&value(0, 3));
    Quaternion to = at_channels(&value(last, 3));
    to = {turned_sign_ * to.w, turned_sign_ * to.v};
    if (norm(turn_between(from, to)) > kTurned)
      throw InputError(place + "from one to the other the mesh turns by " +
                       number_text(norm(turn_between(from, to)) * 180 / kPi) +
                       " degrees. End it where it begins, or leave repeat out");
    for (int k = 3; k < channels_; k++) value(last, k) = turned_sign_ * value(0, k);
  }
}

void MotionTable::fit()
{
  const std::size_t pieces = times_.size() - 1;
  std::vector<Real> length, mean;
  for (std::size_t i = 0; i < pieces; i++) length.push_back(times_[i + 1] - times_[i]);
  slopes_.assign(values_.size(), 0);
  for (int k = 0; k < channels_; k++) {
    mean.clear();
    for (std::size_t i = 0; i < pieces; i++)
      mean.push_back((value(i + 1, k) - value(i, k)) / length[i]);
    std::vector<Real> slopes;
    if (!rows_.options.repeats) {
      slopes = spline_slopes(length, mean);
    } else if (turned_sign_ > 0 || k < 3) {
      slopes = periodic_spline_slopes(length, mean);
      slopes.push_back(slopes[0]);
    } else {    // two periods are one of a quaternion that has changed its sign after the first
      std::vector<Real> lengths = length;
      lengths.insert(lengths.end(), length.begin(), length.end());
      for (std::size_t i = 0; i < pieces; i++) mean.push_back(-mean[i]);
      slopes = periodic_spline_slopes(lengths, mean);
    }
    for (std::size_t i = 0; i <= pieces; i++) slopes_[i * channels_ + k] = slopes[i];
  }
}

// A time within the rounding of a timestep's product of a whole number of periods counts as that.
Time MotionTable::in_period(Time t) const
{
  const Time period = Time(times_.back()) - times_.front(), passed = t - times_.front();
  constexpr Time kUncertain = 2.3e-16L;
  Time phase = std::fmod(passed, period);    // fmod is exact
  if (phase < 0) phase += period;
  const Time off = kUncertain * std::fabs(t);
  return phase <= off || period - phase <= off ? 0 : phase;
}

TablePlace MotionTable::at(Time t) const
{
  const std::size_t last = times_.size() - 1;
  TablePlace place;
  const Time since = rows_.options.repeats ? in_period(t) : t - times_.front();
  const Time now = times_.front() + since;
  if (!rows_.options.repeats && (now < times_.front() || now >= times_.back())) {
    follow(place, now < times_.front() ? 0 : last, 0);
    place.velocity = place.angular = {0, 0, 0};
    place.speed = 0;
    return place;
  }
  std::size_t row = std::upper_bound(times_.begin(), times_.end(), now) - times_.begin();
  row = std::min(row == 0 ? 0 : row - 1, last - 1);
  follow(place, row, static_cast<Real>(now - times_[row]));
  return place;
}

TablePlace MotionTable::mean_before(const TablePlace &end, Time t, Real step) const
{
  const TablePlace from = at(t - step);
  TablePlace mean;
  mean.velocity = (1 / step) * (end.shift - from.shift);
  // A table that repeats may end whole turns from where it begins.
  mean.speed = std::remainder(end.angle - from.angle, 2 * kPi) / step;
  if (turns() && !turns_about_axis()) mean.angular = (1 / step) * turn_between(from.turn, end.turn);
  return mean;
}

// `since`: the time since that row; of the last row 0.
void MotionTable::follow(TablePlace &place, std::size_t row, Real since) const
{
  const bool is_last = row + 1 == times_.size();
  const Real length = is_last ? 1 : times_[row + 1] - times_[row], part = since / length;
  Real at[7] = {}, rate[7] = {};
  for (int k = 0; k < channels_; k++) {
    const Real mean = is_last ? 0 : (value(row + 1, k) - value(row, k)) / length;
    if (rows_.options.linear || is_last) {
      at[k] = value(row, k) + since * mean;
      rate[k] = mean;
      continue;
    }
    const Real slope = slopes_[row * channels_ + k], next = slopes_[(row + 1) * channels_ + k],
               square = 3 * mean - 2 * slope - next, cube = slope + next - 2 * mean;
    at[k] = value(row, k) + since * (slope + part * (square + part * cube));
    rate[k] = slope + part * (2 * square + part * 3 * cube);
  }
  place.shift = {at[0], at[1], at[2]};
  place.velocity = {rate[0], rate[1], rate[2]};
  if (turns_about_axis()) {
    place.angle = at[3];
    place.speed = rate[3];
  } else if (turns()) {
    Quaternion q = at_channels(at + 3);
    if (rows_.options.linear && !is_last) {
      const Quaternion from = at_channels(&values_[row * channels_ + 3]);
      place.angular =
          (1 / length) * turn_between(from, at_channels(&values_[(row + 1) * channels_ + 3]));
      q = turn_by(since * place.angular) * from;
    } else {    // of q/|q|, as the part of q' along q changes nothing
      const Quaternion turning = at_channels(rate + 3) * inverse(q);
      place.angular = (2 / (q.w * q.w + norm_sq(q.v))) * turning.v;
    }
    place.turn = normalised(q);
  }
}

std::vector<Real> MotionTable::typical_times() const
{
  std::vector<Real> times;
  for (std::size_t i = 0; i < times_.size(); i++) {
    if (i > 0) times.push_back(times_[i - 1] + (times_[i] - times_[i - 1]) / 2);
    times.push_back(times_[i]);
  }
  return times;
}

bool MotionTable::keeps(const Vec3 &direction, Real rounding) const
{
  for (std::size_t i = 0; i < times_.size(); i++) {
    const Vec3 shift = {value(i, 0), value(i, 1), value(i, 2)};
    if (std::fabs(dot(shift, direction)) > rounding * norm(shift)) return false;
    if (channels_ < 7) continue;
    const Vec3 axis = {value(i, 4), value(i, 5), value(i, 6)};
    if (norm(cross(axis, direction)) > rounding) return false;
  }
  return true;
}

MotionTable read_motion_table(const std::string &file, const TableOptions &options)
{
  const std::string why = why_no_file(file);
  if (!why.empty())
    throw InputError("cannot read the table '" + file + "' of a motion: " + why +
                     (why == "there is no such file" ? "" : "; give the path of a file of text"));
  std::ifstream in(file);
  if (!in) throw InputError("cannot read the table '" + file + "' of a motion");
  TableRows rows;
  rows.options = options;
  std::vector<int> lines;
  const auto place = [&](int line) { return "table '" + file + "' line " + std::to_string(line); };
  std::string text;
  for (int line = 1; std::getline(in, text); line++) {
    if (line == 1) drop_byte_order_mark(text);
    text = text.substr(0, text.find('#'));
    if (has_empty_field(text))
      throw InputError(place(line) +
                       ": there is nothing before or behind one of the commas: give " +
                       "a number for each, with a point in decimals");
    std::replace(text.begin(), text.end(), ',', ' ');
    int columns = 0;
    for (std::size_t at = text.find_first_not_of(kBlanks); at != std::string::npos; columns++) {
      const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
      const std::string word = text.substr(at, end - at);
      Real number;
      if (!is_number(word, &number))
        throw InputError(place(line) + ": '" + shown(word) +
                         "' is not a number; begin a line of text with #");
      rows.numbers.push_back(number);
      at = text.find_first_not_of(kBlanks, end);
    }
    if (columns == 0) continue;
    if (lines.empty()) rows.columns = columns;
    if (columns != rows.columns)
      throw InputError(place(line) + ": the row has " + std::to_string(columns) +
                       " numbers, and that of line " + std::to_string(lines.front()) + " has " +
                       std::to_string(rows.columns) + ": give all rows equally many numbers");
    lines.push_back(line);
  }
  if (in.bad()) throw InputError("reading the table '" + file + "' of a motion has failed");
  if (lines.empty()) throw InputError("table '" + file + "' has no rows: " + std::string(kColumns));
  return MotionTable(std::move(rows), [&](std::size_t row) { return place(lines[row]); });
}

}    // namespace lsdcd
