#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// The words of a text, split as a shell does it, but without a shell.
struct Words {
  std::vector<std::string> words;
  /// The first character that is special for a shell and was not quoted. Then only a shell can find
  /// the words, and `words` is empty.
  std::optional<char> needs_shell;

  friend bool operator==(const Words&, const Words&) = default;
};

/// Blanks and tabs separate words; '...' is verbatim; in "..." a backslash escapes " \ $ ` and
/// newline; outside quotes it escapes any character. Errors, with the byte (from 1) in `where`: a
/// quote that is not closed, a backslash at the end, a NUL byte.
/// Source: POSIX.1-2017, Shell Command Language, 2.2 and 2.3.
Expected<Words> split_words(std::string_view text);

/// Quotes the text as one word for a shell: in single quotes; single quotes in the text are placed
/// outside them.
std::string shell_quoted(std::string_view text);

}  // namespace swarmsmith
