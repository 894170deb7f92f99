#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace swarmsmith {

/// Escapes text for an element or an attribute; control characters become escapes
/// (base/shown_text.h).
std::string html_escaped(std::string_view text);

/// A number for people: four significant digits, no exponent up to a million, no sign before 0;
/// "0.0312", "2.75", "-380000".
std::string shown_number(double value);

/// A table with a caption and a header; the first column contains the headings of the rows.
struct HtmlTable {
  struct Column {
    std::string title;
    bool is_number = false;  ///< aligned on the right
  };

  std::string caption;
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;  ///< each row has as many cells as there are columns
};

/// An HTML page that is built piece by piece: well-formed XML that is also HTML, with a style sheet
/// for light and dark screens and for paper. It has no script and loads nothing; its content
/// security policy makes the browser enforce this.
class HtmlPage {
 public:
  /// A heading of level 2 or 3 with an anchor; it is in the table of contents if `listed`.
  void heading(int level, std::string_view text, bool listed = true);
  void paragraph(std::string_view text);
  /// Names and values side by side; adds nothing if there are none.
  void facts(std::string_view caption,
             const std::vector<std::pair<std::string, std::string>>& facts);
  /// Adds nothing if there are no rows.
  void table(const HtmlTable& table);
  /// An SVG file, embedded in the page, with a caption below it.
  void picture(std::string_view svg, std::string_view caption);
  /// Preformatted text; long lines are broken. The label above it may be empty.
  void verbatim(std::string_view label, std::string_view text);
  /// Begins a chapter. On paper it starts on a new page.
  void begin_chapter();
  void end_chapter();
  /// Begins a part that is hidden below the text until the reader opens it; on paper it stays
  /// hidden. A listed text is a heading of level 2.
  void begin_folded(std::string_view text, bool listed = true);
  void end_folded();
  /// The pictures that follow are placed side by side if there is room.
  void begin_grid();
  void end_grid();
  /// Links to files beside the page; adds nothing if there are none.
  void links(std::string_view caption,
             const std::vector<std::pair<std::string, std::string>>& texts_and_paths);

  /// The complete file. `title` is at the top of the page, `summary` below it.
  std::string finish(std::string_view title, std::string_view summary) const;

 private:
  struct Entry {
    int level = 2;
    std::string anchor;
    std::string text;
  };

  std::string next_id();

  std::string text_;
  std::vector<Entry> entries_;
  std::size_t ids_ = 0;
};

}  // namespace swarmsmith
