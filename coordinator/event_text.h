#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace swarmsmith {

using EventField = std::pair<std::string_view, std::variant<std::int64_t, std::string>>;

/// The fields as a JSON object, for EventRow::text.
std::string event_text(std::initializer_list<EventField> fields);

}  // namespace swarmsmith
