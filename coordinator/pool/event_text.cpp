#include "coordinator/pool/event_text.h"

#include "base/overloaded.h"

namespace swarmsmith {
namespace {

void append_string(std::string& out, std::string_view text) {
  static constexpr char kDigits[] = "0123456789abcdef";
  out += '"';
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20) {
      out += "\\u00";
      out += kDigits[byte >> 4U];
      out += kDigits[byte & 15U];
    } else {
      // Texts of other processes need not be UTF-8; JSON must be.
      out += byte < 0x7f ? c : '?';
    }
  }
  out += '"';
}

}  // namespace

std::string event_text(std::initializer_list<EventField> fields) {
  std::string out = "{";
  for (const auto& [key, value] : fields) {
    if (out.size() > 1) out += ',';
    append_string(out, key);
    out += ':';
    std::visit(Overloaded{[&](std::int64_t number) { out += std::to_string(number); },
                          [&](const std::string& text) { append_string(out, text); }},
               value);
  }
  return out + "}";
}

std::string name_of(const EvaluationKey& key) {
  return to_string(key.candidate) + " on pair " + std::to_string(key.pair);
}

}  // namespace swarmsmith
