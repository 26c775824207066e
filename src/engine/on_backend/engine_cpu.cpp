// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The engines on a CPU: that of spheres, and on top of it that of grains of any shape.
#include "backend/backend_cpu.h"
#include "base/input_error.h"
#include "engine/broad_phase/selection_cpu.h"
#include "engine/on_backend/engine_on.h"
#include "engine/shape_engine.h"
#include "engine/step/compile_law.h"
#include "engine/step/shape_law.h"
#include "shape/triangle_minimum.h"

#include <string>
#include <utility>

namespace lsdcd {

template class EngineOn<CpuBackend>;

std::unique_ptr<WallEngine> make_cpu_engine(const EngineSettings &settings)
{
  return std::make_unique<EngineOn<CpuBackend>>(settings, law_for<CpuBackend>(settings),
                                                CpuBackend());
}

namespace {

// Shapes of all candidates, before a step.
class Shapes {
 public:
  ShapeWork work;

  // Without shapes made, which are few.
  std::size_t bytes() const
  {
    std::size_t lists = work.near.capacity() * sizeof(NearList);
    for (const NearList &near : work.near) lists += near.features.bytes();
    return lists + work.shape.capacity() * sizeof(Superellipsoid) +
           work.turn.capacity() * sizeof(Quaternion);
  }

  void prepare(const Spheres &spheres, const int *candidates, int n)
  {
    work.rows = spheres.shapes;
    if (!work.rows) return;
    // It never shrinks: a look asks for a grain of a step that may have had more.
    if (work.shape.size() < static_cast<std::size_t>(spheres.n)) {
      work.shape.resize(spheres.n);
      work.turn.resize(spheres.n);
    }
    for (int k = 0; k < n; k++) {
      const int i = candidates[k];
      if (work.rows[i].is_sphere())
        work.shape[i].half = {0, 0, 0};
      else
        prepare_one(work.rows[i], spheres.radius[i], i);
    }
  }

  // Returns the overlap of a contact of the last step: where it is not less than the least radius of curvature that with the plane of a
  // face or about an edge, if the wall's point is the foot of that; else how deep the point is in the grain. Where the depth was not found
  // to rounding, the next read of the diagnostics is an error.
  Real overlap(const TouchingSphere &of, const StepContact &contact, const Pose &pose)
  {
    const Superellipsoid &shape = work.shape[of.sphere];
    const auto to_own = [&](const Vec3 &in_mesh) {
      return rotate(inverse(work.turn[of.sphere]), pose.turn_to_box(in_mesh));
    };
    const Vec3 point = to_own(-contact.arm);
    const auto is_foot_of = [&](const TangentMinimum &t) {
      constexpr Real kSame = 1e-9;    // of the gauge
      return t.is_highest && !(-t.distance < shape.rho) &&
             gauge_value(shape, point - t.distance * t.normal) <= 1 + kSame;
    };
    const TreeView &view = work.trees[contact.mesh]->view();
    const std::uint32_t i = feature_index(contact.feature);
    if (feature_kind(contact.feature) == FeatureKind::face) {
      const TangentMinimum plane =
          tangent_over_plane(shape, point, to_own(view.primitives[view.face_primitive[i]].normal));
      if (is_foot_of(plane)) return -plane.distance;
    }
    if (feature_kind(contact.feature) == FeatureKind::edge) {
      const Vec3 along =
          to_own(view.vertices[view.edges[2 * i + 1]] - view.vertices[view.edges[2 * i]]);
      const TangentMinimum line = TangentAboutLine(shape, point, (1 / norm(along)) * along).find();
      if (is_foot_of(line)) return -line.distance;
    }
    const SurfacePoint nearest = nearest_on_surface(shape, point);
    if (!nearest.is_sure) raise_to(&work.unsure, kNoSphere - of.sphere);
    return -nearest.distance;
  }

 private:
  void prepare_one(const GrainShape &row, Real radius, int i)
  {
    Superellipsoid &shape = work.shape[i];
    try {
      if (!(row.half == shape.half && row.n1 == shape.n1 && row.n2 == shape.n2))
        shape = made_.get(row.half, row.n1, row.n2);
      for (int k = 0; k < 3; k++)
        if (!(row.inertia_over_mass[k] > 0))
          throw InputError("a moment of inertia of a shape is not above 0");
    } catch (const InputError &e) {
      throw InputError(i, std::string("has a shape that cannot be: ") + e.what());
    }
    work.turn[i] = row.turn;
    if (radius < shape.farthest * (1 - kRadiusRounding))
      throw std::logic_error("the radius of a grain must be that of a sphere around it");
  }
  static constexpr Real kRadiusRounding = 1e-12;

  ShapesMade made_;
};

class ShapeEngine : public EngineOn<CpuBackend> {
 public:
  ShapeEngine(const EngineSettings &settings, std::unique_ptr<Shapes> shapes) :
      EngineOn(settings, shape_law_for(settings, shapes->work), CpuBackend()),
      shapes_(std::move(shapes))
  {
    shapes_->work.trees.resize(settings.meshes);
  }

  void set_tree(const TriangleTree &tree, int mesh) override
  {
    shapes_->work.trees.at(mesh) = &tree;
    shapes_->work.near.clear();
  }
  void choose(const Spheres &spheres, Real margin, bool watch) override
  {
    shapes_->work.near.clear();
    EngineOn::choose(spheres, margin, watch);
  }
  void submit(const Spheres &spheres, const StepSettings &step) override
  {
    shapes_->work.near.resize(static_cast<std::size_t>(n_candidates()));
    shapes_->prepare(spheres, candidates(), n_candidates());
    EngineOn::submit(spheres, step);
  }
  Real overlap(const TouchingSphere &of, const StepContact &contact, const Pose &pose) override
  {
    const bool is_sphere = !shapes_->work.rows || shapes_->work.shape[of.sphere].half.x == 0;
    return is_sphere ? EngineOn::overlap(of, contact, pose) : shapes_->overlap(of, contact, pose);
  }
  std::size_t bytes() const override { return EngineOn::bytes() + shapes_->bytes(); }
  StepDiagnostics read_diagnostics() override
  {
    const std::uint64_t unsure = std::exchange(shapes_->work.unsure, 0);
    if (unsure != 0)
      throw InputError(static_cast<int>(kNoSphere - unsure),
                       "has a nearest point that was not found to rounding: please report its "
                       "shape and how it lies");
    StepDiagnostics seen = EngineOn::read_diagnostics();
    const std::uint64_t sharpest = std::exchange(shapes_->work.sharpest, 0);
    if (sharpest == 0) return seen;
    seen.sharpest =
        from_ascending_bits(static_cast<std::uint32_t>(sharpest >> DeepestOverlap::kRatioAt));
    seen.sharpest_grain = static_cast<int>(sharpest & DeepestOverlap::kRest) - 1;
    seen.sharpest_curvature = shapes_->work.shape[seen.sharpest_grain].rho;
    return seen;
  }

 private:
  std::unique_ptr<Shapes> shapes_;
};

}    // namespace

std::unique_ptr<WallEngine> make_shape_engine(const EngineSettings &settings)
{
  return std::make_unique<ShapeEngine>(settings, std::make_unique<Shapes>());
}

}    // namespace lsdcd
