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
  std::string method{};  ///< of the scores, where they have only one
  std::string source{};
  bool narrow = false;  ///< the first of a pair of boxes, which have one name
};

/// Two values of one thing, in two groups.
struct ScoreLink {
  std::size_t from = 0;  ///< places of the groups
  std::size_t to = 0;
  std::size_t from_value = 0;  ///< places of the values in them
  std::size_t to_value = 0;
};

/// Groups on one axis: of one mission, since the scores of others have other units.
struct ScorePanel {
  std::string title;  ///< the mission
  std::vector<ScoreGroup> groups;
  std::vector<ScoreLink> links{};  ///< lines between the points
};

}  // namespace swarmsmith
