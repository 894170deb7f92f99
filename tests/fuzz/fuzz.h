#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith::fuzz {

/// What a fuzz target does with one input; each target's file defines it. It must come back soon
/// for every input, and may call `require`.
void run(std::string_view input);

/// Stops the process where a property does not hold, which is a finding.
inline void require(bool holds, std::string_view what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %.*s\n", static_cast<int>(what.size()), what.data());
  std::abort();
}

/// What is refused is refused with reasons, and with the place of each. Codes of tracking: E_.
inline void require_reasons(const std::vector<Error>& errors, std::string_view code = {}) {
  require(!errors.empty(), "a refusal has a reason");
  for (const Error& error : errors) {
    require(!error.where.empty() && !error.message.empty(), "an error has a place and a message");
    require(error.message.starts_with(code), "an error has a code");
  }
}

}  // namespace swarmsmith::fuzz
