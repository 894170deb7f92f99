#include "coordinator/pool/event_text.h"

#include <utility>
#include <variant>
#include <vector>

namespace swarmsmith {

EventRow pool_event(std::string severity, std::string kind,
                    std::initializer_list<EventField> fields) {
  constexpr unsigned char kLastAscii = 0x7e;
  std::vector<EventField> clean(fields);
  for (EventField& field : clean) {
    auto* text = std::get_if<std::string>(&field.second);
    if (text == nullptr) continue;
    for (char& c : *text) {
      if (static_cast<unsigned char>(c) > kLastAscii) c = '?';
    }
  }
  return event_row(std::move(severity), std::move(kind), std::move(clean));
}

std::string name_of(const EvaluationKey& key) {
  return to_string(key.candidate) + " on pair " + std::to_string(key.pair);
}

}  // namespace swarmsmith
