#include "tests/analysis/support/svg_texts.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

namespace swarmsmith {
namespace {

/// Advance widths of DejaVu Sans 2.37, thousandths of its size, from the blank to the tilde; read
/// from the table `hmtx` of DejaVuSans.ttf and DejaVuSans-Bold.ttf.
using Widths = std::array<int, 95>;
constexpr Widths kBook = {
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361,  318, 337, 636, 636, 636,
    636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632,
    575, 775, 752, 295, 295, 656, 557, 863, 748, 787, 603, 787, 695, 635,  611, 732, 684, 989, 685,
    611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635, 615, 352,  635, 634, 278, 278, 579,
    278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592,  525, 636, 337, 636, 838};
constexpr Widths kBold = {348, 456, 521, 838, 696,  1002, 872, 306,  457, 457, 523, 838, 380, 415,
                          380, 365, 696, 696, 696,  696,  696, 696,  696, 696, 696, 696, 400, 400,
                          838, 838, 838, 580, 1000, 774,  762, 734,  830, 683, 683, 821, 837, 372,
                          372, 775, 637, 995, 837,  850,  733, 850,  770, 720, 682, 812, 774, 1103,
                          771, 724, 725, 457, 365,  457,  838, 500,  500, 675, 716, 593, 716, 678,
                          435, 716, 712, 343, 343,  665,  343, 1042, 712, 687, 716, 716, 493, 595,
                          478, 712, 652, 924, 645,  652,  582, 712,  365, 712, 838};
constexpr int kOther = 1000;  // an ellipsis; a cross for "times" has 838

double width_of(std::string_view text, double size, bool bold) {
  int sum = 0;
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (code >= 0xc0) sum += kOther;  // the first byte of a character beyond ASCII
    if (code < 0x20 || code > 0x7e) continue;
    sum += (bold ? kBold : kBook)[code - 0x20U];
  }
  return size * sum / 1000;
}

/// The value of an attribute, empty without it.
std::string_view attribute(std::string_view element, std::string_view name) {
  const std::size_t at = element.find(fmt::format(" {}=\"", name));
  if (at == std::string_view::npos) return {};
  element.remove_prefix(at + name.size() + 3);
  return element.substr(0, element.find('"'));
}

double number(std::string_view text) {
  return std::strtod(std::string(text).c_str(), nullptr);
}

std::string unescaped(std::string_view text) {
  std::string result(text);
  for (const auto& [entity, letter] : {std::pair("&lt;", "<"), std::pair("&gt;", ">"),
                                       std::pair("&quot;", "\""), std::pair("&amp;", "&")}) {
    for (std::size_t at = 0; (at = result.find(entity, at)) != std::string::npos; ++at)
      result.replace(at, std::string_view(entity).size(), letter);
  }
  return result;
}

std::pair<double, double> page_of(std::string_view svg) {
  return {number(attribute(svg, "width")), number(attribute(svg, "height"))};
}

/// All elements of a name, from it to the end of the tag.
std::vector<std::string_view> elements(std::string_view svg, std::string_view name) {
  std::vector<std::string_view> found;
  const std::string begin = fmt::format("<{} ", name);
  for (std::size_t at = 0; (at = svg.find(begin, at)) != std::string_view::npos; ++at)
    found.push_back(svg.substr(at, svg.find('>', at) - at));
  return found;
}

/// The numbers of a path's data, which are absolute but for a dot's "h0".
std::vector<double> coordinates(std::string_view data) {
  std::string plain;
  for (const char letter : data)
    plain += letter == 'M' || letter == 'L' || letter == 'Z' ? ' ' : letter;
  for (std::size_t at = 0; (at = plain.find("h0", at)) != std::string::npos;)
    plain.erase(at, 2);
  std::vector<double> values;
  const char* place = plain.c_str();
  char* end = nullptr;
  for (double value = std::strtod(place, &end); end != place; value = std::strtod(place, &end)) {
    values.push_back(value);
    place = end;
  }
  return values;
}

/// Where the groups begin that an element stands in; 0, 0 outside of groups.
std::pair<double, double> origin_of(std::string_view svg, std::string_view element) {
  const std::string_view before =
      svg.substr(0, static_cast<std::size_t>(element.data() - svg.data()));
  constexpr std::string_view kMoved = "<g transform=\"translate(";
  std::vector<std::pair<double, double>> open = {{0, 0}};
  for (std::size_t at = 0; (at = before.find('<', at)) != std::string_view::npos; ++at) {
    const std::string_view tag = before.substr(at);
    if (tag.starts_with("</g>")) {
      open.pop_back();
    } else if (tag.starts_with(kMoved)) {
      const std::vector<double> moved =
          coordinates(tag.substr(kMoved.size(), tag.find(')') - kMoved.size()));
      open.emplace_back(open.back().first + moved.at(0), open.back().second + moved.at(1));
    } else if (tag.starts_with("<g ") || tag.starts_with("<g>")) {
      open.push_back(open.back());
    }
  }
  return open.back();
}

bool overlap(const TextBox& a, const TextBox& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

std::string shown(const TextBox& box) {
  return fmt::format("\"{}\" ({:.1f} to {:.1f}, {:.1f} to {:.1f})", box.text, box.left, box.right,
                     box.top, box.bottom);
}

}  // namespace

std::vector<TextBox> texts_of(std::string_view svg) {
  std::vector<TextBox> boxes;
  for (const std::string_view element : elements(svg, "text")) {
    const auto* const content = element.data() + element.size() + 1;
    const std::string_view rest(content, static_cast<std::size_t>(svg.end() - content));
    TextBox box{.text = unescaped(rest.substr(0, rest.find("</text>")))};
    const double size = number(attribute(element, "font-size"));
    const double width = width_of(box.text, size, attribute(element, "font-weight") == "bold");
    const std::string_view anchor = attribute(element, "text-anchor");
    const auto [x0, y0] = origin_of(svg, element);
    box.left = x0 + number(attribute(element, "x"));
    if (anchor == "middle") box.left -= width / 2;
    if (anchor == "end") box.left -= width;
    box.right = box.left + width;
    const double y = y0 + number(attribute(element, "y"));
    const bool descends = box.text.find_first_of("gjpqyQ,;()_|") != std::string::npos;
    box.top = y - 0.73 * size;
    box.bottom = y + (descends ? 0.21 : 0.01) * size;
    boxes.push_back(std::move(box));
  }
  return boxes;
}

std::vector<std::string> text_problems(std::string_view svg) {
  std::vector<std::string> problems;
  const auto [width, height] = page_of(svg);
  const std::vector<TextBox> boxes = texts_of(svg);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const TextBox& box = boxes[i];
    if (box.left < 0 || box.top < 0 || box.right > width || box.bottom > height)
      problems.push_back(
          fmt::format("{} is not on the page of {} x {}", shown(box), width, height));
    for (std::size_t j = 0; j < i; ++j)
      if (overlap(box, boxes[j])) problems.push_back(shown(boxes[j]) + " lies under " + shown(box));
  }
  return problems;
}

std::vector<std::string> shape_problems(std::string_view svg) {
  std::vector<std::string> problems;
  const auto [width, height] = page_of(svg);
  for (const std::string_view element : elements(svg, "path")) {
    const auto [x0, y0] = origin_of(svg, element);
    const std::vector<double> values = coordinates(attribute(element, "d"));
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double value = values[i] + (i % 2 == 0 ? x0 : y0);
      const double most = i % 2 == 0 ? width : height;
      if (value < 0 || value > most)
        problems.push_back(fmt::format("{} of a path is not within {}", value, most));
    }
  }
  for (const std::string_view element : elements(svg, "circle")) {
    const auto [x0, y0] = origin_of(svg, element);
    const double x = x0 + number(attribute(element, "cx"));
    const double y = y0 + number(attribute(element, "cy"));
    if (x < 0 || x > width || y < 0 || y > height)
      problems.push_back(fmt::format("a circle at {}, {} is not on the page", x, y));
  }
  return problems;
}

std::size_t dots_in(std::string_view svg) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = svg.find("h0", at)) != std::string_view::npos; ++at)
    ++count;
  return count;
}

}  // namespace swarmsmith
