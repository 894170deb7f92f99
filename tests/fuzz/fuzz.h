#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

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

}  // namespace swarmsmith::fuzz
