// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Every function of lsdcd.h is wrapped by this: no exception leaves it, the text of its error is stored, and numbers
// in texts have a point in every locale.
#pragma once

#include "api/lsdcd.h"
#include "base/input_error.h"
#include "query/radius_error.h"

#include <algorithm>
#include <locale.h>
#include <new>
#include <string>

namespace lsdcd {

// Wrong use, with its code.
struct ApiError : InputError {
  ApiError(int code, const std::string &text) : InputError(text), code(code) {}
  int code;
};

// Stores the text for this thread; returns the code.
int store_error(int code, const char *text) noexcept;

// While it lives, this thread has the locale "C".
class CLocale {
 public:
  CLocale() = default;
  ~CLocale() { uselocale(before_); }
  CLocale(const CLocale &) = delete;
  CLocale &operator=(const CLocale &) = delete;

 private:
  static locale_t c_locale()
  {
    static const locale_t made = newlocale(LC_ALL_MASK, "C", nullptr);
    return made;
  }
  locale_t before_ = uselocale(c_locale());
};

template <class Body>
int guard(const Body &body) noexcept
{
  const CLocale locale;
  try {
    body();
    return LSDCD_OK;
  } catch (const ApiError &e) {
    return store_error(e.code, e.what());
  } catch (const NegativeRadiusError &e) {
    return store_error(LSDCD_ERROR_ARGUMENT, e.what());
  } catch (const RadiusError &e) {
    return store_error(LSDCD_ERROR_CUTOFF, e.what());
  } catch (const InputError &e) {
    return store_error(LSDCD_ERROR_INPUT, e.what());
  } catch (const std::bad_alloc &) {
    return store_error(LSDCD_ERROR_MEMORY,
                       "no memory left: free some; a grid takes less with a larger `cell`");
  } catch (const std::exception &e) {
    return store_error(LSDCD_ERROR_INTERNAL, e.what());
  } catch (...) {
    return store_error(LSDCD_ERROR_INTERNAL, "an unknown error");
  }
}

// Throws where a pointer is null that a call needs. `why`: the reason, where it is not needed always.
inline void need(const void *pointer, const char *name, const char *why = nullptr)
{
  if (!pointer)
    throw ApiError(LSDCD_ERROR_ARGUMENT, std::string("`") + name + "` is null" +
                                             (why ? std::string(", and ") + why : ""));
}

inline void check_type(int type)
{
  if (type != LSDCD_DOUBLE && type != LSDCD_FLOAT)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "`type` is neither LSDCD_DOUBLE nor LSDCD_FLOAT");
}

// Throws that a value in a struct of options makes no sense.
[[noreturn]] inline void refuse_option(const std::string &options, const std::string &text)
{
  throw ApiError(LSDCD_ERROR_ARGUMENT, "`" + options + "`: " + text);
}

// Threads of a call; 0: the default. With more, a process may end; the tool has the same limit.
constexpr int kMostThreads = 4096;

inline void check_threads(int n)
{
  if (n < 0 || n > kMostThreads)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "`threads` is " + std::to_string(n) + "; it is 0 to " +
                                             std::to_string(kMostThreads));
}

// Returns a copy of a caller's struct, which has the size that it has here. `field`: where it is, for errors; empty: it is an
// argument.
template <class T>
T checked(const T *given, const char *name, const std::string &field = "")
{
  const std::string where = field.empty() ? name : field;
  need(given, where.c_str());
  if (given->size != sizeof(T))
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   "`" + where + "`: size is " + std::to_string(given->size) +
                       ", and should be sizeof(" + name + "), " + std::to_string(sizeof(T)) +
                       ": set it, and compile with the header of this library");
  return *given;
}

// Copies a struct of the library to the caller's.
template <class T>
void copy_out(const T &made, T *to)
{
  *to = made;
  to->size = sizeof(T);
}

}    // namespace lsdcd
