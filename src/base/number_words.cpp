// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/number_words.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace lsdcd {

namespace {

// Without a plus sign, which from_chars() does not take.
std::string_view without_plus(std::string_view word)
{
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

// from_chars reports 1e-400 and 1e400 alike. The first is zero, the second is infinite: the power of
// ten of the first digit that is not 0 tells.
bool is_underflow(std::string_view number)
{
  const auto e = std::min(number.find_first_of("eE"), number.size());
  const auto digits = number.substr(0, e), exponent = number.substr(std::min(e + 1, number.size()));
  const auto first = digits.find_first_of("123456789"), point = std::min(digits.find('.'), e);
  if (first == digits.npos) return true;
  long long power = 0;
  const char *sign = exponent.data();
  const auto *begin = sign + (!exponent.empty() && *sign == '+');
  const auto read = std::from_chars(begin, exponent.data() + exponent.size(), power);
  if (read.ec == std::errc::result_out_of_range) return *begin == '-';
  power = std::clamp<long long>(power, -1000000000000, 1000000000000);    // as far as files go
  return power + static_cast<long long>(point) < static_cast<long long>(first);
}

}    // namespace

bool read_real(std::string_view word, Real &value)
{
  const auto digits = without_plus(word);
  const auto end = digits.data() + digits.size();
  const auto parsed = std::from_chars(digits.data(), end, value);
  if (parsed.ec == std::errc::invalid_argument || parsed.ptr != end) return false;
  if (parsed.ec == std::errc::result_out_of_range) value = is_underflow(digits) ? 0 : HUGE_VAL;
  return true;
}

bool is_number(std::string_view word, Real *value)
{
  return read_real(word, *value) && std::isfinite(*value);
}

bool read_integer(std::string_view word, std::int64_t &value)
{
  const auto digits = without_plus(word);
  const auto end = digits.data() + digits.size();
  const auto parsed = std::from_chars(digits.data(), end, value);
  return parsed.ec == std::errc() && parsed.ptr == end;
}

std::string number_text(Real value)
{
  char buffer[32];
  return {buffer,
          std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 6).ptr};
}

std::string exact_text(Real value)
{
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string counted(std::int64_t n, std::string_view one, std::string_view many)
{
  std::string text = std::to_string(n) + " ";
  text += n == 1 || many.empty() ? one : many;
  return n == 1 || !many.empty() ? text : text + "s";
}

}    // namespace lsdcd
