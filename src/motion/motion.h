// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How a mesh moves as a rigid body: terms with the words of LAMMPS's fix move, each acting on the
// result of those before it, and last a servo.
#pragma once

#include "box/periodic_box.h"
#include "motion/inputs.h"
#include "motion/motion_table.h"
#include "motion/pose.h"
#include "motion/servo.h"
#include "motion/step_clock.h"

#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

// cosine: `wiggle` of fix wall/gran, which begins at rest: x + A (1 - cos(2 pi t/period)). As there, grains meet its velocity of the whole
// step. riggle: a turn to and fro, by
// the angle A sin(2 pi t/period). variable and variable_turn: what inputs say. table: rows.
enum class MotionKind {
  linear,
  wiggle,
  cosine,
  rotate,
  transrot,
  variable,
  riggle,
  variable_turn,
  table
};

struct MotionTerm {
  MotionKind kind = MotionKind::linear;
  Vec3 velocity = {0, 0, 0};     // length/time; of linear and transrot
  Vec3 amplitude = {0, 0, 0};    // length; of wiggle and cosine
  Vec3 point = {0, 0, 0};        // length; the axis passes through it at time 0
  Vec3 axis = {0, 0, 1};         // right-handed; of any length but 0
  Real period = 0;               // time; 0: nothing repeats
  Real angle = 0;                // radians; the amplitude of riggle
  // kind variable: inputs of the displacement (x, y, z) and its velocity; of kind variable_turn of the angle,
  // radians, and its speed, in the places of x. Their values are filled in before a pose is asked for. Without an input
  // a velocity is the difference of displacements, and a displacement the sum of velocities.
  int input[6] = {kNoInput, kNoInput, kNoInput, kNoInput, kNoInput, kNoInput};
  Vec3 displacement = {0, 0, 0}, speed = {0, 0, 0};
  Vec3 speeding_up = {0, 0, 0};    // how fast an input's speed has changed in the step
  // kind table: null until its file is read.
  std::string table_file;
  TableOptions table_options;
  std::shared_ptr<const MotionTable> table;

  // Returns whether this kind of term turns the mesh about the axis. A table may turn it, too: see MotionTable.
  bool turns() const
  {
    return kind == MotionKind::rotate || kind == MotionKind::transrot ||
           kind == MotionKind::riggle || kind == MotionKind::variable_turn;
  }
  bool is_by_inputs() const
  {
    return kind == MotionKind::variable || kind == MotionKind::variable_turn;
  }
  bool takes_difference(int d) const { return input[d] != kNoInput && input[3 + d] == kNoInput; }
  bool adds_up(int d) const { return input[d] == kNoInput && input[3 + d] != kNoInput; }
};

// Returns a direction that is not zero as a unit vector; (0, 0, a) becomes exactly (0, 0, 1).
Vec3 unit_vector(const Vec3 &a);

class RigidMotion {
 public:
  // Sets the pose that the terms act on, without its velocities.
  void begin_from(const Pose &pose);
  const Pose &start() const { return start_; }

  void add(const MotionTerm &term)
  {
    terms_.push_back(term);
    stopped_.clear();
  }
  // Ends all terms, so that the mesh stays where start() has it.
  void stop();
  // Returns the terms that stop() has ended; none once others are added.
  const std::vector<MotionTerm> &stopped() const { return stopped_; }
  std::vector<MotionTerm> &terms() { return terms_; }
  const std::vector<MotionTerm> &terms() const { return terms_; }

  // Returns the servo, which acts on the result of all terms.
  Servo &servo() { return servo_; }
  const Servo &servo() const { return servo_; }

  // Lets the program pose the mesh, in place of terms and servo. Each pose that it gives to set_pose() holds until the next one.
  void begin_posed() { is_posed_ = true; }
  void set_pose(const Pose &pose) { posed_ = pose; }
  bool is_posed() const { return is_posed_; }

  bool moves() const { return !terms_.empty(); }
  // Returns whether the motion may move the mesh: not if it was stopped, or if its servo was taken away.
  bool acts() const { return moves() || (servo_.present && !servo_.holds) || is_posed_; }
  // Returns false if the mesh is where its file has it, and never moved.
  bool any() const
  {
    return moves() || servo_.present || start_.placed || is_posed_ || !stopped_.empty();
  }

  // Returns the pose at time t since the terms began. It depends only on t and the values of variables, so that it is as
  // exact after 1e9 steps as after one. After a whole number of periods a term gives the bits that it began with. A time
  // that differs from such a number only by rounding counts as that number.
  // `step`: how long the step takes that ends at t (time); 0: none does, and accelerations are those by turning alone.
  Pose terms_at(Time t, Real step = 0) const;
  // Returns the pose at time t since the terms began, with the servo where it is now.
  Pose pose_at(Time t, Real step = 0) const;

  // Returns the longest period of the terms; that of a table is the time of its last row. 0: no term has one.
  Real longest_period() const;

  // Returns whether the mesh is always where its file has it along this unit vector, and turns about no other axis.
  bool keeps(const Vec3 &direction) const;

 private:
  Pose start_;
  std::vector<MotionTerm> terms_, stopped_;
  Servo servo_;
  bool is_posed_ = false;
  Pose posed_;
};

// Return whether two motions, or two servos, are the same at all times from the same start. Inputs are the same if their names are.
bool are_same(const std::vector<MotionTerm> &a, const InputNames &inputs_of_a,
              const std::vector<MotionTerm> &b, const InputNames &inputs_of_b);
bool are_same(const Servo &a, const InputNames &inputs_of_a, const Servo &b,
              const InputNames &inputs_of_b);

// Returns the largest distance between the places of a point of this box (in the mesh's frame) in two poses.
Real farthest_between(const Pose &a, const Pose &b, const Box &box);
// Returns the pose, at rest, after this share of the way from a to b: the origin of the mesh goes straight, and the mesh turns evenly.
Pose between(const Pose &a, const Pose &b, Real share);
// Returns the largest speed of a point of this box.
Real fastest_in(const Pose &pose, const Box &box);
// Returns the bounds of this box where the pose puts it.
Box placed_bounds(const Pose &pose, const Box &box);
// Returns the bounds of this box in both poses.
Box swept_bounds(const Pose &a, const Pose &b, const Box &box);

}    // namespace lsdcd
