#include "base/csv.h"

#include <algorithm>
#include <charconv>

namespace swarmsmith {
namespace {

bool is_number(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return stop == end && (error == std::errc() || error == std::errc::result_out_of_range);
}

bool is_letter(char byte) {
  return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z');
}

bool is_switches(std::string_view text) {
  const std::size_t name = text.find_first_not_of('-');
  if (name == 0 || name > 2 || name >= text.size() || !is_letter(text[name])) return false;
  constexpr std::string_view kOthers = "0123456789 ._-/:,";
  return std::ranges::all_of(text, [&](char byte) {
    return is_letter(byte) || kOthers.find(byte) != std::string_view::npos;
  });
}

/// What a spreadsheet would calculate, were it not for the apostrophes before it.
std::string_view behind_apostrophes(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of('\''), text.size()));
}

bool begins_as_formula(std::string_view text) {
  constexpr std::string_view kBegins = "=+-@\t\r\n";
  return !text.empty() && kBegins.find(text.front()) != std::string_view::npos;
}

}  // namespace

std::string csv_field(std::string_view text) {
  // A text that begins with apostrophes of its own gets one more, so that it comes back.
  const bool guarded = begins_as_formula(behind_apostrophes(text)) &&
                       (text.front() == '\'' || (!is_number(text) && !is_switches(text)));
  std::string field = guarded ? "'" : "";
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return field += text;
  field.insert(0, 1, '"');
  for (const char letter : text) {
    field += letter;
    if (letter == '"') field += '"';
  }
  return field + "\"";
}

std::string csv_line(const std::vector<std::string>& texts) {
  std::string line;
  for (std::size_t i = 0; i < texts.size(); ++i)
    line += (i == 0 ? "" : ",") + csv_field(texts[i]);
  return line + "\n";
}

std::string_view csv_text(std::string_view field) {
  const bool guarded = field.starts_with('\'') && begins_as_formula(behind_apostrophes(field));
  return field.substr(guarded ? 1 : 0);
}

}  // namespace swarmsmith
