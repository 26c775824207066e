// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// PROGRAM [FILE...] [--gtest_...]. FILE is a source without its folder and ending, as test_weld: only its tests run.
#include "support/device.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace {

using testing::TestInfo;
using testing::TestSuite;

std::string source_of(const TestInfo &test)
{
  const std::string path = test.file();
  const std::size_t slash = path.find_last_of('/') + 1;    // none: 0
  return path.substr(slash, path.rfind('.') - slash);
}

// Narrows the filter to tests of these sources. Returns false, with a message, where a source has none, and where
// two tests have one name: a filter could not tell them apart.
bool select_sources(const std::set<std::string> &sources)
{
  std::map<std::string, const TestInfo *> named;
  std::set<std::string> found;
  std::string own, others;
  const testing::UnitTest &all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); s++) {
    const TestSuite &suite = *all.GetTestSuite(s);
    std::string chosen, left_out;
    for (int t = 0; t < suite.total_test_count(); t++) {
      const TestInfo &test = *suite.GetTestInfo(t);
      const std::string name = std::string(suite.name()) + "." + test.name(),
                        source = source_of(test);
      const auto [other, is_new] = named.try_emplace(name, &test);
      if (!is_new) {
        std::printf("%s is a test of %s and of %s\n", name.c_str(),
                    source_of(*other->second).c_str(), source.c_str());
        return false;
      }
      const bool is_own = sources.count(source) > 0;
      if (is_own) found.insert(source);
      (is_own ? chosen : left_out) += name + ":";
    }
    const std::string whole = std::string(suite.name()) + ".*:";
    own += left_out.empty() ? whole : chosen;
    others += chosen.empty() ? whole : left_out;
  }
  if (sources.empty()) return true;
  for (const std::string &source : sources)
    if (!found.count(source)) {
      std::printf("no test of this program is in %s.cpp\n", source.c_str());
      return false;
    }

  std::string &filter = testing::GTEST_FLAG(filter);
  const std::size_t minus = filter.find('-');
  const std::string wanted = filter.substr(0, minus);
  const std::string unwanted = minus == std::string::npos ? "" : filter.substr(minus + 1);
  if (wanted == "*" || wanted.empty())
    filter = own + (unwanted.empty() ? "" : "-" + unwanted);
  else
    filter = wanted + "-" + others + unwanted;
  return true;
}

}    // namespace

// Exit code 77 tells CTest that the whole program was skipped; the reason is printed.
int main(int argc, char **argv)
{
  testing::InitGoogleTest(&argc, argv);
  if (!select_sources({argv + 1, argv + argc})) return 1;
  std::string why;
  if (lsdcd::test_on_cuda() && !lsdcd::cuda_available(&why)) {
    std::printf("skipped on CUDA: %s\n", why.c_str());
    return 77;
  }
  return RUN_ALL_TESTS();
}
