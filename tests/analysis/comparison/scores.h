#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/records/records.h"

namespace swarmsmith {

/// Scores of a design's winner in a source, on the seeds `first_seed` and on.
struct Scored {
  std::int64_t design = 1;
  std::string mission = "aggregation";
  std::string method = "watermelon";
  std::int64_t repetition = 1;
  std::string source = "rvr";
  std::vector<double> scores;
  std::string purpose = "test";
  std::int64_t first_seed = 1;
};

inline std::vector<DesignScore> records_of(const std::vector<Scored>& designs) {
  std::vector<DesignScore> records;
  for (const Scored& design : designs) {
    for (std::size_t i = 0; i < design.scores.size(); ++i) {
      const auto number = static_cast<std::int64_t>(i + 1);
      records.push_back({.design = {design.design},
                         .mission = design.mission,
                         .method = design.method,
                         .repetition = design.repetition,
                         .candidate = {(design.design - 1) * 1'000'000 + 7},
                         .source = design.source,
                         .purpose = design.purpose,
                         .pair = number,
                         .instance = 1,
                         .seed = design.first_seed + number - 1,
                         .score = design.scores[i]});
    }
  }
  return records;
}

}  // namespace swarmsmith
