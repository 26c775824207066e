// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench.h"

#include "backend/backend_cpu.h"
#include "backend/threads.h"
#include "on_cuda.h"
#include "query/point_query.h"
#include "support/meshes.h"

#include <chrono>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>

namespace lsdcd {

std::string format(const char *how, ...)
{
  char text[512];
  va_list list;
  va_start(list, how);
  std::vsnprintf(text, sizeof text, how, list);
  va_end(list);
  return text;
}

namespace {

const char *kWords =
    "  --device cpu|cuda     one device alone (default: the CPU and, where there is one, a GPU)\n"
    "  --spheres N           how many\n"
    "  --most-triangles N    leave larger meshes out\n"
    "  --length L            of cells\n"
    "  --repeats N           timed runs after one to warm up\n"
    "  --quick               small sizes, to see that all runs\n"
    "  --commit NAME         what was built\n";

[[noreturn]] void stop(const std::string &why)
{
  std::fprintf(stderr, "%s; --help lists the options\n", why.c_str());
  std::exit(2);
}

double number(const std::string &word, const char *value)
{
  char *end = nullptr;
  const double x = std::strtod(value, &end);
  if (end == value || *end != 0 || !(x > 0)) stop(word + " takes a number above 0, not " + value);
  return x;
}

std::string cpu_model()
{
  std::ifstream f("/proc/cpuinfo");
  for (std::string line; std::getline(f, line);)
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
      return ", " + line.substr(line.find(": ") + 2);
  return "";
}

std::string quoted(const std::string &text)
{
  return text.find_first_of(",\"") == std::string::npos ? text : '"' + text + '"';
}

double cpu_copy_gb_s()
{
  constexpr std::size_t kBytes = std::size_t(1) << 29;
  CpuBackend::Array<char> from(kBytes), to(kBytes);
  const int n = threads();
  const std::size_t part = kBytes / n;
  const auto each = [&](auto f) {
#pragma omp parallel for schedule(static, 1) num_threads(n)
    for (int k = 0; k < n; k++) f(k * part);
  };
  each([&](std::size_t at) {    // each thread's pages are its own
    std::memset(from.data() + at, 1, part);
    std::memset(to.data() + at, 2, part);
  });
  const Timing t = time_it(9, [&] {
    each([&](std::size_t at) { std::memcpy(to.data() + at, from.data() + at, part); });
  });
  return 2 * double(part) * n / t.min_ms / 1e6;
}

// Bytes read and written per second by copying a large block, in units of 1e9: the fastest
// of several copies, on the CPU with all of threads().
double copy_gb_s(Device device)
{
#if defined(LSDCD_HAVE_CUDA)
  if (device == Device::cuda) return cuda_copy_gb_s();
#endif
  (void) device;
  return cpu_copy_gb_s();
}

// Prints what is wrong with the words, or for --help those there are, and ends the program.
BenchOptions read_options(int argc, char **argv, const char *about)
{
  BenchOptions o;
  o.commit = LSDCD_COMMIT;
  std::string device;
  for (int i = 1; i < argc; i++) {
    const std::string word = argv[i];
    if (word == "--help") {
      std::printf("%s\n%s", about, kWords);
      std::exit(0);
    }
    if (word == "--quick") {
      o.quick = true;
      continue;
    }
    if (i + 1 == argc) stop("no such option, or no value: " + word);
    const char *value = argv[++i];
    if (word == "--device")
      device = value;
    else if (word == "--spheres")
      o.spheres = number(word, value);
    else if (word == "--most-triangles")
      o.most_triangles = number(word, value);
    else if (word == "--length")
      o.length = number(word, value);
    else if (word == "--repeats")
      o.repeats = static_cast<int>(number(word, value));
    else if (word == "--commit")
      o.commit = value;
    else
      stop("no such option: " + word);
  }
  if (!device.empty() && device != "cpu" && device != "cuda") stop("no such device: " + device);
  std::string why;
  const bool cuda = cuda_available(&why);
  if (device == "cuda" && !cuda) stop("device cuda: " + why);
  if (device.empty() && !cuda) std::fprintf(stderr, "CUDA rows are left out: %s\n", why.c_str());
  if (device != "cuda") o.devices.push_back(Device::cpu);
  if (device != "cpu" && cuda) o.devices.push_back(Device::cuda);
  return o;
}

bool of_one_thread = false;

}    // namespace

const char *compiler()
{
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

double clock_ms()
{
  if (of_one_thread) return 1e3 * double(std::clock()) / CLOCKS_PER_SEC;
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(now).count();
}

Timing timing_of(std::vector<double> ms)
{
  std::sort(ms.begin(), ms.end());
  return {ms[ms.size() / 2], ms.front(), ms.back(), static_cast<int>(ms.size())};
}

std::vector<TriangleSoup> cylinders(const BenchOptions &options, double most)
{
  if (options.quick) most = 1e4;
  if (options.most_triangles > 0) most = options.most_triangles;
  const struct {
    int round, along;
  } sizes[] = {{40, 1}, {100, 49}, {400, 124}, {2000, 249}};
  std::vector<TriangleSoup> all;
  for (const auto &s : sizes)
    if (2. * s.round * (s.along + 1) <= most)
      all.push_back(cylinder_mesh(s.round, s.along, 50, 100));
  return all;
}

BenchRows::BenchRows(const char *program, const std::string &commit) :
    program_(program), commit_(commit)
{
  std::puts(
      "program,case,device,commit,compiler,triangles,spheres,length,order,repeats,median_ms,min_ms,"
      "max_ms,bytes,copy_gb_s,floor_ms,ratio,facts");
}

void BenchRows::begin(Device device)
{
  device_ = CpuBackend().name() + cpu_model();
#if defined(LSDCD_HAVE_CUDA)
  if (device == Device::cuda) device_ = current_cuda_name();
#endif
  of_one_thread = device == Device::cpu && threads() == 1;
  copy_gb_s_ = copy_gb_s(device);
}

void BenchRows::add(const BenchRow &r)
{
  const double floor_ms = r.bytes / copy_gb_s_ / 1e6;
  const std::string line = program_ + ',' + quoted(r.what) + ',' + quoted(device_) + ',' +
                           quoted(commit_) + ',' + quoted(compiler()) +
                           format(",%zu,%zu,%.6g,%s,%d,%.5g,%.5g,%.5g,", r.triangles, r.spheres,
                                  r.length, r.order.c_str(), r.timing.repeats, r.timing.median_ms,
                                  r.timing.min_ms, r.timing.max_ms) +
                           (r.bytes > 0 ? format("%.6g,%.5g,%.4g,%.4g,", r.bytes, copy_gb_s_,
                                                 floor_ms, r.timing.median_ms / floor_ms)
                                        : format(",%.5g,,,", copy_gb_s_)) +
                           quoted(r.facts);
  std::puts(line.c_str());
  std::fflush(stdout);
}

ContactLaw usual_law(NormalModel normal, bool has_history)
{
  ContactLaw law = classic_law(normal, has_history);
  law.k_normal = 1e5;
  law.k_tangent = 3e4;
  law.eta = 50;
  law.gamma_tangent = 25;
  law.mu = 0.5;
  return law;
}

int run_bench(int argc, char **argv, const char *program, const char *about,
              void (*measure)(const BenchOptions &, BenchRows &))
{
  const BenchOptions options = read_options(argc, argv, about);
  try {
    BenchRows rows(program, options.commit);
    measure(options, rows);
    return 0;
  } catch (const std::exception &e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}

}    // namespace lsdcd
