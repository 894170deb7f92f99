#include "console/wrapped.h"

#include <algorithm>
#include <vector>

#include "base/text/text_table.h"

namespace swarmsmith {
namespace {

/// Adds words to the current line of the result.
class Filler {
 public:
  Filler(std::string& text, std::size_t width) : text_(&text), width_(width) {}

  /// Begins a line with `indent` blanks; continuation lines begin with `hanging` blanks. `joint` is
  /// added to the end of a line that continues.
  void begin(std::size_t indent, std::size_t hanging, std::string_view joint = "") {
    joint_ = joint;
    text_->append(indent, ' ');
    column_ += indent;
    hanging_ = hanging;
    at_begin_ = true;
  }
  void take(std::size_t columns) { column_ += columns; }

  void add(std::string_view word, std::size_t blanks) {
    const std::size_t size = width_of(word);
    if (at_begin_) blanks = 0;
    if (!at_begin_ && column_ + blanks + size + joint_.size() > width_) {
      *text_ += joint_;
      end();
      begin(hanging_, hanging_, joint_);
      blanks = 0;
    }
    text_->append(blanks, ' ');
    *text_ += word;
    column_ += blanks + size;
    at_begin_ = false;
  }

  void end() {
    *text_ += '\n';
    column_ = 0;
  }

 private:
  std::string* text_;
  std::size_t width_;
  std::size_t column_ = 0;
  std::size_t hanging_ = 0;
  std::string_view joint_;
  bool at_begin_ = true;
};

/// Calls `visit(word, blanks before it)`.
template <class Visit>
void each_word(std::string_view line, Visit visit) {
  std::size_t at = 0;
  while (at < line.size()) {
    const std::size_t begin = std::min(line.find_first_not_of(' ', at), line.size());
    const std::size_t end = std::min(line.find(' ', begin), line.size());
    if (begin < end) visit(line.substr(begin, end - begin), begin - at);
    at = end;
  }
}

/// Where an indented line continues: below the text after a gap, as in a table, or two columns
/// further to the right.
std::size_t hanging_of(std::string_view line, std::size_t indent) {
  const std::size_t gap = line.find("  ", indent);
  if (gap == std::string_view::npos) return indent + 2;
  return std::min(line.find_first_not_of(' ', gap), line.size());
}

/// Whether the line is a command, which must still work after it is broken.
bool is_command(std::string_view line) {
  const std::string_view words = line.substr(std::min(line.find_first_not_of(' '), line.size()));
  return words.starts_with("swarmsmith") || words.starts_with("SWARMSMITH_");
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (true) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return lines;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t width, std::size_t first) {
  std::string result;
  Filler filler(result, width);
  filler.take(first);
  bool in_paragraph = false;
  for (const std::string_view line : lines_of(text)) {
    const bool goes_on = !line.empty() && line.front() != ' ';
    if (in_paragraph && !goes_on) filler.end();
    if (goes_on) {
      if (!in_paragraph) filler.begin(0, 0);
      each_word(line, [&](std::string_view word, std::size_t) { filler.add(word, 1); });
    } else if (!line.empty()) {
      const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
      if (is_command(line)) {
        filler.begin(indent, indent + 4, " \\");
      } else {
        filler.begin(indent, hanging_of(line, indent));
      }
      each_word(line, [&](std::string_view word, std::size_t blanks) { filler.add(word, blanks); });
      filler.end();
    } else {
      filler.end();
    }
    in_paragraph = goes_on;
  }
  // The result ends with a line end only if the text does.
  if (!in_paragraph && !result.empty()) result.pop_back();
  return result;
}

}  // namespace swarmsmith
