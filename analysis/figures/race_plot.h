#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swarmsmith {

/// One race as a matrix: a row a candidate, a column a step, each cell coloured by the candidate's
/// rank in the step.
struct RacePlot {
  struct Step {
    std::int64_t number = 0;  ///< counted through all iterations of the design
    std::string marker;       ///< v_race_steps.marker
    std::int64_t alive = 0;   ///< candidates before the test of the step
  };
  struct Cell {
    enum class State { Absent, Ranked, Rejected };
    State state = State::Absent;
    double part = 0;  ///< of a ranked one: 0 was the best of its step, 1 the worst
  };
  struct Row {
    std::string name;  ///< "c812"
    bool elite_before = false;
    bool elite_after = false;
    std::optional<std::size_t> dropped_after;  ///< column; none for those that came to the end
    std::vector<Cell> cells;                   ///< one a step
  };

  std::string title;
  std::vector<std::string> details;
  std::string description;  ///< for readers who cannot see the picture
  std::vector<Step> steps;
  std::vector<Row> rows;  ///< from above
  double width_mm = 84;
};

/// As SVG. Cells shrink with their number; where they would make too large a file, columns of
/// several steps share the cell of their mean rank, and the figure says so.
std::string draw(const RacePlot& plot);

/// What a marker of v_race_steps says, in a few words: "none dropped".
std::string_view meaning_of_marker(std::string_view marker);

}  // namespace swarmsmith
