#include "irace_core/files/internal/line_reader.h"

#include <algorithm>

#include "base/plain_text.h"
#include "irace_core/files/internal/r_literal.h"

namespace swarmsmith::irace {

std::vector<std::string_view> split_lines(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    text.remove_prefix(kByteOrderMark.size());
  }
  std::vector<std::string_view> lines = swarmsmith::split_lines(text);
  for (std::string_view& line : lines)
    if (line.ends_with('\r')) line.remove_suffix(1);
  return lines;
}

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back()))
    text.remove_suffix(1);
  return text;
}

void LineReader::skip_blanks() {
  while (!at_end() && is_blank(line_[at_]))
    ++at_;
}

bool LineReader::at_comment_or_end() {
  skip_blanks();
  return at_end() || line_[at_] == '#';
}

std::string_view LineReader::take_name() {
  const std::size_t first = at_;
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || static_cast<unsigned char>(c) >= 0x80;
  };
  while (!at_end() && fits(line_[at_])) {
    const std::size_t length = r::character_length(line_.substr(at_));
    if (r::is_typographic(line_.substr(at_, length))) break;
    at_ += length;
  }
  return line_.substr(first, at_ - first);
}

std::string_view LineReader::take_word() {
  const std::size_t first = at_;
  while (!at_end() && !is_blank(line_[at_]))
    ++at_;
  return line_.substr(first, at_ - first);
}

r::Place LineReader::place() const {
  r::Place place{number_, 1};
  for (std::string_view before = line_.substr(0, at_); !before.empty(); ++place.column)
    before.remove_prefix(r::character_length(before));
  return place;
}

Unexpected LineReader::expected(const std::string& wanted) const {
  constexpr std::size_t kMost = 60;
  std::string_view found = trimmed(rest());
  std::size_t end = 0;
  while (end < std::min(kMost, found.size()))
    end += r::character_length(found.substr(end));
  std::string quoted = found.empty() ? "the end of the line"
                                     : "\"" + std::string(found.substr(0, end)) +
                                           (end < found.size() ? "...\"" : "\"");
  return bad_input("expected " + wanted + ", found " + quoted, where());
}

Error in_file(Error error, const std::string& file) {
  error.where = file + ":" + error.where;
  return error;
}

}  // namespace swarmsmith::irace
