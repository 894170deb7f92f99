#include "cli/arguments/thing_id.h"

#include <charconv>
#include <cstdint>

#include "storage/stored_enums.h"

namespace swarmsmith::cli {

std::optional<ThingId> parse_thing_id(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789";
  if (text.empty()) return std::nullopt;
  ThingId id{.letter = text.front(), .digits = {}, .purpose = {}};
  if (std::string_view("dcer").find(id.letter) == std::string_view::npos) return std::nullopt;
  text.remove_prefix(1);
  if (id.letter == 'e' && !text.empty() && purpose_of_letter(text.substr(text.size() - 1))) {
    id.purpose = text.back();
    text.remove_suffix(1);
  }
  if (text.empty() || text.size() > 18) return std::nullopt;
  if (text.find_first_not_of(kDigits) != std::string_view::npos) return std::nullopt;
  id.digits = text;
  return id;
}

std::string is_evaluation(const ThingId& id) {
  // The id is e<candidate * 100,000 + pair>, followed by the letter of the purpose.
  return "candidate = " + id.digits + " / 100000 AND id = 'e" + id.digits + id.purpose + "'";
}

DesignId design_of_thing(const ThingId& id) {
  std::int64_t number = 0;
  std::from_chars(id.digits.data(), id.digits.data() + id.digits.size(), number);
  if (id.letter == 'd') return {number};
  if (id.letter == 'c') return design_of(CandidateId{number});
  if (id.letter == 'e') return design_of(CandidateId{number / kPairsPerCandidate});
  return {};
}

}  // namespace swarmsmith::cli
