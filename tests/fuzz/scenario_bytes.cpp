#include "proto/scenario/scenario.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {

/// Scenarios as a coordinator sends them: refused with a sentence, or read to some whose bytes read
/// back to the same bytes. The bytes are compared, since a NaN differs from itself.
void run(std::string_view input) {
  const auto scenarios = scenarios_from_bytes(input);
  if (!scenarios) return require(!scenarios.error().message.empty(), "a refusal has a sentence");
  const std::string bytes = to_bytes(*scenarios);
  const auto again = scenarios_from_bytes(bytes);
  require(again.has_value(), "what is written can be read");
  require(to_bytes(*again) == bytes, "scenarios keep their bytes");
}

}  // namespace swarmsmith::fuzz
