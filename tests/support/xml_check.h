#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swarmsmith {

/// What keeps a text from being well-formed XML, with the place; empty when nothing does. Knows
/// what our own writers write: a document type, elements, attributes in double quotes, the five
/// named entities; no comments, processing instructions or CDATA.
inline std::string xml_trouble(std::string_view text) {
  const auto near = [&](std::size_t at, const char* what) {
    return std::string(what) + " near: " + std::string(text.substr(at, 60));
  };
  const auto ends_entity = [&](std::size_t at) {
    for (const std::string_view known : {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;"})
      if (text.substr(at).starts_with(known)) return true;
    return false;
  };
  std::vector<std::string> open;
  std::size_t roots = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char letter = text[at];
    if (letter == '&' && !ends_entity(at)) return near(at, "a bare &");
    if (letter == '>') return near(at, "a bare >");
    if (letter != '<') {
      if (open.empty() && letter != '\n' && letter != ' ') return near(at, "text outside");
      continue;
    }
    bool quoted = false;
    std::size_t end = at + 1;
    for (; end < text.size() && (quoted || text[end] != '>'); ++end) {
      if (text[end] == '"') quoted = !quoted;
      if (text[end] == '<') return near(at, "a < within a tag");
      if (text[end] == '&' && !ends_entity(end)) return near(end, "a bare & in a tag");
    }
    if (end == text.size()) return near(at, "a tag without an end");
    const std::string_view tag = text.substr(at + 1, end - at - 1);
    const std::string name(tag.substr(0, tag.find_first_of(" \n/", 1)));
    if (tag.starts_with("!DOCTYPE")) {
      // nothing is open yet
    } else if (tag.starts_with('/')) {
      if (open.empty() || "/" + open.back() != tag) return near(at, "a wrong end");
      open.pop_back();
    } else {
      if (open.empty() && ++roots > 1) return near(at, "a second root");
      if (!tag.ends_with('/')) open.push_back(name);
    }
    at = end;
  }
  return open.empty() ? "" : "never closed: " + open.back();
}

}  // namespace swarmsmith
