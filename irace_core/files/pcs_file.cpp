#include <algorithm>
#include <array>
#include <utility>

#include "irace_core/files/foreign_space.h"
#include "irace_core/files/internal/foreign_builder.h"
#include "irace_core/files/internal/line_reader.h"
#include "irace_core/files/number_text.h"

namespace swarmsmith {
namespace {

using irace::ForeignBuilder;
using irace::ForeignParameter;
using irace::LineReader;
using irace::trimmed;

/// Takes the text up to a blank or one of these letters.
std::string take_until(LineReader& line, std::string_view letters) {
  const std::string_view rest = line.rest();
  std::size_t end = 0;
  while (end < rest.size() && !irace::is_blank(rest[end]) &&
         letters.find(rest[end]) == std::string_view::npos)
    ++end;
  line.advance(end);
  return std::string(rest.substr(0, end));
}

/// The trimmed texts between commas.
std::vector<std::string> split_list(std::string_view text) {
  std::vector<std::string> items;
  while (true) {
    const std::size_t end = text.find(',');
    items.emplace_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return items;
    text.remove_prefix(end + 1);
  }
}

/// Takes the text between two brackets; the opening one must come next.
Expected<std::string> take_bracketed(LineReader& line, char open, char close) {
  line.skip_blanks();
  const std::string wanted = {open, '.', '.', '.', close};
  if (line.at_end() || line.rest().front() != open) return line.expected(wanted);
  const std::size_t end = line.rest().find(close);
  if (end == std::string_view::npos) return line.expected(wanted);
  std::string inside(trimmed(line.rest().substr(1, end - 1)));
  line.advance(end + 1);
  return inside;
}

/// A comparison `name <operator> value` or `name in {a, b}`.
struct Comparison {
  std::string name;
  Operation operation = Operation::Equal;
  std::vector<std::string> values;
};

constexpr std::array<std::pair<std::string_view, Operation>, 7> kPcsOperators = {{
    {"==", Operation::Equal},
    {"!=", Operation::NotEqual},
    {"<=", Operation::LessEqual},
    {">=", Operation::GreaterEqual},
    {"<", Operation::Less},
    {">", Operation::Greater},
    {"=", Operation::Equal},
}};

Expected<Comparison> read_comparison(LineReader line) {
  const std::string wanted = "`name in {a, b}`, or `name == value` with == != < > <= or >=";
  const LineReader begin = line;
  line.skip_blanks();
  Comparison found;
  found.name = take_until(line, "=!<>{");
  line.skip_blanks();
  if (line.rest().starts_with("in") && line.rest().find('{') != std::string_view::npos) {
    line.advance(2);
    auto list = take_bracketed(line, '{', '}');
    if (!list) return Unexpected(list.error());
    found.operation = Operation::In;
    found.values = split_list(*list);
    return line.at_comment_or_end() ? Expected<Comparison>(found) : begin.expected(wanted);
  }
  for (const auto& [text, operation] : kPcsOperators) {
    if (!line.rest().starts_with(text)) continue;
    line.advance(text.size());
    found.operation = operation;
    found.values = {std::string(trimmed(line.rest()))};
    if (found.name.empty() || found.values.front().empty()) return begin.expected(wanted);
    return found;
  }
  return begin.expected(wanted);
}

/// The position of the next separator outside inner brackets.
std::size_t find_outside(std::string_view text, std::string_view separator) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    depth += text[i] == '{' ? 1 : text[i] == '}' ? -1 : 0;
    if (depth == 0 && text.substr(i).starts_with(separator)) return i;
  }
  return std::string_view::npos;
}

Expected<Domain> pcs_domain(const std::string& bounds, bool whole, bool log,
                            const std::string& where) {
  const std::vector<std::string> items = split_list(bounds);
  const auto lower = number_of(items.front());
  const auto upper = number_of(items.back());
  if (items.size() != 2 || !lower || !upper) {
    return bad_input("expected two numbers with a comma between them, found [" + bounds + "]",
                     where);
  }
  if (whole) return Integer{*lower, *upper, log};
  return Real{*lower, *upper, log};
}

class PcsReader {
 public:
  PcsReader(const IraceText& source, const ForeignSpaceOptions& options)
      : source_(source), options_(options), builder_(source.file) {}

  Expected<ForeignSpace> read();

 private:
  /// The rest of a line without its comment, to be read later.
  struct Later {
    std::string name;  ///< of the conditional parameter
    std::string text;
    std::size_t line;
    std::size_t at;  ///< bytes of the line before the text
  };

  Expected<void> read_line(std::string_view text, std::size_t number);
  Expected<void> read_parameter(const std::string& name, LineReader line, std::string where);
  /// Reads comparisons joined by one operator.
  Expected<Expression> read_joined(const Later& from, const std::string& separator,
                                   Operation operation) const;
  Expected<void> read_condition(const Later& from);
  Expected<void> read_forbidden(const Later& from);

  const IraceText& source_;
  const ForeignSpaceOptions& options_;
  ForeignBuilder builder_;
  std::vector<Later> conditions_;
  std::vector<Later> forbidden_;
};

/// The older format has `{a, b}[a]` and `[1, 10][5]il`; the newer one has a word for the type.
Expected<void> PcsReader::read_parameter(const std::string& name, LineReader line,
                                         std::string where) {
  constexpr std::array<std::string_view, 4> kTypes = {"categorical", "ordinal", "integer", "real"};
  line.skip_blanks();
  const LineReader before_type = line;
  const std::string type = take_until(line, "{[");
  if (!type.empty() && std::ranges::find(kTypes, type) == kTypes.end()) {
    return before_type.expected(
        "{values}, [bounds], or one of categorical, ordinal, integer and "
        "real, after the name '" +
        name + "'");
  }
  line.skip_blanks();
  const bool is_choice =
      type == "categorical" || type == "ordinal" || (type.empty() && line.rest().starts_with('{'));
  const std::string place = line.where();
  const auto domain = is_choice ? take_bracketed(line, '{', '}') : take_bracketed(line, '[', ']');
  if (!domain) return Unexpected(domain.error());
  const auto initial = take_bracketed(line, '[', ']');
  if (!initial) return Unexpected(initial.error());
  const std::string start = options_.aclib ? name : "-" + name + " ";
  ForeignParameter parameter{name, start, Categorical{}, *initial, std::move(where)};
  line.skip_blanks();
  const LineReader before_flags = line;
  const std::string flags = is_choice ? "" : take_until(line, "#");
  const bool is_log = flags == "log" || flags == "l" || flags == "il" || flags == "li";
  const bool is_whole = type == "integer" || flags.find('i') != std::string::npos;
  if (!line.at_comment_or_end() || !(is_log || flags.empty() || flags == "i")) {
    return before_flags.expected(is_choice ? "the end of the line" : "i, l, il, log or the end");
  }
  if (!is_choice) {
    auto numeric = pcs_domain(*domain, is_whole, is_log, place);
    if (!numeric) return Unexpected(numeric.error());
    parameter.domain = std::move(*numeric);
  } else if (type == "ordinal") {
    parameter.domain = Ordinal{split_list(*domain)};
  } else {
    parameter.domain = Categorical{split_list(*domain)};
  }
  return builder_.add(std::move(parameter));
}

Expected<void> PcsReader::read_line(std::string_view text, std::size_t number) {
  LineReader line(source_.file, text, number);
  if (line.at_comment_or_end()) return {};
  const auto later = [&](const std::string& name) {
    const std::string_view rest = line.rest();
    const std::string_view said = trimmed(rest.substr(0, rest.find('#')));
    return Later{name, std::string(said), number, text.size() - rest.size()};
  };
  for (const std::string_view title : {"Conditionals:", "Conditions:", "Forbidden:"}) {
    if (line.rest().starts_with(title)) return {};
  }
  if (line.rest().starts_with('{')) {
    forbidden_.push_back(later(""));
    return {};
  }
  const std::string where = line.where();
  const std::string name = take_until(line, "{[|");
  line.skip_blanks();
  if (!line.rest().starts_with('|')) return read_parameter(name, line, where);
  line.advance(1);
  line.skip_blanks();
  conditions_.push_back(later(name));
  return {};
}

Expected<Expression> PcsReader::read_joined(const Later& from, const std::string& separator,
                                            Operation operation) const {
  std::optional<Expression> all;
  std::string_view rest = from.text;
  while (true) {
    const std::size_t end = find_outside(rest, separator);
    const std::size_t before = from.at + (from.text.size() - rest.size());
    // Blanks replace the text before the piece, so that places are right for the file.
    const std::string piece = std::string(before, ' ') + std::string(rest.substr(0, end));
    LineReader line(source_.file, piece, from.line);
    line.skip_blanks();
    const auto found = read_comparison(line);
    if (!found) return Unexpected(found.error());
    auto one = builder_.compare(found->name, found->operation, found->values, line.where());
    if (!one) return one;
    all = all ? Expression::call(operation, {std::move(*all), std::move(*one)}) : std::move(*one);
    if (end == std::string_view::npos) return *std::move(all);
    rest.remove_prefix(end + separator.size());
  }
}

Expected<void> PcsReader::read_condition(const Later& from) {
  const bool has_or = from.text.find("||") != std::string::npos;
  const std::string where = source_.file + ":" + std::to_string(from.line);
  if (has_or && from.text.find("&&") != std::string::npos) {
    return bad_input(
        "a condition with both && and || is not read, since tools differ in their order: write the "
        "parts with && as lines of their own, or write the "
        "parameters in irace's format (`swarmsmith irace --check` prints it)",
        where);
  }
  auto condition =
      has_or ? read_joined(from, "||", Operation::Or) : read_joined(from, "&&", Operation::And);
  if (!condition) return Unexpected(condition.error());
  return builder_.restrict(from.name, std::move(*condition), where);
}

Expected<void> PcsReader::read_forbidden(const Later& from) {
  const std::string where = source_.file + ":" + std::to_string(from.line);
  if (from.text.size() < 2 || from.text.back() != '}') {
    return bad_input("expected {name=value, name=value}, found \"" + from.text + "\"", where);
  }
  Later inside = from;
  inside.text = from.text.substr(1, from.text.size() - 2);
  ++inside.at;
  if (inside.text.find("||") != std::string::npos ||
      inside.text.find_first_of("+*/()^%") != std::string::npos) {
    return bad_input(
        "formulas in forbidden lines are not read: only {name=value, name=value}. "
        "Write it in R under [forbidden] of a parameter file of irace "
        "(`swarmsmith irace --check` prints one when this line is left out)",
        where);
  }
  const bool doubled = inside.text.find("&&") != std::string::npos;
  auto clause = read_joined(inside, doubled ? "&&" : ",", Operation::And);
  if (!clause) return Unexpected(clause.error());
  builder_.forbid(std::move(*clause));
  return {};
}

Expected<ForeignSpace> PcsReader::read() {
  std::size_t number = 0;
  for (const std::string_view text : irace::split_lines(source_.text)) {
    if (auto read = read_line(text, ++number); !read) return Unexpected(read.error());
  }
  for (const Later& condition : conditions_) {
    if (auto read = read_condition(condition); !read) return Unexpected(read.error());
  }
  for (const Later& clause : forbidden_) {
    if (auto read = read_forbidden(clause); !read) return Unexpected(read.error());
  }
  return std::move(builder_).build(options_);
}

/// Whether the line begins with `name {`, `name [` or `name real [`: no line of irace begins so.
bool is_pcs_line(LineReader line) {
  take_until(line, "{[\"");
  line.skip_blanks();
  const std::string type = take_until(line, "{[\"");
  line.skip_blanks();
  const bool is_type = type.empty() || type == "categorical" || type == "ordinal" ||
                       type == "integer" || type == "real";
  return is_type && (line.rest().starts_with('{') || line.rest().starts_with('['));
}

}  // namespace

SpaceFormat space_format_of(const IraceText& source) {
  if (source.file.ends_with(".json")) return SpaceFormat::ConfigSpace;
  if (source.file.ends_with(".pcs")) return SpaceFormat::Pcs;
  for (const std::string_view text : irace::split_lines(source.text)) {
    LineReader line(source.file, text, 1);
    if (line.at_comment_or_end()) continue;
    if (trimmed(line.rest()) == "{" || line.rest().starts_with("{\"")) {
      return SpaceFormat::ConfigSpace;
    }
    // These are irace's own sections.
    if (line.rest().starts_with('[')) return SpaceFormat::Irace;
    return is_pcs_line(line) ? SpaceFormat::Pcs : SpaceFormat::Irace;
  }
  return SpaceFormat::Irace;
}

Expected<ForeignSpace> parse_pcs_file(const IraceText& source, const ForeignSpaceOptions& options) {
  return PcsReader(source, options).read();
}

}  // namespace swarmsmith
