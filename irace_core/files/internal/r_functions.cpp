#include "irace_core/files/internal/r_functions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <regex>
#include <utility>

#include "irace_core/files/settings.h"

namespace swarmsmith::r {
namespace {

/// A pattern could exhaust the stack on longer text.
constexpr std::size_t kLongestSearched = 2'000;

/// The arguments of a call, by name.
class Arguments {
 public:
  /// `names` are in R's order: an argument without a name gets the first free one.
  static Expected<Arguments> match(const Node& node, const std::string& function,
                                   std::vector<Part> parts,
                                   const std::vector<std::string_view>& names) {
    Arguments arguments;
    for (Part& part : parts) {
      if (part.name.empty()) continue;
      if (std::ranges::find(names, part.name) == names.end())
        return wrong(node, "`" + function + "` has no argument `" + part.name + "` here");
      arguments.values_[part.name] = std::move(part.value);
    }
    for (Part& part : parts) {
      if (!part.name.empty()) continue;
      const auto free = std::ranges::find_if(names, [&](std::string_view name) {
        return !arguments.values_.contains(std::string(name));
      });
      if (free == names.end()) return wrong(node, "`" + function + "` has too many values");
      arguments.values_[std::string(*free)] = std::move(part.value);
    }
    return arguments;
  }

  bool has(const std::string& name) const { return values_.contains(name); }
  /// All elements as texts; none if the argument is missing.
  std::vector<std::string> texts(const std::string& name) const {
    const auto found = values_.find(name);
    return found == values_.end() ? std::vector<std::string>{} : to_texts(found->second);
  }
  std::optional<std::string> text(const std::string& name) const {
    const auto all = texts(name);
    return all.size() == 1 ? std::optional(all.front()) : std::nullopt;
  }
  std::optional<double> number(const std::string& name) const {
    const auto found = values_.find(name);
    if (found == values_.end() || found->second.size() != 1) return std::nullopt;
    const Scalar& one = found->second.front();
    if (one.missing || one.type == Scalar::Type::Text) return std::nullopt;
    return one.number;
  }
  bool is_true(const std::string& name) const { return number(name).value_or(0) != 0; }

 private:
  std::map<std::string, Vector> values_;
};

Vector vector_of(std::vector<std::string> texts) {
  Vector vector;
  for (std::string& text : texts)
    vector.push_back(Scalar::of_text(std::move(text)));
  return vector;
}

/// The folder of a path, as in R: without slashes at the end; "." if there is no folder.
std::string folder_of(std::string path) {
  while (path.size() > 1 && path.back() == '/')
    path.pop_back();
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

std::string name_of(std::string path) {
  while (!path.empty() && path.back() == '/')
    path.pop_back();
  return path.substr(path.rfind('/') + 1);
}

Expected<Vector> read_lines(const Node& node, const Arguments& given,
                            const Environment& environment) {
  const auto name = given.text("con");
  if (!name || !environment.read) return wrong(node, "readLines needs the name of one file");
  const auto text = environment.read(absolute_path(*name, environment.folder));
  if (!text) return wrong(node, "readLines: " + text.error().message);
  std::vector<std::string> lines;
  std::string_view rest = *text;
  const double most = given.number("n").value_or(-1);
  while (!rest.empty() && (most < 0 || static_cast<double>(lines.size()) < most)) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.emplace_back(line);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (lines.size() > kLongestVector) return wrong(node, "makes too long a vector");
  }
  return vector_of(std::move(lines));
}

/// Converts R's \\1 to ECMAScript's $01: there a second digit would belong to the number.
std::string replacement_of(const std::string& text) {
  std::string written;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size()) {
      ++i;
      const bool is_group = text[i] >= '0' && text[i] <= '9';
      written += is_group ? (text[i] == '0' ? "$&" : std::string("$0") + text[i])
                          : std::string(1, text[i]);
    } else {
      written += text[i] == '$' ? "$$" : std::string(1, text[i]);
    }
  }
  return written;
}

std::string replaced_text(std::string text, const std::string& from, const std::string& to,
                          bool all) {
  for (std::size_t at = text.find(from); at != std::string::npos && !from.empty();
       at = all ? text.find(from, at + to.size()) : std::string::npos)
    text.replace(at, from.size(), to);
  return text;
}

Expected<Vector> substitute(const Node& node, const Arguments& given, bool all) {
  const auto pattern = given.text("pattern");
  const auto replacement = given.text("replacement");
  if (!pattern || !replacement)
    return wrong(node, "a pattern and its replacement are one text each");
  std::vector<std::string> texts = given.texts("x");
  std::size_t length = 0;
  for (std::string& text : texts) {
    if (text.size() > kLongestSearched || pattern->size() > kLongestSearched)
      return wrong(node, "is for shorter texts here");
    if (given.is_true("fixed")) {
      text = replaced_text(text, *pattern, *replacement, all);
    } else {
      try {
        auto flags = std::regex::ECMAScript;
        if (given.is_true("ignore.case")) flags |= std::regex::icase;
        const auto first =
            all ? std::regex_constants::format_default : std::regex_constants::format_first_only;
        text = std::regex_replace(text, std::regex(*pattern, flags), replacement_of(*replacement),
                                  first);
      } catch (const std::regex_error&) {
        return wrong(node,
                     "the pattern \"" + *pattern +
                         "\" is not supported here; with fixed = TRUE it is read as plain text");
      }
    }
    length += text.size();
    if (length > kLongestText) return wrong(node, "makes too long a text");
  }
  return vector_of(std::move(texts));
}

/// Formats one value with one part of a format, such as "%05.2f".
Expected<std::string> formatted(const Node& node, const std::string& part, const Scalar& value) {
  constexpr std::size_t kWidest = 1000;
  std::array<char, kWidest> buffer{};
  const char kind = part.back();
  const std::string flags = part.substr(0, part.size() - 1);
  int written = -1;
  if (kind == 's') {
    written = std::snprintf(buffer.data(), buffer.size(), part.c_str(), to_text(value).c_str());
  } else if (value.type == Scalar::Type::Text || value.missing) {
    return wrong(node, "sprintf: " + part + " must be a number, found " + to_text(value));
  } else if (std::string_view("dixX").find(kind) != std::string_view::npos) {
    if (value.number != std::floor(value.number) || std::fabs(value.number) > 9e15)
      return wrong(node, "sprintf: " + part + " must be a whole number, found " + to_text(value));
    written = std::snprintf(buffer.data(), buffer.size(), (flags + "ll" + kind).c_str(),
                            static_cast<long long>(value.number));
  } else {
    written = std::snprintf(buffer.data(), buffer.size(), part.c_str(), value.number);
  }
  if (written < 0 || static_cast<std::size_t>(written) >= buffer.size())
    return wrong(node, "sprintf: makes too long a text");
  return std::string(buffer.data(), static_cast<std::size_t>(written));
}

Expected<std::string> sprintf_row(const Node& node, const std::string& format,
                                  const std::vector<Part>& parts, std::size_t row) {
  std::string text;
  std::size_t next = 1;
  for (std::size_t i = 0; i < format.size(); ++i) {
    if (format[i] != '%') {
      text += format[i];
      continue;
    }
    const std::size_t end = format.find_first_not_of("0123456789.-+ #", i + 1);
    if (end == std::string::npos ||
        std::string_view("%sdixXfFeEgG").find(format[end]) == std::string_view::npos ||
        end - i > 12) {
      return wrong(node, "sprintf knows %s %d %i %x %f %e %g and %%, found \"" +
                             format.substr(i, 12) + "\"");
    }
    if (format[end] == '%') {
      text += '%';
    } else if (next >= parts.size() || parts[next].value.empty()) {
      return wrong(node, "sprintf has more places than values");
    } else {
      const Vector& values = parts[next++].value;
      auto piece = formatted(node, format.substr(i, end - i + 1), values[row % values.size()]);
      if (!piece) return piece;
      text += *piece;
    }
    i = end;
  }
  return text;
}

Expected<Vector> format_texts(const Node& node, std::vector<Part> parts) {
  const auto named =
      std::ranges::find_if(parts, [](const Part& part) { return part.name == "fmt"; });
  if (named != parts.end()) std::rotate(parts.begin(), named, named + 1);
  std::size_t rows = 0;
  for (const Part& part : parts)
    rows = std::max(rows, part.value.size());
  if (parts.empty() || parts.front().value.empty()) return wrong(node, "sprintf needs a format");
  const std::vector<std::string> formats = to_texts(parts.front().value);
  Vector result;
  std::size_t length = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    auto text = sprintf_row(node, formats[row % formats.size()], parts, row);
    if (!text) return Unexpected(text.error());
    length += text->size();
    if (length > kLongestText) return wrong(node, "makes too long a text");
    result.push_back(Scalar::of_text(std::move(*text)));
  }
  return result;
}

/// R's seq.default: of from, to, by and the length, three give the fourth.
Expected<Vector> sequence(const Node& node, const std::string& name, const Arguments& given) {
  double from = given.number("from").value_or(1);
  std::optional<double> to = given.number("to");
  std::optional<double> count = given.number("length.out");
  if (count && name == "seq") count = std::ceil(*count);  // seq_len cuts the fraction off
  if (given.has("from") && to && given.has("by") && count)
    return wrong(node, "seq takes three of `from`, `to`, `by` and `length.out`: leave one out");
  // seq(5) means 1 to 5.
  if (!to && !count && !given.has("by")) to = std::exchange(from, 1);
  double by = given.number("by").value_or(to && *to < from && !count ? -1 : 1);
  if (count && to && !given.has("from")) {
    from = *to - (*count - 1) * by;
  } else if (count && to && *count > 1) {
    by = (*to - from) / (*count - 1);
  }
  const double steps = count ? *count - 1 : std::floor((to.value_or(from) - from) / by + 1e-10);
  if (!std::isfinite(steps) || steps < -1 || (steps < 0 && !count))
    return wrong(node, "seq cannot come from " + to_text(Scalar::real(from)) + " to " +
                           to_text(Scalar::real(to.value_or(from))) + " by " +
                           to_text(Scalar::real(by)));
  if (steps >= static_cast<double>(kLongestVector)) return wrong(node, "makes too long a vector");
  const bool whole = from == std::floor(from) && by == std::floor(by);
  Vector result;
  for (double i = 0; i <= steps; ++i)
    result.push_back(whole ? Scalar::integer(from + i * by) : Scalar::real(from + i * by));
  return result;
}

const std::map<std::string, std::vector<std::string_view>, std::less<>>& functions() {
  static const std::map<std::string, std::vector<std::string_view>, std::less<>> kFunctions = {
      {"basename", {"path"}},
      {"dirname", {"path"}},
      {"getwd", {}},
      {"gsub", {"pattern", "replacement", "x", "ignore.case", "perl", "fixed"}},
      {"normalizePath", {"path", "winslash", "mustWork"}},
      {"readLines", {"con", "n", "ok", "warn", "encoding"}},
      {"seq", {"from", "to", "by", "length.out"}},
      {"seq_len", {"length.out"}},
      {"sprintf", {}},
      {"sub", {"pattern", "replacement", "x", "ignore.case", "perl", "fixed"}}};
  return kFunctions;
}

}  // namespace

bool is_scenario_function(std::string_view name) {
  return functions().contains(name);
}

std::string_view scenario_function_names() {
  return "basename dirname getwd gsub normalizePath readLines seq seq_len sprintf sub";
}

Expected<Vector> call_scenario_function(const Node& node, const std::string& name,
                                        std::vector<Part> parts, const Environment& environment) {
  if (name == "sprintf") return format_texts(node, std::move(parts));
  const auto given = Arguments::match(node, name, std::move(parts), functions().find(name)->second);
  if (!given) return Unexpected(given.error());
  if (name == "getwd") return Vector{Scalar::of_text(environment.folder.string())};
  if (name == "readLines") return read_lines(node, *given, environment);
  if (name == "sub" || name == "gsub") return substitute(node, *given, name == "gsub");
  if (name == "seq" || name == "seq_len") return sequence(node, name, *given);
  std::vector<std::string> paths = given->texts("path");
  for (std::string& path : paths) {
    if (name == "dirname") path = folder_of(path);
    if (name == "basename") path = name_of(path);
    if (name == "normalizePath") path = absolute_path(path, environment.folder).string();
  }
  return vector_of(std::move(paths));
}

}  // namespace swarmsmith::r
