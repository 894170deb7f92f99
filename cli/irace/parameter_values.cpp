#include "cli/irace/parameter_values.h"

#include <charconv>
#include <optional>
#include <system_error>

namespace swarmsmith::cli {
namespace {

/// Reads the only form of JSON that stores use for candidates.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  std::optional<ParameterValues> object() {
    ParameterValues values;
    if (!take('{')) return std::nullopt;
    if (take('}')) return at_end() ? std::optional(values) : std::nullopt;
    do {
      skip_blanks();
      const auto name = string();
      if (!name || !take(':')) return std::nullopt;
      skip_blanks();
      if (!text_.empty() && text_.front() == '"') {
        auto value = string();
        if (!value) return std::nullopt;
        values.emplace(*name, std::move(*value));
      } else {
        const auto value = number();
        if (!value) return std::nullopt;
        values.emplace(*name, *value);
      }
    } while (take(','));
    if (!take('}') || !at_end()) return std::nullopt;
    return values;
  }

 private:
  void skip_blanks() {
    const std::size_t begin = text_.find_first_not_of(" \t\r\n");
    text_.remove_prefix(begin == std::string_view::npos ? text_.size() : begin);
  }

  bool at_end() {
    skip_blanks();
    return text_.empty();
  }

  bool take(char letter) {
    skip_blanks();
    if (text_.empty() || text_.front() != letter) return false;
    text_.remove_prefix(1);
    return true;
  }

  std::optional<double> number() {
    double value = 0;
    const auto read = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    if (read.ec != std::errc()) return std::nullopt;
    text_.remove_prefix(static_cast<std::size_t>(read.ptr - text_.data()));
    return value;
  }

  std::optional<std::string> string() {
    if (!take('"')) return std::nullopt;
    std::string value;
    while (!text_.empty() && text_.front() != '"') {
      if (text_.front() == '\\') {
        if (!escape(value)) return std::nullopt;
      } else {
        value += text_.front();
        text_.remove_prefix(1);
      }
    }
    if (!take('"')) return std::nullopt;
    return value;
  }

  /// Only control characters are written as \u.
  bool escape(std::string& value) {
    if (text_.size() < 2) return false;
    const char letter = text_[1];
    text_.remove_prefix(2);
    constexpr std::string_view kLetters = "\"\\/nrtbf";
    constexpr std::string_view kMeant = "\"\\/\n\r\t\b\f";
    if (const std::size_t at = kLetters.find(letter); at != std::string_view::npos) {
      value += kMeant[at];
      return true;
    }
    int code = 0;
    if (letter != 'u' || text_.size() < 4) return false;
    const auto read = std::from_chars(text_.data(), text_.data() + 4, code, 16);
    if (read.ptr != text_.data() + 4 || code >= 0x80) return false;
    value += static_cast<char>(code);
    text_.remove_prefix(4);
    return true;
  }

  std::string_view text_;
};

}  // namespace

Expected<ParameterValues> parse_parameter_values(std::string_view json) {
  if (json.empty()) return ParameterValues{};
  auto values = Reader(json).object();
  if (!values) {
    return unexpected(ErrorKind::Corrupt,
                      "a candidate's parameters are not a JSON object of numbers and texts: " +
                          std::string(json.substr(0, 100)));
  }
  return std::move(*values);
}

}  // namespace swarmsmith::cli
