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

/// One design for each value, with the numbers `first` and on.
inline std::vector<Scored> designs_of(const std::string& method, const std::vector<double>& values,
                                      std::int64_t first = 1) {
  std::vector<Scored> designs;
  for (const double value : values) {
    const auto before = static_cast<std::int64_t>(designs.size());
    designs.push_back(
        {.design = first + before, .method = method, .repetition = before + 1, .scores = {value}});
  }
  return designs;
}

/// The same with the designs of a second method.
inline std::vector<Scored> two_methods(const std::vector<double>& first,
                                       const std::vector<double>& second) {
  std::vector<Scored> designs = designs_of("first", first);
  for (const Scored& design : designs_of("second", second, 1001))
    designs.push_back(design);
  return designs;
}

/// The same designs under the profile rvr and on the robots, one score in each.
inline std::vector<Scored> on_robots_too(const std::vector<double>& simulated,
                                         const std::vector<double>& real) {
  std::vector<Scored> designs = designs_of("watermelon", simulated);
  for (Scored design : designs_of("watermelon", real)) {
    design.source = "real";
    designs.push_back(design);
  }
  return designs;
}

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
