#pragma once

#include <vector>

#include "irace_core/parameter_space.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// algorithm, alpha, ants and, for one algorithm alone, q0.
inline ParameterSpace ant_space() {
  std::vector<Parameter> parameters(4);
  parameters[0] = {"algorithm", "--", Categorical{{"as", "mmas", "eas"}}, {}};
  parameters[1] = {"alpha", "--alpha ", Real{0.0, 5.0}, {}};
  parameters[2] = {"ants", "--ants ", Integer{5.0, 100.0}, {}};
  parameters[3] = {"q0", "--q0 ", Real{0.0, 1.0}, {}};
  return *ParameterSpace::make(std::move(parameters));
}

inline const DesignId kOne{1};

inline CandidateRow ant_candidate(std::int64_t number, std::int64_t parent, std::string parameters,
                                  std::string command_line) {
  return {.id = candidate_id(kOne, number),
          .iteration = 1,
          .parent = parent > 0 ? candidate_id(kOne, parent) : CandidateId{},
          .parameters = std::move(parameters),
          .machine = std::move(command_line),
          .modules = {}};
}

inline RaceStepRow ant_step(std::int64_t step, std::int64_t iteration, std::int64_t best,
                            double cost, std::int64_t used) {
  RaceStepRow row;
  row.design = kOne;
  row.step = step;
  row.iteration = iteration;
  row.pair = step;
  row.marker = 'x';
  row.evaluated = 2;
  row.alive_before = 3;
  row.alive_after = 2;
  row.best = candidate_id(kOne, best);
  row.mean_best = -cost;
  row.used = used;
  return row;
}

/// A run of two races; the second one has begun.
inline std::vector<Row> ant_rows() {
  const IterationRow first{.design = kOne, .number = 1, .of = 2, .budget = 10, .configurations = 3};
  IterationRow second = first;
  second.number = 2;
  second.configurations = 2;
  second.soft_restart = true;
  return {
      first,
      ant_candidate(1, 0, R"({"algorithm":"mmas","alpha":3.8452,"ants":93,"q0":0.8626})",
                    "--mmas --alpha 3.8452 --ants 93 --q0 0.8626"),
      ant_candidate(2, 0, R"({"algorithm":"eas","alpha":3.5,"ants":17})",
                    "--eas --alpha 3.5 --ants 17"),
      ant_candidate(3, 0, R"({"algorithm":"as","alpha":1,"ants":5})", "--as --alpha 1 --ants 5"),
      ant_step(1, 1, 1, 14.5, 3),
      DesignStateRow{.design = kOne,
                     .state = DesignState::Racing,
                     .used = 3,
                     .iteration = 1,
                     .best = candidate_id(kOne, 1),
                     .best_mean = -14.5,
                     .reason = {}},
      ant_step(2, 1, 2, 9.4, 5),
      EliteRow{.design = kOne,
               .iteration = 1,
               .rank = 1,
               .candidate = candidate_id(kOne, 2),
               .mean = -9.4,
               .runs = 2},
      EliteRow{.design = kOne,
               .iteration = 1,
               .rank = 2,
               .candidate = candidate_id(kOne, 1),
               .mean = -11,
               .runs = 2},
      DesignStateRow{.design = kOne,
                     .state = DesignState::Racing,
                     .used = 5,
                     .iteration = 1,
                     .best = candidate_id(kOne, 2),
                     .best_mean = -9.4,
                     .reason = {}},
      second,
      ant_candidate(4, 2, R"({"algorithm":"mmas","alpha":0.25,"ants":100,"q0":1})",
                    "--mmas --alpha 0.25 --ants 100 --q0 1"),
      ant_step(3, 2, 4, 2, 7)};
}

}  // namespace swarmsmith::cli
