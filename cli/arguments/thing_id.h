#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/id.h"

namespace swarmsmith::cli {

/// An id as a person types it: d3, c812, r7, e81200007, or e81200007t for a test.
struct ThingId {
  char letter = '\0';   ///< d, c, r or e
  std::string digits;   ///< 1 to 18
  std::string purpose;  ///< letter of the purpose, for an evaluation outside the races
};

/// Empty if the text is not an id.
std::optional<ThingId> parse_thing_id(std::string_view text);

/// The design that the id belongs to; none for a real run.
DesignId design_of_thing(const ThingId& id);

/// SQL condition that selects an evaluation in v_evaluations. It also names the candidate, because
/// that column has an index.
std::string is_evaluation(const ThingId& id);

}  // namespace swarmsmith::cli
