#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/irace_text.h"
#include "irace_core/files/r_syntax.h"

namespace swarmsmith::irace {

/// The lines of a text without line ends; a byte order mark is dropped.
std::vector<std::string_view> split_lines(std::string_view text);

bool is_blank(char c);
std::string_view trimmed(std::string_view text);

/// One line of a file, and the position up to which it has been read.
class LineReader {
 public:
  /// `file` and `line` must outlive the reader.
  LineReader(const std::string& file, std::string_view line, std::size_t number)
      : file_(&file), line_(line), number_(number) {}

  std::string_view rest() const { return line_.substr(at_); }
  bool at_end() const { return at_ == line_.size(); }
  void advance(std::size_t bytes) { at_ += bytes; }
  void skip_blanks();
  /// Whether only blanks and a comment are left.
  bool at_comment_or_end();
  /// Takes letters, digits, '_' and '.' from the current position.
  std::string_view take_name();
  /// Takes the text up to the next blank.
  std::string_view take_word();

  r::Place place() const;
  std::string where() const { return where(place()); }
  std::string where(r::Place place) const { return *file_ + ":" + r::to_string(place); }
  /// An error at this position: "expected <wanted>, found "<rest of the line>"".
  Unexpected expected(const std::string& wanted) const;

 private:
  const std::string* file_;
  std::string_view line_;
  std::size_t number_;
  std::size_t at_ = 0;
};

/// Puts the file name before the place of a parser's error.
Error in_file(Error error, const std::string& file);

}  // namespace swarmsmith::irace
