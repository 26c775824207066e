// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "api/wall_caller.h"

#include "api/refusals.h"
#include "base/input_words.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace lsdcd {

namespace {

// A callback that fails has left the processes apart: nothing can be agreed on.
void check_call(int code, const char *callback)
{
  if (code != 0)
    throw ApiError(LSDCD_ERROR_ARGUMENT, std::string("`lsdcd_host`: ") + callback + "() returned " +
                                             std::to_string(code) + ", not 0: end all processes");
}

PeriodicBox box_of(const lsdcd_wall_options &o)
{
  bool any = false;
  for (int k = 0; k < 3; k++) {
    checked_flag(o.periodic[k],
                 element("lsdcd_wall_options.periodic", static_cast<std::size_t>(k)));
    any |= o.lo[k] != 0 || o.hi[k] != 0 || o.periodic[k] != 0;
  }
  PeriodicBox box = any ? PeriodicBox() : PeriodicBox::anywhere();
  for (int k = 0; k < 3 && any; k++) {
    if (!(o.lo[k] < o.hi[k]) || !std::isfinite(o.hi[k] - o.lo[k]))
      refuse_option("lsdcd_wall_options",
                    "lo must be below hi along each axis; leave both 0 where spheres go anywhere");
    box.corner[k] = o.lo[k];
    box.edge[k] = {0, 0, 0};
    box.edge[k][k] = o.hi[k] - o.lo[k];
    box.periodic[k] = o.periodic[k] != 0;
  }
  if (!(o.margin >= 0) || (box.any_periodic() && o.margin == 0))
    refuse_option("lsdcd_wall_options",
                  "margin is " + number_text(o.margin) +
                      "; with a periodic box say how far past a face a sphere may go");
  if (!std::isfinite(o.margin) || !std::isfinite(o.time))
    refuse_option("lsdcd_wall_options", "margin is " + number_text(o.margin) + ", time " +
                                            number_text(o.time) + "; both are finite");
  box.margin = o.margin;
  return box;
}

lsdcd_host host_of(const lsdcd_wall_options &o)
{
  lsdcd_host host = {};
  host.processes = 1;
  if (!o.host) return host;
  host = checked(o.host, "lsdcd_host");
  if (host.processes < 1 || host.rank < 0 || host.rank >= host.processes || host.node_rank < 0)
    refuse_option("lsdcd_host", "rank is " + std::to_string(host.rank) + " of " +
                                    counted(host.processes, "process", "processes") +
                                    ", node_rank " + std::to_string(host.node_rank) +
                                    "; ranks count from 0");
  const struct {
    bool is_there;
    const char *name;
  } needed[] = {{host.sum != nullptr, "sum"},
                {host.max != nullptr, "max"},
                {host.broadcast != nullptr, "broadcast"}};
  for (const auto &one : needed)
    if (!one.is_there)
      refuse_option("lsdcd_host", std::string("`") + one.name +
                                      "` is null: give all three, or no host for one process");
  return host;
}

}    // namespace

WallCaller::WallCaller(const lsdcd_wall_options &options) :
    box_(box_of(options)), message_(options.show), data_(options.data), host_(host_of(options))
{
  ranks_.rank = host_.rank;
  ranks_.processes = host_.processes;
  ranks_.node_rank = host_.node_rank;
}

void WallCaller::show(const std::string &text, bool is_warning)
{
  if (!message_ || !is_first()) return;
  try {
    message_(data_, is_warning, text.c_str());
  } catch (const std::exception &e) {
    show_threw_ = e.what();
  } catch (...) {
    show_threw_ = "not a std::exception";
  }
}

void WallCaller::tell_what_show_threw()
{
  if (show_threw_.empty()) return;
  throw ApiError(LSDCD_ERROR_CANCELLED, "`show` has thrown: " + std::exchange(show_threw_, ""));
}

void WallCaller::sum(Real *numbers, int n)
{
  if (!is_alone()) check_call(host_.sum(host_.data, numbers, n), "sum");
}

void WallCaller::max(Real *numbers, int n)
{
  if (!is_alone()) check_call(host_.max(host_.data, numbers, n), "max");
}

void WallCaller::broadcast(void *data, std::size_t bytes, int from, Receivers /*to*/)
{
  if (!is_alone() && bytes > 0)
    check_call(host_.broadcast(host_.data, data, bytes, from), "broadcast");
}

void WallCaller::agree(const Failure &mine, std::vector<Real> &numbers)
{
  numbers.push_back(mine.code == LSDCD_OK ? 0 : processes() - rank());
  max(numbers.data(), static_cast<int>(numbers.size()));
  const int from = processes() - static_cast<int>(numbers.back());
  numbers.pop_back();
  if (from == processes()) return;
  Failure first = mine;
  broadcast(&first.code, sizeof first.code, from);
  broadcast_text(*this, first.text, from);
  throw ApiError(first.code, first.text);
}

std::string WallCaller::sphere_text(std::int64_t tag) const
{
  const auto at = std::find(tags.begin(), tags.end(), tag);
  if (at == tags.end()) return "the sphere that came as number " + std::to_string(tag);
  return "sphere " + std::to_string(at - tags.begin()) + " (from 0)" +
         (is_alone() ? "" : " of process " + std::to_string(rank()));
}

void WallCaller::set_spheres(const Spheres &spheres)
{
  spheres_ = spheres;
  are_copied_ = false;
}

Spheres WallCaller::spheres_on_cpu()
{
  if (!gpu || spheres_.n == 0) return spheres_;
  const auto copy = [this](auto &to, const auto *from, std::size_t n) {
    to.resize(n);
    gpu->copy_out(from, to.data(), n * sizeof to[0]);
  };
  const std::size_t n = spheres_.n;
  const std::ptrdiff_t row = spheres_.x.row;
  if (!are_copied_) {
    copy(x_, spheres_.x.at, row * (n - 1) + 3);
    copy(v_, spheres_.v.at, row * (n - 1) + 3);
    copy(omega_, spheres_.omega.at, row * (n - 1) + 3);
    copy(radius_, spheres_.radius, n);
    copy(mass_, spheres_.mass, n);
    if (spheres_.temperature) copy(temperature_, spheres_.temperature, n);
    if (spheres_.type) copy(type_, spheres_.type, n);
    are_copied_ = true;
  }
  Spheres s;
  s.n = spheres_.n;
  s.x = {x_.data(), row, 1};
  s.v = {v_.data(), row, 1};
  s.omega = {omega_.data(), row, 1};
  s.radius = radius_.data();
  s.mass = mass_.data();
  s.temperature = spheres_.temperature ? temperature_.data() : nullptr;
  s.type = spheres_.type ? type_.data() : nullptr;
  return s;
}

HostSpheres WallCaller::tagged(const Spheres &spheres) const
{
  HostSpheres s = spheres;
  s.tag = tags.data();
  return s;
}

// Above those of all processes, and another one on each.
void WallCaller::name_new_spheres(std::int64_t highest)
{
  std::int64_t next = highest + 1 + rank();
  highest_tag_ = highest;
  for (std::int64_t &tag : tags) {
    if (tag == 0) {
      tag = next;
      next += processes();
    }
    highest_tag_ = std::max(highest_tag_, tag);
  }
}

}    // namespace lsdcd
