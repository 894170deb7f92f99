#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace swarmsmith {

/// Text as it may stand in an element or an attribute; what is not shown becomes an escape
/// (base/shown_text.h).
std::string html_escaped(std::string_view text);

/// A number as people read it: four significant digits, no exponent up to a million, no sign before
/// 0; "0.0312", "2.75", "-380000".
std::string shown_number(double value);

/// A table with a caption and a header; the first column heads its rows.
struct HtmlTable {
  struct Column {
    std::string title;
    bool is_number = false;  ///< stands on the right
  };

  std::string caption;
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;  ///< as many cells as columns
};

/// A page that grows piece by piece: well-formed XML that is HTML too, with a style sheet for
/// screens, light and dark, and for paper. It has no script and loads nothing, which its
/// content security policy makes the browser hold it to.
class HtmlPage {
 public:
  /// A heading of level 2 or 3 with an anchor, which the contents list when `listed`.
  void heading(int level, std::string_view text, bool listed = true);
  void paragraph(std::string_view text);
  /// Names and values side by side; nothing without any.
  void facts(std::string_view caption,
             const std::vector<std::pair<std::string, std::string>>& facts);
  /// Nothing without rows.
  void table(const HtmlTable& table);
  /// An SVG file, in the page, with a caption below it.
  void picture(std::string_view svg, std::string_view caption);
  /// Text as it is, lines broken where they are too long, below a label when there is one.
  void verbatim(std::string_view label, std::string_view text);
  /// What follows begins a page on paper, up to the next chapter.
  void begin_chapter();
  void end_chapter();
  /// What follows is folded away below the text until the reader opens it; it stays so on paper. A
  /// listed text is a heading of level 2.
  void begin_folded(std::string_view text, bool listed = true);
  void end_folded();
  /// Pictures that follow stand side by side where there is room.
  void begin_grid();
  void end_grid();
  /// Links to files beside the page; nothing without any.
  void links(std::string_view caption,
             const std::vector<std::pair<std::string, std::string>>& texts_and_paths);

  /// The file. `title` heads the page, `summary` stands below it.
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
