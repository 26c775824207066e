// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Embree's point query: a BVH of the triangles, and a sphere that shrinks to the nearest one.
#include "peers.h"

#if defined(LSDCD_BENCH_EMBREE)
#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace lsdcd {

namespace {

using Point = Vec3Of<float>;

// Ericson 2005, section 5.1.5, as in Embree's own example of a closest point.
Point nearest_on(const Point &a, const Point &b, const Point &c, const Point &p)
{
  const Point u = b - a, v = c - a, from_a = p - a, from_b = p - b, from_c = p - c;
  const float ua = dot(u, from_a), va = dot(v, from_a), ub = dot(u, from_b), vb = dot(v, from_b),
              uc = dot(u, from_c), vc = dot(v, from_c);
  if (ua <= 0 && va <= 0) return a;
  if (ub >= 0 && vb <= ub) return b;
  if (vc >= 0 && uc <= vc) return c;
  const float area_c = ua * vb - ub * va, area_b = uc * va - ua * vc, area_a = ub * vc - uc * vb;
  if (area_c <= 0 && ua >= 0 && ub <= 0) return a + ua / (ua - ub) * u;
  if (area_b <= 0 && va >= 0 && vc <= 0) return a + va / (va - vc) * v;
  if (area_a <= 0 && vb >= ub && uc >= vc) return b + (vb - ub) / (vb - ub + uc - vc) * (c - b);
  const float whole = 1 / (area_a + area_b + area_c);
  return a + area_b * whole * u + area_c * whole * v;
}

struct Scene {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  std::vector<Point> corners;    // three a triangle

  ~Scene()
  {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

struct Nearest {
  const Point *corners;
  float distance = HUGE_VALF;
};

bool nearer(RTCPointQueryFunctionArguments *args)
{
  Nearest &nearest = *static_cast<Nearest *>(args->userPtr);
  const Point *t = nearest.corners + 3 * std::size_t(args->primID);
  const Point p = {args->query->x, args->query->y, args->query->z};
  const Point apart = p - nearest_on(t[0], t[1], t[2], p);
  const float squared = dot(apart, apart);
  if (!(squared < args->query->radius * args->query->radius)) return false;
  args->query->radius = nearest.distance = std::sqrt(squared);
  return true;
}

PeerQuery build(const TriangleSoup &mesh)
{
  const auto made = std::make_shared<Scene>();
  for (const Vec3 &x : mesh.corners)
    made->corners.push_back(
        {static_cast<float>(x.x), static_cast<float>(x.y), static_cast<float>(x.z)});
  RTCGeometry triangles = rtcNewGeometry(made->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto *vertex = static_cast<Point *>(rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0,
                                                              RTC_FORMAT_FLOAT3, sizeof(Point),
                                                              made->corners.size()));
  std::copy(made->corners.begin(), made->corners.end(), vertex);
  auto *index = static_cast<unsigned *>(
      rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), made->corners.size() / 3));
  for (std::size_t i = 0; i < made->corners.size(); i++) index[i] = static_cast<unsigned>(i);
  rtcCommitGeometry(triangles);
  rtcAttachGeometry(made->scene, triangles);
  rtcReleaseGeometry(triangles);
  rtcSetSceneBuildQuality(made->scene, RTC_BUILD_QUALITY_HIGH);
  rtcCommitScene(made->scene);
  return [made](const Sphere *spheres, std::size_t n, double *distance) {
    for (std::size_t i = 0; i < n; i++) {
      RTCPointQuery query = {static_cast<float>(spheres[i].x), static_cast<float>(spheres[i].y),
                             static_cast<float>(spheres[i].z), 0, static_cast<float>(spheres[i].r)};
      RTCPointQueryContext context;
      rtcInitPointQueryContext(&context);
      Nearest nearest = {made->corners.data()};
      rtcPointQuery(made->scene, &query, &context, nearer, &nearest);
      distance[i] = nearest.distance;
    }
  };
}

}    // namespace

Peer embree()
{
  return {"Embree " RTC_VERSION_STRING ", float", build, "libembree-dev", 1e7};
}

}    // namespace lsdcd

#else

namespace lsdcd {

Peer embree()
{
  return {"Embree", nullptr, "libembree-dev", 0};
}

}    // namespace lsdcd

#endif
