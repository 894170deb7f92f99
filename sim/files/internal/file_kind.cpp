#include "sim/files/internal/file_kind.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/text/document.h"
#include "sim/control/toml_kind.h"

namespace swarmsmith {
namespace {

using namespace std::string_view_literals;

constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kBeginnings = {{
    {"SQLite format 3\0"sv, "a store; `evaluate best STORE` runs the winners of one"},
    {"\x89PNG"sv, "a picture (PNG)"},
    {"\xff\xd8\xff"sv, "a picture (JPEG)"},
    {"GIF8"sv, "a picture (GIF)"},
    {"%PDF"sv, "a PDF"},
    {"PK\x03\x04"sv, "an archive (zip)"},
    {"\x1f\x8b"sv, "a compressed file (gzip)"},
    {"\xfd\x37zXZ"sv, "a compressed file (xz)"},
    {"\x7f\x45LF"sv, "a program"},
    {"RDX3\n"sv, "data of R"},
}};

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// Calls `use` with each line that is not blank or a comment, until it returns true.
template <class Use>
void each_line(std::string_view text, const Use& use) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line[first] == '#') continue;
    line = line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
    if (use(line)) return;
  }
}

std::string_view first_line(std::string_view text) {
  std::string_view found;
  each_line(text, [&](std::string_view line) {
    found = line;
    return true;
  });
  return found;
}

std::string kind_of_markup(std::string_view text) {
  if (contains(text, "<svg")) return "a picture (SVG)";
  if (contains(text, "<argos-configuration")) {
    return "an experiment of ARGoS; put its machine, the value of `fsm-config` or `bt-config`, "
           "into a file";
  }
  return contains(text, "<html") ? "a web page" : "XML";
}

/// Whether the line is a key at the top of a TOML file: `name = ...`.
bool is_assignment(std::string_view line) {
  const std::size_t end =
      line.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_");
  if (end == 0 || end == std::string_view::npos) return false;
  const std::size_t next = line.find_first_not_of(" \t", end);
  return next != std::string_view::npos && line[next] == '=';
}

std::string kind_of_toml(std::string_view text) {
  const auto document = parse_document(text, "");
  const auto kind = document ? toml_kind_of(*document) : std::nullopt;
  return kind ? std::string(words_of(*kind)) : "a TOML file";
}

}  // namespace

std::optional<std::string> foreign_kind(std::string_view bytes) {
  for (const auto& [beginning, kind] : kBeginnings) {
    if (bytes.starts_with(beginning)) return std::string(kind);
  }
  constexpr std::size_t kLooked = 4096;
  if (bytes.substr(0, kLooked).find('\0') != std::string_view::npos) return "a binary file";
  const std::string_view line = first_line(bytes);
  if (line.empty()) return std::nullopt;
  if (line.front() == '<') return kind_of_markup(bytes);
  if (line.front() == '{') return "JSON";
  const bool is_header = line.front() == '[' && line.back() == ']';
  if (is_header || (is_assignment(line) && !contains(line, "--"))) return kind_of_toml(bytes);
  const bool has_machine_column = std::ranges::any_of(
      std::array{"fsm"sv, "fsm_config"sv, "machine"sv}, [&](std::string_view name) {
        return line.ends_with("," + std::string(name)) ||
               line.starts_with(std::string(name) + ",") ||
               contains(line, "," + std::string(name) + ",");
      });
  if (has_machine_column) return "a table (CSV); `import FILE.csv --into STORE` reads it";
  return std::nullopt;
}

}  // namespace swarmsmith
