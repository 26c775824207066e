// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Pairs of triangles that meet, by FCL's trees of boxes of both meshes. Its test of two triangles
// rounds.
#pragma once

#include "bodies/body_collision.h"
#include "mesh/welded_mesh.h"

#include <fcl/fcl.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

namespace lsdcd {

class FclCollision {
  using Tree = fcl::BVHModel<fcl::OBBRSS<double>>;

 public:
  FclCollision(const WeldedMesh &wall, const TriangleSoup &body)
  {
    TriangleSoup faces;
    for (const auto &f : wall.faces)
      for (int k = 0; k < 3; k++) faces.corners.push_back(wall.vertices[f[k]]);
    wall_ = tree_of(faces);
    body_ = tree_of(body);
  }

  std::vector<BodyPair> collide(const BodyPose &pose) const
  {
    fcl::Transform3<double> to = fcl::Transform3<double>::Identity();
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) to.linear()(i, j) = pose.row[i][j];
    to.translation() << pose.shift.x, pose.shift.y, pose.shift.z;
    const fcl::CollisionRequest<double> all(std::numeric_limits<int>::max());
    fcl::CollisionResult<double> result;
    fcl::collide(body_.get(), to, wall_.get(), fcl::Transform3<double>::Identity(), all, result);
    std::vector<BodyPair> pairs;
    for (std::size_t i = 0; i < result.numContacts(); i++) {
      const auto &contact = result.getContact(i);
      pairs.push_back(
          {static_cast<std::uint32_t>(contact.b1), static_cast<FeatureCode>(contact.b2)});
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

 private:
  static std::unique_ptr<Tree> tree_of(const TriangleSoup &soup)
  {
    auto tree = std::make_unique<Tree>();
    const auto at = [&](std::size_t c) {
      const Vec3 &x = soup.corners[c];
      return fcl::Vector3<double>(x.x, x.y, x.z);
    };
    tree->beginModel(static_cast<int>(soup.n_triangles()), static_cast<int>(soup.corners.size()));
    for (std::size_t c = 0; c < soup.corners.size(); c += 3)
      tree->addTriangle(at(c), at(c + 1), at(c + 2));
    tree->endModel();
    return tree;
  }
  std::unique_ptr<Tree> wall_, body_;
};

}    // namespace lsdcd
