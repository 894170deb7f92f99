#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace swarmsmith {

/// Scores that are shown together.
struct ScoreGroup {
  std::string name;       ///< below it, or in the legend
  std::size_t color = 0;  ///< groups of one colour have something in common
  std::vector<double> values;
};

/// Groups on one axis: of one mission, since the scores of others have other units.
struct ScorePanel {
  std::string title;  ///< the mission
  std::vector<ScoreGroup> groups;
};

}  // namespace swarmsmith
