#include "programs/internal/aclib.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "programs/number.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kIntroduction = "Result of this algorithm run:";

/// The rest of the line after the last introduction.
std::string_view result_line(std::string_view output) {
  const std::size_t at = output.rfind(kIntroduction);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = output.substr(at + kIntroduction.size());
  return rest.substr(0, rest.find('\n'));
}

/// A number, or a text that contains one: wrappers print both.
std::optional<double> number_in(const nlohmann::json& result, const char* key) {
  const auto at = result.find(key);
  if (at == result.end()) return std::nullopt;
  if (at->is_number()) return at->get<double>();
  if (at->is_string()) return parse_number(at->get_ref<const std::string&>());
  return std::nullopt;
}

}  // namespace

Expected<Reading> parse_aclib(std::string_view output, const Target& target) {
  const std::string_view line = result_line(output);
  if (line.empty()) {
    return bad_input("the targetRunner printed no line `" + std::string(kIntroduction) +
                     " {...}`, which aclib requires");
  }
  const nlohmann::json result = nlohmann::json::parse(line, nullptr, false);
  if (!result.is_object()) {
    return bad_input("the result of the targetRunner is not a JSON object: `" +
                     printable(line.substr(0, 80), 320) + "`");
  }
  const auto found = result.find("status");
  const std::string status =
      found != result.end() && found->is_string() ? found->get<std::string>() : "missing";
  if (status != "SUCCESS" && status != "TIMEOUT") {
    return bad_input("the targetRunner's status is " + printable(status, 80) +
                     "; wanted SUCCESS or TIMEOUT");
  }
  Reading reading;
  const std::optional<double> time = number_in(result, "runtime");
  if (time) {
    const Expected<double> checked = checked_time(*time, "targetRunner", target);
    if (!checked) return Unexpected(checked.error());
    reading.time = *checked;
  } else if (target.prints_time) {
    return bad_input("the result of the targetRunner has no number `runtime`");
  }
  if (!target.evaluator.empty()) return reading;
  const std::optional<double> cost = number_in(result, "cost");
  if (!cost || std::isnan(*cost)) {
    return bad_input("the result of the targetRunner has no number `cost`");
  }
  reading.cost = *cost;
  return reading;
}

}  // namespace swarmsmith
