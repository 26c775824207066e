// How a law is compiled for an NVIDIA GPU.
#pragma once

#include "engine/backend_cuda.h"
#include "engine/compiled_law.h"
#include "engine/laws.h"

#include <cstdint>

namespace lsdcd {

// A near sphere as it travels to the GPU.
struct NearSphere {
  Vec3 x, v, omega;
  Real radius, mass;
  std::int32_t first_spring, n_springs;
};

// The work of a step on the device: as HostJob, with the spheres themselves. Pointers
// that the law has no use for may be null.
struct CudaJob {
  GridView grid;
  ForceSettings settings;
  const NearSphere *spheres;
  const Spring *springs;
  const Real *extra, *temperature;
  SphereResult *result;
  SphereSink sink;    // of the first sphere
};

struct CudaLaw {
  LawBytes law;
  void (*start)(const LawBytes &, const CudaJob &, std::size_t n, CudaBackend &);
};

CudaLaw cuda_law(const EngineSettings &settings);

// Those of `granular`, one function per normal sub-model: a source file each.
CudaLaw cuda_hooke_law(const EngineSettings &);
CudaLaw cuda_hertz_law(const EngineSettings &);
CudaLaw cuda_dmt_law(const EngineSettings &);
CudaLaw cuda_jkr_law(const EngineSettings &);

// Those of the classic styles with effects of LIGGGHTS, and on walls with effects.
CudaLaw cuda_added_law(const EngineSettings &);
CudaLaw cuda_on_wall_law(const EngineSettings &);

template <class Law>
void start_law(const LawBytes &bytes, const CudaJob &job, std::size_t n, CudaBackend &backend)
{
  const Law law = bytes.as<Law>();
  backend.for_each(
      n,
      [=] __device__(std::size_t k) {
        const NearSphere &at = job.spheres[k];
        SphereState s = {at.x,    at.v,    at.omega,     at.radius, at.mass,
                         nullptr, nullptr, at.n_springs, 0};
        SphereSink sink;    // what the law has no use for is not even set
        if constexpr (Law::kHistory) {
          s.springs = job.springs + at.first_spring;
          sink.springs = job.sink.springs + k * kPlaces;
        }
        if constexpr (Law::kExtra > 0) {
          s.extra = job.extra + std::size_t(at.first_spring) * Law::kExtra;
          sink.extra = job.sink.extra + k * kPlaces * Law::kExtra;
        }
        if constexpr (Law::kHeat) {
          s.temperature = job.temperature[k];
          sink.heat = job.sink.heat + k;
        }
        if constexpr (Law::kRecords) sink.records = job.sink.records + k * kPlaces;
        job.result[k] = wall_force<Law, kPlaces>(job.grid, law, job.settings, s, sink);
      },
      128);
}

// For with_..._law() of laws.h.
template <WallKernels kernels>
struct MakeCudaLaw {
  WallEffects effects;

  template <class Law>
  CudaLaw operator()(const Law &law) const
  {
    return on_wall<kernels>(law, effects, [](const auto &compiled) {
      return CudaLaw{LawBytes(compiled), start_law<std::decay_t<decltype(compiled)>>};
    });
  }
};

}    // namespace lsdcd
