#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace swarmsmith {

/// Scores that are shown as one group.
struct ScoreGroup {
  std::string name;       ///< below the box, or in the legend
  std::size_t color = 0;  ///< groups of the same colour have something in common
  std::vector<double> values;
  std::string method{};  ///< of the scores, if they have only one
  std::string source{};
  bool narrow = false;  ///< the first box of a pair with the same name
};

/// Two values that belong together, in two groups.
struct ScoreLink {
  std::size_t from = 0;  ///< indices of the groups
  std::size_t to = 0;
  std::size_t from_value = 0;  ///< indices of the values within the groups
  std::size_t to_value = 0;
};

/// Groups with a common axis: all of one mission, because scores of other missions have other
/// units.
struct ScorePanel {
  std::string title;  ///< the mission
  std::vector<ScoreGroup> groups;
  std::vector<ScoreLink> links{};  ///< lines between points
};

}  // namespace swarmsmith
