#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

// The matchers that most tests use, by their short names.
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

/// A line each: "file:line:column: sentence".
inline std::vector<std::string> lines_of(const std::vector<Error>& errors) {
  std::vector<std::string> lines;
  for (const Error& error : errors)
    lines.push_back(to_string(error));
  return lines;
}

/// What is wrong with a file, a line each. Nothing where it was read.
template <class ValueOrErrors>
std::vector<std::string> complaints_of(const ValueOrErrors& read) {
  return read ? std::vector<std::string>{} : lines_of(read.error());
}

/// The error itself, the first of several. Where there is a value instead the test fails.
template <class ValueOrError>
auto why_not(const ValueOrError& result, const char* file = __builtin_FILE(),
             int line = __builtin_LINE()) {
  const auto first = [&] {
    if constexpr (requires { result.error().front(); }) {
      return result.error().front();
    } else {
      return result.error();
    }
  };
  if (!result) return first();
  ADD_FAILURE_AT(file, line) << "this should have been an error";
  return decltype(first()){};
}

/// Why there is no value, the first reason of several. Empty where there is one.
template <class ValueOrError>
std::string complaint_of(const ValueOrError& result) {
  return result ? "" : to_string(why_not(result));
}

/// The value of an optional, or of what may be an error instead. Without it the test ends here, and
/// says why there is none.
template <class Maybe>
typename Maybe::value_type value_of(Maybe maybe, const char* file = __builtin_FILE(),
                                    int line = __builtin_LINE()) {
  if (maybe) return std::move(*maybe);
  std::string why = "there is none";
  if constexpr (requires { maybe.error(); }) why = complaint_of(maybe);
  throw std::runtime_error(std::string(file) + ":" + std::to_string(line) + ": " + why);
}

}  // namespace swarmsmith
