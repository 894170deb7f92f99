#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/id.h"

namespace swarmsmith::cli {

/// What a person calls by an id: d3, c812, r7, e81200007, or e81200007t of a test.
struct ThingId {
  char letter = '\0';   ///< d, c, r or e
  std::string digits;   ///< 1 to 18
  std::string purpose;  ///< letter of an evaluation that was made for no race
};

/// Nothing when the text is not an id.
std::optional<ThingId> parse_thing_id(std::string_view text);

/// The design that the thing is of; none of a real run.
DesignId design_of_thing(const ThingId& id);

/// SQL that picks an evaluation out of v_evaluations: by its candidate as well, which has an index.
std::string is_evaluation(const ThingId& id);

}  // namespace swarmsmith::cli
