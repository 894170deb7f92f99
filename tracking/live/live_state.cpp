#include "tracking/live/live_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/plain_text.h"

namespace swarmsmith {

namespace {

using Json = nlohmann::ordered_json;

Json board_json(const std::optional<BoardProgress>& board) {
  if (!board) return {};
  return {{"seen", board->is_seen},
          {"views", board->views},
          {"ninths", board->ninths},
          {"coverage", board->coverage}};
}

}  // namespace

std::string live_state_json(const LiveState& state) {
  Json robots = Json::array();
  for (const LiveRobot& robot : state.robots) {
    Json each = {{"name", robot.name}, {"tag", robot.tag}, {"seen", robot.is_seen}};
    each["last_seen_s"] = robot.seen_s.has_value() ? Json(*robot.seen_s) : Json();
    if (robot.pose.has_value()) {
      each["x"] = robot.pose->x;
      each["y"] = robot.pose->y;
      each["theta"] = robot.pose->theta;
    }
    robots.push_back(each);
  }
  Json tags = Json::array();
  for (const OverlayTag& tag : state.tags)
    tags.push_back(tag.tag);
  const Json all = {
      {"frame", state.frame},
      {"time_s", state.time_s},
      {"frames_per_s", state.frames_per_s},
      {"delay_s", state.delay_s},
      {"most_delay_s", state.most_delay_s},
      {"dropped", state.dropped},
      {"camera_shift_px", state.camera_shift_px ? Json(*state.camera_shift_px) : Json()},
      {"board", board_json(state.board)},
      {"references_seen", state.references_seen},
      {"references", state.references},
      {"robots", robots},
      {"tags", tags},
      {"issues", state.issues}};
  // A robot's name may contain any bytes; invalid UTF-8 is replaced.
  return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string live_state_line(const LiveState& state) {
  const auto seen = std::count_if(state.robots.begin(), state.robots.end(),
                                  [](const LiveRobot& robot) { return robot.is_seen; });
  std::string line = fmt::format(
      "{:.1f} s, {:.1f} frames/s, delay {:.0f} ms (at most {:.0f}), robots {} of {}, dropped {}",
      state.time_s, state.frames_per_s, 1000 * state.delay_s, 1000 * state.most_delay_s, seen,
      state.robots.size(), state.dropped);
  if (state.board) {
    const auto reached = std::ranges::count_if(state.board->ninths, [](int n) { return n > 0; });
    line += fmt::format("; board: {}, {} of 9 ninths, {:.0f} % of the frame",
                        counted(state.board->views, "view"), reached, 100 * state.board->coverage);
  }
  if (!state.issues.empty()) line += "; " + state.issues.front();
  if (state.issues.size() > 1) line += fmt::format(" and {} more", state.issues.size() - 1);
  return line;
}

}  // namespace swarmsmith
