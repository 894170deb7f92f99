#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "sim/control/reference_model.h"
#include "sim/mission/arena.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// Scores see positions of the robots' centres, instant by instant, and the floor; nothing else. A
/// simulator feeds one while it runs, a camera's trajectory is fed after the fact. Larger is
/// better.

/// Number of robots on floor of `color` at the end (thesis eq. 6.1).
struct RobotsOn {
  Rgb color{0, 0, 0};

  friend bool operator==(const RobotsOn&, const RobotsOn&) = default;
};

/// Minus the mean age of the tiles, summed over the control cycles (thesis eq. 6.2): `tiles` x
/// `tiles` squares over a centred square of side `side_m`, ages in cycles.
struct Coverage {
  int tiles = 10;
  double side_m = 2.50001;

  friend bool operator==(const Coverage&, const Coverage&) = default;
};

/// Sum over the robots of the reward of the colour they stand on at the end (thesis eq. 6.3,
/// table 6.1); a colour without a reward counts 0.
struct ColorReward {
  struct Reward {
    Rgb color;
    double reward = 0;

    friend bool operator==(const Reward&, const Reward&) = default;
  };
  std::vector<Reward> rewards;

  friend bool operator==(const ColorReward&, const ColorReward&) = default;
};

using ScoreRule = std::variant<RobotsOn, Coverage, ColorReward>;

/// Takes the positions of all robots at each global instant (every 0.1 s, first at 0.1 s) and says
/// the score of what it saw so far. Independent of the order of the robots.
class Scorer {
 public:
  /// `arena` with the patches of this run; copied.
  Scorer(const ScoreRule& rule, const Arena& arena);

  void observe(std::span<const Point> robots);
  double score() const;

 private:
  void visit_tiles(const Coverage& rule, std::span<const Point> robots);
  double coverage_score(const Coverage& rule) const;

  ScoreRule rule_;
  Arena arena_;
  std::vector<Point> last_;  ///< end scores read the last positions
  /// Coverage keeps, instead of ages, the instant at which each tile was last of age 0, and the sum
  /// of the ages up to those instants.
  std::vector<std::int64_t> visited_;
  std::int64_t instant_ = 0;
  std::int64_t age_sum_ = 0;
};

}  // namespace swarmsmith
