// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/reports/contact_rows.h"

#include "wall/sums/each_contact.h"

namespace lsdcd {

// The arm goes from the wall's closest point to the sphere's centre.
void add_virial(const StepResults &results, const std::vector<Pose> &poses, Real *virial)
{
  for (const StepContact &contact : results.contacts()) {
    const Pose &pose = poses[contact.mesh];
    const Vec3 r = pose.turn_to_box(contact.arm), f = -pose.turn_to_box(contact.force);
    const Real part[6] = {r.x * f.x, r.y * f.y, r.z * f.z, r.x * f.y, r.x * f.z, r.y * f.z};
    for (int c = 0; c < 6; c++) virial[c] += part[c];
  }
}

void for_contact_rows(const StepResults &results, const std::function<void(int, const Real *)> &row)
{
  for (const TouchingSphere &t : results.touching()) {
    const Real numbers[9] = {Real(t.n_contacts), t.force.x, t.force.y, t.force.z, t.point.x,
                             t.point.y,          t.point.z, t.radius,  t.heat};
    row(t.sphere, numbers);
  }
}

void for_contacts(WallEngine &engine, const std::vector<Pose> &poses,
                  const std::function<void(const WallContact &)> &found)
{
  const StepResults &results = engine.results();
  const KeptLosses *losses = results.losses().empty() ? nullptr : results.losses().data();
  for_each_contact(results, [&](const TouchingSphere &t, const StepContact &contact) {
    const Pose &pose = poses[contact.mesh];
    const Vec3 arm = pose.turn_to_box(contact.arm);
    found({t.sphere, static_cast<int>(contact.mesh), -pose.turn_to_box(contact.force), t.x - arm,
           engine.overlap(t, contact, pose), false, losses});
    if (losses) losses++;
  });
  for (const EndedContact &c : results.ended())
    found({c.sphere,
           static_cast<int>(c.mesh),
           {0, 0, 0},
           poses[c.mesh].to_box(c.point),
           0,
           true,
           &c.losses});
}

}    // namespace lsdcd
