#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/mission/arena.h"
#include "sim/mission/scores/score_field.h"

namespace swarmsmith {

class MostOnScorer;

/// Number of robots on the patch of `color` that has the most: aggregation on any one of several
/// spots (epuck facts, section 6.3: two-spot aggregation, XOR). Each patch is counted separately,
/// even if others lie on top of it. The floor around the patches counts as one more spot if it has
/// the colour.
struct MostOn {
  static constexpr std::string_view kKind = "most_on";
  using Scorer = MostOnScorer;

  Rgb color{0, 0, 0};
  When at = When::End;
  bool share = false;

  template <class Rule, class Visitor>
  static void fields(Rule& rule, Visitor& field) {
    field({.key = "color",
           .meaning = "colour of the spots; the spot with the most robots counts",
           .required = true},
          rule.color);
    field(kAtField, rule.at);
    field({.key = "share", .meaning = "whether the score is divided by the number of robots"},
          rule.share);
  }
  std::string unit() const { return summed_unit(share ? "share of robots" : "robots", at); }
  friend bool operator==(const MostOn&, const MostOn&) = default;
};

class MostOnScorer {
 public:
  MostOnScorer(const MostOn& rule, const Arena& arena);

  void observe(const Positions& seen);
  double score() const;

 private:
  MostOn rule_;
  std::vector<Patch> spots_;
  std::vector<Patch> patches_;  ///< all patches, if the floor between them counts
  bool counts_floor_;
  std::size_t robots_ = 0;
  std::int64_t last_ = 0;  ///< robots on the fullest spot at the last instant
  std::int64_t sum_ = 0;
};

}  // namespace swarmsmith
