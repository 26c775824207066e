// Where spheres and meshes were at a choice, to tell when it holds no longer.
#pragma once

#include "engine/engine_mesh.h"

#include <vector>

namespace lsdcd {

template <class B>
class KeptCentres {
 public:
  // From here on has_moved() tells whether a sphere has gone farther than `margin` (length) from where
  // it is, relative to any mesh.
  void keep(B &b, const Spheres &spheres, std::vector<EngineMesh<B>> &meshes, Real margin)
  {
    const std::size_t n = spheres.n;
    if (x_.size() < 3 * n) x_ = Array(3 * (n + n / 8));
    const StridedView<Real> to(x_.data());
    const StridedView<const Real> x = spheres.x;
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) { to.put(i, x[i]); });
    for (EngineMesh<B> &mesh : meshes) mesh.chosen = mesh.pose;
    margin_ = margin;
  }

  // A place that is no number has moved.
  bool has_moved(B &b, const Spheres &spheres, const std::vector<EngineMesh<B>> &meshes)
  {
    const StridedView<const Real> was(x_.data()), x = spheres.x;
    for (const EngineMesh<B> &mesh : meshes) {
      const WallPose pose = mesh.pose, chosen = mesh.chosen;
      const Real most = margin_ * margin_;
      if (b.any(spheres.n, flag_, [=] LSDCD_LAMBDA(std::size_t i) {
            return !(norm_sq(pose.to_mesh(x[i]) - chosen.to_mesh(was[i])) <= most);
          }))
        return true;
    }
    return false;
  }

  std::size_t bytes() const { return x_.size() * sizeof(Real); }

 private:
  using Array = typename B::template Array<Real>;

  Array x_;
  Real margin_ = 0;
  typename B::Flag flag_;
};

}    // namespace lsdcd
