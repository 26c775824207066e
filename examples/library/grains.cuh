// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Grains on a GPU that push each other, for fall.cu and wheel.cu.
#ifndef GRAINS_CUH
#define GRAINS_CUH

#include <cuda_runtime.h>
#include <stdexcept>
#include <vector>

constexpr int kThreads = 128;

inline void check(cudaError_t status)
{
  if (status != cudaSuccess) throw std::runtime_error(cudaGetErrorString(status));
}

template <class T>
struct OnGpu {
  T *at = nullptr;
  explicit OnGpu(const std::vector<T> &values)
  {
    check(cudaMalloc(&at, values.size() * sizeof(T)));
    check(cudaMemcpy(at, values.data(), values.size() * sizeof(T), cudaMemcpyHostToDevice));
  }
  ~OnGpu() { cudaFree(at); }
  OnGpu(const OnGpu &) = delete;
  OnGpu &operator=(const OnGpu &) = delete;
};

// Grains of one size, x y z x y z; cells as wide as a grain, each with a list of its grains.
struct Scene {
  int n, cells[3];
  double radius, mass, stiffness, damping, friction, gravity, dt,
      lo[3];    // friction: a share of the push; 0: none
  double *x, *v, *omega, *force, *torque;
  int *head, *next;    // the first grain of a cell, the next one of a grain; -1: none

  __device__ int cell(int i, int k) const
  {
    const int c = static_cast<int>((x[3 * i + k] - lo[k]) / (2 * radius));
    return min(max(c, 0), cells[k] - 1);
  }
};

__global__ void kick_and_drift(Scene s, bool drifts)
{
  const int k = blockIdx.x * blockDim.x + threadIdx.x;
  if (k >= 3 * s.n) return;
  s.v[k] += 0.5 * s.dt * s.force[k] / s.mass;
  s.omega[k] += 0.5 * s.dt * s.torque[k] / (0.4 * s.mass * s.radius * s.radius);
  if (drifts) s.x[k] += s.dt * s.v[k];
}

__global__ void list(Scene s)
{
  const int i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i >= s.n) return;
  const int c = (s.cell(i, 2) * s.cells[1] + s.cell(i, 1)) * s.cells[0] + s.cell(i, 0);
  s.next[i] = atomicExch(s.head + c, i);
}

__global__ void push_each_other(Scene s)
{
  const int i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i >= s.n) return;
  double f[3] = {0, 0, -s.mass * s.gravity}, t[3] = {0, 0, 0};
  for (int near = 0; near < 27; near++) {
    const int at[3] = {s.cell(i, 0) + near % 3 - 1, s.cell(i, 1) + near / 3 % 3 - 1,
                       s.cell(i, 2) + near / 9 - 1};
    bool inside = true;
    for (int k = 0; k < 3; k++) inside &= at[k] >= 0 && at[k] < s.cells[k];
    if (!inside) continue;
    for (int j = s.head[(at[2] * s.cells[1] + at[1]) * s.cells[0] + at[0]]; j >= 0; j = s.next[j]) {
      double d[3], square = 0, approach = 0;
      for (int k = 0; k < 3; k++) {
        d[k] = s.x[3 * i + k] - s.x[3 * j + k];
        square += d[k] * d[k];
        approach -= d[k] * (s.v[3 * i + k] - s.v[3 * j + k]);
      }
      if (i == j || square >= 4 * s.radius * s.radius) continue;
      const double distance = sqrt(square);
      const double push =
          fmax(s.stiffness * (2 * s.radius - distance) + s.damping * approach / distance, 0.);
      for (int k = 0; k < 3; k++) f[k] += push * d[k] / distance;
      if (s.friction == 0) continue;
      // Against the sliding of the surfaces, by `damping` at most.
      double slip[3], speed = 0;
      for (int k = 0; k < 3; k++) {
        const int p = (k + 1) % 3, q = (k + 2) % 3;
        const double turn = s.radius / distance *
                            ((s.omega[3 * i + p] + s.omega[3 * j + p]) * d[q] -
                             (s.omega[3 * i + q] + s.omega[3 * j + q]) * d[p]);
        slip[k] = s.v[3 * i + k] - s.v[3 * j + k] + approach * d[k] / square - turn;
        speed += slip[k] * slip[k];
      }
      speed = sqrt(speed);
      const double drag = speed > 0 ? fmin(s.damping, s.friction * push / speed) : 0;
      for (int k = 0; k < 3; k++) f[k] -= drag * slip[k];
      for (int k = 0; k < 3; k++) {
        const int p = (k + 1) % 3, q = (k + 2) % 3;
        t[k] += s.radius * drag / distance * (d[p] * slip[q] - d[q] * slip[p]);
      }
    }
  }
  for (int k = 0; k < 3; k++) {
    s.force[3 * i + k] = f[k];
    s.torque[3 * i + k] = t[k];
  }
}

// Makes cells in the box from `lo` to `hi`, and returns their number.
inline int set_cells(Scene &s, const double *lo, const double *hi)
{
  int n = 1;
  for (int k = 0; k < 3; k++) {
    s.lo[k] = lo[k];
    s.cells[k] = 1 + static_cast<int>((hi[k] - lo[k]) / (2 * s.radius));
    n *= s.cells[k];
  }
  return n;
}

// Starts the kernels that set the forces of the grains on each other and their weight.
inline void start_forces(const Scene &s, cudaStream_t stream)
{
  const int blocks = (s.n + kThreads - 1) / kThreads;
  const std::size_t n_cells = std::size_t(s.cells[0]) * s.cells[1] * s.cells[2];
  check(cudaMemsetAsync(s.head, -1, n_cells * sizeof(int), stream));
  list<<<blocks, kThreads, 0, stream>>>(s);
  push_each_other<<<blocks, kThreads, 0, stream>>>(s);
}

// Starts the kernel of half a step of velocities, and, if it `drifts`, of a step of places.
inline void start_kick(const Scene &s, bool drifts, cudaStream_t stream)
{
  kick_and_drift<<<(3 * s.n + kThreads - 1) / kThreads, kThreads, 0, stream>>>(s, drifts);
}

#endif
