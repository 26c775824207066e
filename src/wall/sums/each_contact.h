// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The contacts of a step one by one, and the directions in which each is stiff.
#pragma once

#include "engine/results/step_results.h"
#include "law/contact_slope.h"

namespace lsdcd {

// Calls visit(sphere, contact) for each contact of a step with per_sphere and contacts, sphere after sphere.
template <class Visit>
void for_each_contact(const StepResults &results, const Visit &visit)
{
  const StepContact *contact = results.contacts().data();
  for (const TouchingSphere &sphere : results.touching())
    for (int n = 0; n < sphere.n_contacts; n++) visit(sphere, *contact++);
}

// Calls add(direction, slope) for the unit normal of a contact and for two directions across it.
template <class Add>
void for_each_direction(const Vec3 &normal, const ContactSlopes &slopes, const Add &add)
{
  const Vec3 along = any_perpendicular(normal);
  add(normal, slopes.normal);
  add(along, slopes.tangential);
  add(cross(normal, along), slopes.tangential);
}

}    // namespace lsdcd
