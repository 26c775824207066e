// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The answers of a setting for a sample of spheres, and their errors.
#pragma once

#include "engine/engine.h"
#include "study/sphere_sample.h"

#include <vector>

namespace lsdcd {

// Contacts of spheres at rest, and forces of linear springs: all sub-models take the same contacts.
struct WallAnswers {
  struct Contact {
    Vec3 closest;    // from the sphere's centre to the wall, length
    Real overlap;    // length
    bool bears;      // takes a share of the force
  };
  std::vector<std::size_t> first;    // contacts of sphere i: first[i] .. first[i + 1]
  std::vector<Contact> contacts;
  std::vector<Vec3> force;
  long uncertified = 0;    // spheres with lists that may lack a contact
};

// Computed on the CPU; every device has the same numbers. Only stiffness and corner rule of `engine`
// matter.
WallAnswers evaluate_sample(const ViewOf<StepGrid> &grid, const EngineSettings &engine,
                            const SphereSample &sample);

// Rounding decides whether there is a contact so shallow: it is not counted. Share of a radius.
constexpr Real kGrazing = 1e-4;
// Forces of a sphere are compared to the larger of its own and that of one contact
// with this overlap, because a grazing contact's force is all rounding. Share of a radius.
constexpr Real kUsualOverlap = 1e-2;

struct AnswerError {
  long contacts = 0;    // that the reference counts
  long missed = 0;      // of these, not there: no contact has its closest point within 1e-3 radii
  long uncertified = 0;
  // Relative errors of the spheres' forces, over all spheres that touch in either answer.
  Real median = 0, largest = 0;
  Real mean = 0;    // sum of errors / sum of forces

  Real missed_share() const { return contacts > 0 ? Real(missed) / contacts : 0; }
};

AnswerError compare(const WallAnswers &reference, const WallAnswers &trial,
                    const SphereSample &sample, Real stiffness);

}    // namespace lsdcd
