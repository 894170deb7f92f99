#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "storage/rows.h"

namespace swarmsmith {

using EventField = std::pair<std::string_view, std::variant<std::int64_t, std::string>>;

/// The fields as a JSON object, for EventRow::text.
std::string event_text(std::initializer_list<EventField> fields);

/// An evaluation in sentences: "c812 on pair 7".
std::string name_of(const EvaluationKey& key);

}  // namespace swarmsmith
