#include "sim/messages/scenario_messages.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {

/// A scenario as a coordinator sends it: refused with a sentence, or read to one whose bytes read
/// back to the same bytes. The bytes are compared, since a NaN differs from itself.
void run(std::string_view input) {
  const auto scenario = scenario_from_bytes(input);
  if (!scenario) return require(!scenario.error().message.empty(), "a refusal has a sentence");
  const std::string bytes = to_bytes(*scenario);
  const auto again = scenario_from_bytes(bytes);
  require(again.has_value(), "what is written can be read");
  require(to_bytes(*again) == bytes, "a scenario keeps its bytes");
}

}  // namespace swarmsmith::fuzz
