#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swarmsmith {

/// One race as a matrix: one row per candidate, one column per step; the colour of a cell is the
/// candidate's rank in the step.
struct RacePlot {
  struct Step {
    std::int64_t number = 0;  ///< counted through all iterations of the design
    std::string marker;       ///< v_race_steps.marker
    std::int64_t alive = 0;   ///< candidates before the test of the step
  };
  struct Cell {
    enum class State { Absent, Ranked, Rejected };
    State state = State::Absent;
    double part = 0;  ///< relative rank: 0 is the best of its step, 1 the worst
  };
  struct Row {
    std::string name;  ///< "c812"
    bool elite_before = false;
    bool elite_after = false;
    std::optional<std::size_t> dropped_after;  ///< column; empty if it survived to the end
    std::vector<Cell> cells;                   ///< one per step
  };

  std::string title;
  std::vector<std::string> details;
  std::string description;  ///< for readers who cannot see the picture
  std::vector<Step> steps;
  std::vector<Row> rows;  ///< from top to bottom
  double width_mm = 84;
};

/// The plot as SVG. The more cells, the smaller they are. If they would make the file too large,
/// several steps share one cell with their mean rank, and the figure says so.
std::string draw(const RacePlot& plot);

/// The meaning of a marker of v_race_steps, in a few words: "none dropped".
std::string_view meaning_of_marker(std::string_view marker);

}  // namespace swarmsmith
