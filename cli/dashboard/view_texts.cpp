#include "cli/dashboard/view_texts.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "base/plain_text.h"
#include "embedded/kStoragePage.h"

namespace swarmsmith::cli {
namespace {

struct ViewText {
  std::string text;
  std::map<std::string, std::string, std::less<>> columns;
};
using ViewTexts = std::map<std::string, ViewText, std::less<>>;

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(' ');
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(' ') - from + 1);
}

/// Removes links and code marks, which only readers of the page need.
std::string plain(std::string_view text) {
  std::string kept;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '`' || text[i] == '[') continue;
    if (text[i] == ']' && i + 1 < text.size() && text[i + 1] == '(') {
      i = text.find(')', i);
      if (i == std::string_view::npos) break;
      continue;
    }
    if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == '|') continue;
    kept += text[i];
  }
  return kept;
}

/// Splits "used, budget" into its names.
std::vector<std::string> names_in(std::string_view text) {
  std::vector<std::string> names;
  for (const std::string_view name : split(text, ','))
    names.push_back(plain(trimmed(name)));
  return names;
}

/// Reads headings such as "### v_designs: a design, that is one race", and the rows "| used, budget
/// | meaning |" below them.
ViewTexts read_page() {
  ViewTexts views;
  std::vector<ViewText*> here;  // the views of the rows that follow
  for (const std::string_view line : split_lines(kStoragePage)) {
    if (line.starts_with("#")) {
      here.clear();
      if (!line.starts_with("### v_")) continue;
      const std::size_t colon = std::min(line.find(": "), line.size());
      for (const std::string& name : names_in(line.substr(4, colon - 4))) {
        here.push_back(&views[name]);
        if (colon < line.size()) here.back()->text = plain(line.substr(colon + 2));
      }
      continue;
    }
    const std::size_t second = line.find(" | ");
    if (here.empty() || !line.starts_with("| ") || second == std::string_view::npos) continue;
    const std::string meaning =
        plain(trimmed(line.substr(second + 3, line.rfind('|') - second - 3)));
    for (const std::string& name : names_in(line.substr(2, second - 2))) {
      for (ViewText* view : here)
        view->columns[name] = meaning;
    }
  }
  return views;
}

const ViewText* find_view(std::string_view view) {
  static const ViewTexts kViews = read_page();
  const auto found = kViews.find(view);
  return found == kViews.end() ? nullptr : &found->second;
}

}  // namespace

std::string text_of_view(std::string_view view) {
  const ViewText* known = find_view(view);
  return known == nullptr ? "" : known->text;
}

std::string text_of_column(std::string_view view, std::string_view column) {
  const ViewText* known = find_view(view);
  if (known == nullptr) return "";
  const auto found = known->columns.find(column);
  return found == known->columns.end() ? "" : found->second;
}

}  // namespace swarmsmith::cli
