#include "coordinator/cli/instance_csv.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/math.h"
#include "base/suggestion.h"
#include "sim/mission/colors.h"

namespace swarmsmith::cli {
namespace {

/// No quotes: names and numbers need none.
std::vector<std::string_view> cells_of(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::vector<std::string_view> cells;
  for (std::size_t end = line.find(','); end != std::string_view::npos; end = line.find(',')) {
    cells.push_back(line.substr(0, end));
    line.remove_prefix(end + 1);
  }
  cells.push_back(line);
  return cells;
}

/// A row of a table, cells in the order of the columns that were asked for.
struct Line {
  std::vector<std::string_view> cells;
  std::string where;  ///< file:line

  template <class Number>
  Expected<Number> number(std::size_t cell) const {
    Number value{};
    const std::string_view text = cells[cell];
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    bool is_number = error == std::errc() && stop == end;
    if constexpr (std::is_floating_point_v<Number>) is_number = is_number && std::isfinite(value);
    if (is_number) return value;
    return bad_input("\"" + std::string(text) + "\" is no number", where);
  }
};

/// Where each wanted column is, by the headline.
Expected<std::vector<std::size_t>> find_columns(std::string_view headline,
                                                const std::vector<std::string>& wanted,
                                                const std::string& where) {
  const auto names = cells_of(headline);
  std::vector<std::size_t> found;
  for (const std::string& column : wanted) {
    std::size_t at = 0;
    while (at < names.size() && names[at] != column)
      ++at;
    if (at == names.size()) {
      return bad_input("there is no column `" + column + "`; wanted are: " + joined(wanted), where);
    }
    found.push_back(at);
  }
  return found;
}

/// Calls `on_line` for each row below the headline, until it fails.
Expected<void> read_table(const std::filesystem::path& file,
                          const std::vector<std::string>& columns,
                          const std::function<Expected<void>(const Line&)>& on_line) {
  std::ifstream stream(file);
  std::error_code trouble;
  if (std::filesystem::is_directory(file, trouble)) {
    return bad_input("this is a folder; a table is a file", file.string());
  }
  if (!stream) return unexpected(ErrorKind::NotFound, "there is no such file", file.string());
  std::string text;
  std::getline(stream, text);
  const auto found = find_columns(text, columns, file.string() + ":1");
  if (!found) return Unexpected(found.error());
  for (int number = 2; std::getline(stream, text); ++number) {
    if (text.empty()) continue;
    const auto cells = cells_of(text);
    Line line{{}, file.string() + ":" + std::to_string(number)};
    for (const std::size_t column : *found) {
      if (column >= cells.size()) return bad_input("the line is too short", line.where);
      line.cells.push_back(cells[column]);
    }
    if (auto read = on_line(line); !read) return read;
  }
  return {};
}

/// The mission's place around a point given to the millimetre.
const Rectangle* place_at(const Mission& mission, Point centre) {
  constexpr double kTolerance_m = 0.001;
  for (const Rectangle& place : mission.shuffled.places) {
    const bool near = std::abs(place.centre.x - centre.x) < kTolerance_m &&
                      std::abs(place.centre.y - centre.y) < kTolerance_m;
    if (near) return &place;
  }
  return nullptr;
}

}  // namespace

Expected<std::map<std::int64_t, std::vector<Pose>>> read_starts(const std::filesystem::path& file) {
  std::map<std::int64_t, std::vector<Pose>> starts;
  const auto read = read_table(
      file, {"seed", "robot", "x", "y", "theta"}, [&](const Line& line) -> Expected<void> {
        const auto seed = line.number<std::int64_t>(0);
        const auto robot = line.number<std::size_t>(1);
        const auto x = line.number<double>(2);
        const auto y = line.number<double>(3);
        const auto theta = line.number<double>(4);
        for (const auto* number : {&x, &y, &theta}) {
          if (!*number) return Unexpected(number->error());
        }
        if (!seed) return Unexpected(seed.error());
        std::vector<Pose>& poses = starts[*seed];
        if (!robot || *robot != poses.size()) {
          return bad_input("robots of a seed are numbered 0, 1, ... in this order", line.where);
        }
        poses.push_back({*x, *y, wrap_angle(*theta)});
        return {};
      });
  if (!read) return Unexpected(read.error());
  return starts;
}

Expected<std::map<std::int64_t, std::vector<Patch>>> read_patches(const std::filesystem::path& file,
                                                                  const Mission& mission) {
  std::map<std::int64_t, std::vector<Patch>> patches;
  const auto read =
      read_table(file, {"seed", "x", "y", "color"}, [&](const Line& line) -> Expected<void> {
        const auto seed = line.number<std::int64_t>(0);
        const auto x = line.number<double>(1);
        const auto y = line.number<double>(2);
        if (!seed) return Unexpected(seed.error());
        for (const auto* number : {&x, &y}) {
          if (!*number) return Unexpected(number->error());
        }
        const auto color = color_from_name(line.cells[3]);
        if (!color) {
          return bad_input("there is no colour \"" + std::string(line.cells[3]) + "\"", line.where);
        }
        const Rectangle* place = place_at(mission, {*x, *y});
        if (place == nullptr) {
          return bad_input("mission " + mission.name + " has no place for a patch there",
                           line.where);
        }
        patches[*seed].push_back({*place, *color});
        return {};
      });
  if (!read) return Unexpected(read.error());
  return patches;
}

}  // namespace swarmsmith::cli
