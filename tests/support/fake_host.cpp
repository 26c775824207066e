// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "support/fake_host.h"

#include "base/input_error.h"

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace lsdcd {

// Where the processes of a host meet in each collective call.
struct FakeHost::Meeting {
  std::mutex mutex;
  std::condition_variable changed;
  int here = 0, held = 0;          // processes that have come to this call; calls that were held
  bool left = false;               // some process makes no more calls
  std::string call;                // of those who have come
  std::vector<Bytes> now, last;    // what they brought to this call, and to the one before
};

void on_processes(int n, const std::function<void(FakeHost &)> &work)
{
  FakeHost::Meeting meeting;
  meeting.now.resize(n);
  std::vector<FakeHost> hosts(n);
  std::vector<std::exception_ptr> error(n);
  std::vector<std::thread> threads;
  for (int p = 0; p < n; p++) {
    hosts[p].ranks_.rank = p;
    hosts[p].ranks_.processes = n;
    hosts[p].meeting_ = &meeting;
    threads.emplace_back([&, p] {
      try {
        work(hosts[p]);
      } catch (...) {
        error[p] = std::current_exception();
      }
      const std::lock_guard<std::mutex> lock(meeting.mutex);
      meeting.left = true;
      meeting.changed.notify_all();
    });
  }
  for (std::thread &t : threads) t.join();
  for (const std::exception_ptr &e : error)
    if (e) std::rethrow_exception(e);
}

std::vector<FakeHost::Bytes> FakeHost::meet(const std::string &call, const void *data,
                                            std::size_t bytes)
{
  const char *first = static_cast<const char *>(data);
  if (!meeting_) return {Bytes(first, first + bytes)};    // the only process
  Meeting &m = *meeting_;
  std::unique_lock<std::mutex> lock(m.mutex);
  if (m.here == 0) m.call = call;
  if (m.call != call) throw std::logic_error("one process calls " + call + ", another " + m.call);
  m.now[rank()].assign(first, first + bytes);
  const int mine = m.held;
  if (++m.here == static_cast<int>(m.now.size())) {
    m.last = m.now;
    m.here = 0;
    m.held++;
    m.changed.notify_all();
  }
  m.changed.wait(lock, [&] { return m.held != mine || m.left; });
  if (m.held == mine) throw std::logic_error("a process has ended, another calls " + call);
  return m.last;
}

std::vector<std::vector<Real>> FakeHost::meet(const std::string &call,
                                              const std::vector<Real> &numbers)
{
  std::vector<std::vector<Real>> all;
  for (const Bytes &b : meet(call, numbers.data(), numbers.size() * sizeof(Real))) {
    all.emplace_back(b.size() / sizeof(Real));
    if (!b.empty()) std::memcpy(all.back().data(), b.data(), b.size());
  }
  return all;
}

void FakeHost::sum(Real *numbers, int n)
{
  const std::vector<std::vector<Real>> all =
      meet("sum of " + std::to_string(n), std::vector<Real>(numbers, numbers + n));
  std::fill(numbers, numbers + n, 0);
  for (const std::vector<Real> &of_one : all)
    for (int i = 0; i < n; i++) numbers[i] += of_one[i];
}

void FakeHost::max(Real *numbers, int n)
{
  for (const std::vector<Real> &of_one :
       meet("max of " + std::to_string(n), std::vector<Real>(numbers, numbers + n)))
    for (int i = 0; i < n; i++) numbers[i] = std::max(numbers[i], of_one[i]);
}

void FakeHost::broadcast(void *data, std::size_t bytes, int from, Receivers /*to*/)
{
  const std::vector<Bytes> all =
      meet("broadcast of " + std::to_string(bytes) + " from " + std::to_string(from), data, bytes);
  if (bytes > 0) std::memcpy(data, all[from].data(), bytes);
}

}    // namespace lsdcd
