#include "irace_core/files/internal/parameter_line.h"

#include <algorithm>
#include <array>

namespace swarmsmith::irace {
namespace {

Expected<std::string> read_switch(LineReader& line) {
  const std::string_view rest = line.rest();
  const std::size_t end = rest.empty() || rest[0] != '"' ? 0 : rest.find('"', 1);
  const bool closed = end != 0 && end != std::string_view::npos;
  if (!closed || (end + 1 < rest.size() && !is_blank(rest[end + 1]))) {
    return line.expected("the switch in double quotes and a blank after it");
  }
  line.advance(end + 1);
  return std::string(rest.substr(1, end - 1));
}

Expected<void> read_type(LineReader& line, ParameterLine& parameter) {
  constexpr std::array<std::string_view, 6> kTypes = {"c", "o", "i", "r", "i,log", "r,log"};
  LineReader word_reader = line;
  const std::string_view word = word_reader.take_word();
  if (std::find(kTypes.begin(), kTypes.end(), word) == kTypes.end()) {
    return line.expected(
        "the type and a blank after it: c (categorical), o (ordinal), i (integer), r (real), "
        "i,log or r,log (without a blank)");
  }
  parameter.type = word.front();
  parameter.log = word.size() > 1;
  line = word_reader;
  return {};
}

/// The domain extends to the last ')' before the first '|' or comment; quoted values are skipped.
/// Returns nothing if there is no such ')'.
struct DomainEnd {
  std::size_t close = 0;  ///< of the ')'
  std::size_t stop = 0;   ///< of the '|' or '#', or the end
};
std::optional<DomainEnd> find_domain_end(std::string_view text) {
  DomainEnd end;
  bool at_value = true;
  std::size_t i = 1;
  while (i < text.size() && text[i] != '|' && text[i] != '#') {
    const std::size_t quoted = at_value ? quoted_length(text.substr(i)) : 0;
    if (quoted > 0) {
      at_value = false;
      i += quoted;
      continue;
    }
    if (text[i] == ')') end.close = i;
    if (!is_blank(text[i])) at_value = text[i] == ',';
    ++i;
  }
  end.stop = i;
  if (end.close == 0) return std::nullopt;
  return end;
}

}  // namespace

std::size_t quoted_length(std::string_view text) {
  if (text.empty() || text[0] != '"') return 0;
  const std::size_t close = text.find('"', 1);
  if (close == std::string_view::npos) return 0;
  std::size_t next = close + 1;
  while (next < text.size() && is_blank(text[next]))
    ++next;
  const bool ends = next == text.size() || text[next] == ',' || text[next] == ')';
  return ends ? close + 1 : 0;
}

Expected<ParameterLine> read_parameter_line(LineReader& line) {
  ParameterLine parameter;
  parameter.name.place = line.place();
  LineReader name_reader = line;
  parameter.name.text = std::string(name_reader.take_name());
  const bool ends = name_reader.at_end() || is_blank(name_reader.rest().front());
  if (parameter.name.text.empty() || !ends) {
    return line.expected("a parameter's name (letters, digits, '_' and '.') and a blank after it");
  }
  line = name_reader;
  line.skip_blanks();
  auto switch_text = read_switch(line);
  if (!switch_text) return Unexpected(switch_text.error());
  parameter.switch_text = std::move(*switch_text);
  line.skip_blanks();
  if (auto type = read_type(line, parameter); !type) return Unexpected(type.error());
  line.skip_blanks();

  const std::string_view rest = line.rest();
  const std::string wanted = "the domain in parentheses";
  if (rest.empty() || rest[0] != '(') return line.expected(wanted);
  const auto end = find_domain_end(rest);
  if (!end) return line.expected(wanted + ", closed before any '|' and '#'");
  line.advance(1);
  parameter.domain = {std::string(rest.substr(1, end->close - 1)), line.place()};
  line.advance(end->close);
  if (line.at_comment_or_end()) return parameter;
  if (line.rest().front() != '|') return line.expected("'|' before the condition");
  line.advance(1);
  line.skip_blanks();
  parameter.condition = {std::string(line.rest()), line.place()};
  if (line.at_comment_or_end()) return line.expected("a condition after '|'");
  return parameter;
}

Expected<std::vector<std::string>> read_choices(const Piece& domain, const std::string& file,
                                                std::vector<Error>& warnings) {
  std::vector<std::string> values;
  const std::string where = file + ":" + r::to_string(domain.place);
  const auto warn = [&](std::string message) {
    warnings.push_back({ErrorKind::BadInput, std::move(message), where});
  };
  std::string_view rest = domain.text;
  for (bool more = true; more;) {
    while (!rest.empty() && is_blank(rest.front()))
      rest.remove_prefix(1);
    const std::size_t quoted = quoted_length(rest);
    const bool opens =
        !rest.empty() && rest[0] == '"' && rest.find('"', 1) != std::string_view::npos;
    const std::size_t behind = opens ? rest.find('"', 1) + 1 : 0;
    const std::size_t comma = std::min(rest.find(',', behind), rest.size());
    if (opens && (quoted == 0 || !trimmed(rest.substr(behind, comma - behind)).empty())) {
      return bad_input("expected ',' or ')' after the closing quote of a value, found \"" +
                           std::string(trimmed(rest.substr(behind))) + "\"",
                       where);
    }
    more = comma < rest.size();
    if (quoted > 0) {
      values.emplace_back(rest.substr(1, quoted - 2));
    } else {
      const std::string_view value = trimmed(rest.substr(0, comma));
      if (value.empty()) {
        warn("an empty value is left out; for an empty text write \"\"");
      } else {
        values.emplace_back(value);
      }
      if (more && value.size() < comma && !value.empty()) {
        warn("the blanks after the value '" + std::string(value) +
             "' are left out; R would keep them");
      }
    }
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return values;
}

}  // namespace swarmsmith::irace
