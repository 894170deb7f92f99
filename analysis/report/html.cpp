#include "analysis/report/html.h"

#include <cmath>

#include <fmt/format.h>

#include "analysis/report/internal/style.h"
#include "base/shown_text.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kPolicy = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";

std::string_view class_of(const HtmlTable::Column& column) {
  return column.is_number ? " class=\"n\"" : "";
}

/// The `<svg>` element of a file, without the text before it.
std::string_view element_of(std::string_view svg) {
  const std::size_t begin = svg.find("<svg");
  return begin == std::string_view::npos ? svg : svg.substr(begin);
}

/// A box that scrolls sideways, also by keyboard, because it can take the focus. `named` is the id
/// of its caption.
std::string scrolling(std::string_view named, std::string_view content) {
  return fmt::format(
      "<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-labelledby=\"{}\">{}</div>\n", named,
      content);
}

/// A table below its caption. The caption does not scroll with the table, so a phone shows all of
/// it.
std::string captioned(std::string_view id, std::string_view caption, std::string_view kind,
                      std::string_view content) {
  return fmt::format("<p class=\"caption\" id=\"{}\">{}</p>\n", id, html_escaped(caption)) +
         scrolling(id,
                   fmt::format("<table{} aria-labelledby=\"{}\">\n{}</table>", kind, id, content));
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (const char letter : as_shown(text)) {
    switch (letter) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += letter;
    }
  }
  return result;
}

std::string shown_number(double value) {
  constexpr double kExponentFrom = 1e7;
  constexpr double kNoDecimalsFrom = 1000;
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size < kNoDecimalsFrom || size >= kExponentFrom) return fmt::format("{:.4g}", value);
  return fmt::format("{:.0f}", value);
}

void HtmlPage::heading(int level, std::string_view text, bool listed) {
  const std::string anchor = next_id();
  text_ += fmt::format("<h{0} id=\"{1}\">{2}</h{0}>\n", level, anchor, html_escaped(text));
  if (listed) entries_.push_back({level, anchor, std::string(text)});
}

void HtmlPage::paragraph(std::string_view text) {
  text_ += fmt::format("<p>{}</p>\n", html_escaped(text));
}

void HtmlPage::facts(std::string_view caption,
                     const std::vector<std::pair<std::string, std::string>>& facts) {
  if (facts.empty()) return;
  std::string rows;
  for (const auto& [name, value] : facts) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", html_escaped(name),
                        html_escaped(value));
  }
  text_ += captioned(next_id(), caption, " class=\"facts\"", "<tbody>\n" + rows + "</tbody>");
}

void HtmlPage::table(const HtmlTable& table) {
  if (table.rows.empty()) return;
  std::string text = "<thead><tr>";
  for (const HtmlTable::Column& column : table.columns) {
    text +=
        fmt::format("<th scope=\"col\"{}>{}</th>", class_of(column), html_escaped(column.title));
  }
  text += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    text += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string_view kind = class_of(table.columns[i]);
      text += i == 0 ? fmt::format("<th scope=\"row\"{}>{}</th>", kind, html_escaped(row[i]))
                     : fmt::format("<td{}>{}</td>", kind, html_escaped(row[i]));
    }
    text += "</tr>\n";
  }
  text_ += captioned(next_id(), table.caption, "", text + "</tbody>");
}

void HtmlPage::picture(std::string_view svg, std::string_view caption) {
  const std::string id = next_id();
  text_ += fmt::format("<figure>{}<figcaption id=\"{}\">{}</figcaption></figure>\n",
                       scrolling(id, element_of(svg)), id, html_escaped(caption));
}

void HtmlPage::verbatim(std::string_view label, std::string_view text) {
  if (!label.empty()) paragraph(label);
  text_ += fmt::format("<pre>{}</pre>\n", html_escaped(text));
}

void HtmlPage::begin_chapter() {
  text_ += "<section class=\"chapter\">\n";
}

void HtmlPage::end_chapter() {
  text_ += "</section>\n";
}

void HtmlPage::begin_folded(std::string_view text, bool listed) {
  if (!listed) {
    text_ += fmt::format("<details class=\"small\">\n<summary>{}</summary>\n", html_escaped(text));
    return;
  }
  const std::string anchor = next_id();
  text_ += fmt::format("<details>\n<summary><h2 id=\"{}\">{}</h2></summary>\n", anchor,
                       html_escaped(text));
  entries_.push_back({2, anchor, std::string(text)});
}

void HtmlPage::end_folded() {
  text_ += "</details>\n";
}

void HtmlPage::begin_grid() {
  text_ += "<div class=\"grid\">\n";
}

void HtmlPage::end_grid() {
  text_ += "</div>\n";
}

void HtmlPage::links(std::string_view caption,
                     const std::vector<std::pair<std::string, std::string>>& texts_and_paths) {
  if (texts_and_paths.empty()) return;
  text_ += fmt::format("<p>{}</p>\n<ul class=\"links\">\n", html_escaped(caption));
  for (const auto& [text, path] : texts_and_paths) {
    text_ +=
        fmt::format("<li><a href=\"{}\">{}</a></li>\n", html_escaped(path), html_escaped(text));
  }
  text_ += "</ul>\n";
}

std::string HtmlPage::next_id() {
  return fmt::format("p{}", ++ids_);
}

std::string HtmlPage::finish(std::string_view title, std::string_view summary) const {
  std::string contents;
  for (const Entry& entry : entries_) {
    contents += fmt::format("<li{}><a href=\"#{}\">{}</a></li>\n",
                            entry.level > 2 ? " class=\"inner\"" : "", entry.anchor,
                            html_escaped(entry.text));
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<header>\n<h1>{}</h1>\n"
      "<p>{}</p>\n</header>\n<nav aria-label=\"Contents\"><ul>\n{}</ul></nav>\n<main>\n{}</main>\n"
      "</body>\n</html>\n",
      kPolicy, html_escaped(title), kReportStyle, html_escaped(title), html_escaped(summary),
      contents, text_);
}

}  // namespace swarmsmith
