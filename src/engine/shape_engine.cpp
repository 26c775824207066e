// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "engine/shape_engine.h"

#include "backend/backend_cpu.h"
#include "base/input_error.h"
#include "engine/broad_phase/selection_cpu.h"
#include "engine/engine_on.h"
#include "engine/step/compile_law.h"
#include "engine/step/shape_step.h"
#include "shape/nearest_on_surface.h"

#include <string>
#include <utility>

namespace lsdcd {

extern template class EngineOn<CpuBackend>;    // compiled in engine_cpu.cpp

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

  // Returns the overlap of a contact of the last step: the depth of the wall's point in the grain. Where that was not found to
  // rounding, the next read of the diagnostics is an error.
  Real overlap(const TouchingSphere &of, const Vec3 &arm)
  {
    const Superellipsoid &shape = work.shape[of.sphere];
    const Vec3 in_grain = rotate(inverse(work.turn[of.sphere]), -arm);
    const SurfacePoint nearest = nearest_on_surface(shape, in_grain);
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

// Does the law read Contact::radius?
template <class Normal, class Damping, class Tangential>
bool reads_radius(const ContactModel<Normal, Damping, Tangential> &)
{
  return Normal::kUsesContactRadius;
}
template <class Normal, bool kHistory>
bool reads_radius(const GranularModel<Normal, kHistory, false> &law)
{
  return law.uses_contact_radius || law.elastic.uses_contact_radius();
}

// Returns a law for shapes by one of spheres; all of them have the kernels of walls that move and keep contacts.
template <class Base>
CompiledLaw<CpuBackend> compiled(const Base &base, ShapeWork &work)
{
  static_assert(Base::kExtra == 0 && !Base::kBeyondContact && !Base::kContactTorque,
                "such laws are not for shapes");
  using Law = OnWall<ShapeLaw<Base::kHistory>, true, true>;
  work.laws.emplace_back(base);
  const auto evaluate = [](const LawBytes &of, const Contact &c, ContactMemory<0> &memory) {
    return static_cast<ContactForce>(of.as<Base>().evaluate(c, memory));
  };
  const Law law = {{&work.laws.back(), evaluate, reads_radius(base), &work}};
  return {traits_of(law), {LawBytes(law)}, run_shape_law<Law, CpuBackend>};
}

CompiledLaw<CpuBackend> compiled_law(const ContactLaw &p, ShapeWork &work)
{
  const std::string why = why_not_for_shapes(p);
  if (!why.empty()) throw InputError(why);
  if (p.is_classic())
    return with_classic_law(p, [&](const auto &law) { return compiled(law, work); });
  const TouchingNormal normal = {p.normal, p.k_normal, 0};
  return p.has_history() ? compiled(granular_model<true, false>(p, normal), work)
                         : compiled(granular_model<false, false>(p, normal), work);
}

CompiledLaw<CpuBackend> compiled_laws(const EngineSettings &settings, ShapeWork &work)
{
  CompiledLaw<CpuBackend> all = compiled_law(settings.law(), work);
  all.laws.clear();
  for (const ContactLaw &law : settings.laws.laws)
    all.laws.push_back(compiled_law(law, work).laws.front());
  return all;
}

class ShapeEngine : public EngineOn<CpuBackend> {
 public:
  ShapeEngine(const EngineSettings &settings, std::unique_ptr<Shapes> shapes) :
      EngineOn(settings, compiled_laws(settings, shapes->work), CpuBackend()),
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
  Real overlap(const TouchingSphere &of, const Vec3 &arm) override
  {
    const bool is_sphere = !shapes_->work.rows || shapes_->work.shape[of.sphere].half.x == 0;
    return is_sphere ? EngineOn::overlap(of, arm) : shapes_->overlap(of, arm);
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

std::string why_not_for_shapes(const ContactLaw &law)
{
  const auto refused = [](const char *what) {
    return std::string(what) +
           ": the wall has it for spheres alone; grains of other shapes can have hooke and hertz "
           "with their damping and sliding friction";
  };
  if (law.is(NormalModel::jkr) || law.is(NormalModel::dmt)) return refused("adhesion");
  if (law.cohesion.is_on()) return refused("cohesion");
  if (law.rolling.is_on()) return refused("rolling resistance");
  if (law.twisting.is_on()) return refused("twisting resistance");
  if (law.has_heat()) return refused("heat");
  if (law.rescales()) return refused("a tangential spring that is rescaled");
  return "";
}

std::unique_ptr<WallEngine> make_shape_engine(const EngineSettings &settings)
{
  return std::make_unique<ShapeEngine>(settings, std::make_unique<Shapes>());
}

}    // namespace lsdcd
