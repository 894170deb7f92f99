#include "tests/support/drawn_page.h"

#include <algorithm>
#include <cstdlib>
#include <regex>

#include "analysis/drawing/figure_style.h"
#include "analysis/drawing/svg.h"

namespace swarmsmith {
namespace {

double number(const std::string& text) {
  return std::strtod(text.c_str(), nullptr);
}

/// "M1 2h3m.5 0h1": bars, each from where the one before ended.
std::vector<DrawnPage::Bar> bars_in(const std::string& data) {
  std::vector<DrawnPage::Bar> bars;
  double x = 0;
  double y = 0;
  const char* at = data.c_str();
  while (*at != '\0') {
    const char letter = *at++;
    char* end = nullptr;
    const double first = std::strtod(at, &end);
    at = end;
    if (letter == 'M' || letter == 'm') {
      const double second = std::strtod(at, &end);
      at = end;
      x += first;
      y += second;
    } else {
      bars.push_back({.x = x, .y = y, .length = first, .goes_down = letter == 'v'});
      (letter == 'v' ? y : x) += first;
    }
  }
  return bars;
}

DrawnPage::Text text_of(const std::smatch& match) {
  DrawnPage::Text text{.text = match[6]};
  const double size = number(match[3]);
  const double width = text_width(text.text, size) * (match[5].matched ? kBolder : 1);
  const std::string anchor = match[4];
  text.left = number(match[1]);
  if (anchor == "middle") text.left -= width / 2;
  if (anchor == "end") text.left -= width;
  text.right = text.left + width;
  // Heights of capital letters; those below the base line fit between two lines.
  text.bottom = number(match[2]);
  text.top = text.bottom - 0.73 * size;
  return text;
}

}  // namespace

bool DrawnPage::has_text(const std::string& text) const {
  return std::ranges::find(texts, text, &Text::text) != texts.end();
}

std::vector<DrawnPage::Bar> DrawnPage::bars_of(const std::string& color) const {
  std::vector<Bar> result;
  std::ranges::copy_if(bars, std::back_inserter(result),
                       [&](const Bar& bar) { return bar.color == color; });
  return result;
}

std::vector<std::string> DrawnPage::collisions() const {
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const Text& a = texts[i];
    if (a.left < 0 || a.top < 0 || a.right > width || a.bottom > height)
      sentences.push_back(a.text + " leaves the page");
    for (std::size_t j = i + 1; j < texts.size(); ++j) {
      const Text& b = texts[j];
      const bool apart =
          a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
      if (!apart) sentences.push_back(a.text + " stands on " + b.text);
    }
  }
  return sentences;
}

DrawnPage drawn_page(const std::string& svg) {
  DrawnPage page;
  std::smatch match;
  if (std::regex_search(svg, match, std::regex("viewBox=\"0 0 ([0-9.]+) ([0-9.]+)\""))) {
    page.width = number(match[1]);
    page.height = number(match[2]);
  }
  static const std::regex kText(
      "<text x=\"([-0-9.]+)\" y=\"([-0-9.]+)\" font-size=\"([0-9.]+)\""
      "(?: text-anchor=\"([a-z]+)\")?( font-weight=\"bold\")? fill=\"[^\"]*\">(.*)</text>");
  static const std::regex kBars(
      "<path d=\"([^\"]*)\" fill=\"none\" stroke=\"([^\"]*)\" stroke-width=\"([^\"]*)\""
      " shape-rendering=\"crispEdges\"/>");
  std::size_t begin = 0;
  // An element a line.
  for (std::size_t end = svg.find('\n'); end != std::string::npos; end = svg.find('\n', begin)) {
    const std::string line = svg.substr(begin, end - begin);
    begin = end + 1;
    if (line.starts_with("<text")) {
      if (std::regex_match(line, match, kText)) page.texts.push_back(text_of(match));
      continue;
    }
    if (!line.starts_with("<path")) continue;
    // Long paths are more than std::regex can take at once.
    if (!line.ends_with("shape-rendering=\"crispEdges\"/>")) {
      page.paths.push_back(line);
      continue;
    }
    const std::size_t data = line.find('"') + 1;
    const std::size_t data_end = line.find('"', data);
    const std::string rest = "<path d=\"" + line.substr(data_end);
    if (!std::regex_match(rest, match, kBars)) continue;
    for (DrawnPage::Bar bar : bars_in(line.substr(data, data_end - data))) {
      bar.color = match[2];
      bar.thickness = number(match[3]);
      page.bars.push_back(bar);
    }
  }
  return page;
}

}  // namespace swarmsmith
