#include "tests/support/synthetic_campaign.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "base/rng.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kElites = 3;

/// Makes one design's rows, step by step.
class SyntheticDesign {
 public:
  SyntheticDesign(const SyntheticSize& size, DesignId id, const Rng& rng,
                  std::vector<std::vector<Row>>& out)
      : size_(size), id_(id), rng_(rng), out_(out) {}

  void make() {
    for (iteration_ = 1; iteration_ <= size_.iterations; ++iteration_)
      make_iteration();
    test_winner();
  }

 private:
  void make_iteration();
  void make_step(std::int64_t of_iteration);
  void drop_worst(std::vector<Row>& batch, std::size_t keep, const char* reason);
  void name_elites();
  void test_winner();
  CandidateRow candidate();
  EvaluationRow evaluation(EvaluationKey key, std::int64_t iteration);
  double mean(CandidateId id) const {
    const CandidateTotalsRow& t = totals_.at(id.value);
    return t.score_sum / static_cast<double>(t.runs);
  }

  SyntheticSize size_;
  DesignId id_;
  Rng rng_;
  std::vector<std::vector<Row>>& out_;
  std::int64_t iteration_ = 0, made_ = 0, step_ = 0, pair_ = 0, used_ = 0;
  std::vector<CandidateId> alive_;  ///< best first after a step
  std::map<std::int64_t, CandidateTotalsRow> totals_;
};

/// Adds a parameter to a candidate's texts: `token` is what a choice is in the machine's text.
void add_parameter(CandidateRow& row, const std::string& name, const std::string& control,
                   const std::string& value, const std::string& token) {
  row.parameters += fmt::format("{}\"{}\":{}", row.parameters.size() > 1 ? "," : "", name, value);
  row.machine += fmt::format("{}--{} {}", row.machine.empty() ? "" : " ", control, token);
}

/// A machine of up to four states with as many transitions, told as the watermelon flavour tells
/// its own (coordinator/campaign/machine_space.cpp).
CandidateRow SyntheticDesign::candidate() {
  constexpr std::array kBehaviours{"exploration", "stop", "attraction", "repulsion"};
  constexpr std::array kConditions{"black_floor",
                                   "gray_floor",
                                   "white_floor",
                                   "neighbour_count",
                                   "inverted_neighbour_count",
                                   "fixed_probability"};
  CandidateRow row;
  row.id = candidate_id(id_, ++made_);
  row.iteration = iteration_;
  if (iteration_ > 1) row.parent = alive_.front();
  row.states = rng_.uniform_int(1, 4);
  row.parameters = "{";
  std::array<int, kBehaviours.size()> behaving{};
  std::array<int, kConditions.size()> conditional{};
  const auto number = [&](const std::string& name, const std::string& control, auto value) {
    add_parameter(row, name, control, fmt::format("{}", value), fmt::format("{}", value));
  };
  const auto choice = [&](const std::string& name, const std::string& control, const char* what,
                          std::size_t token) {
    add_parameter(row, name, control, fmt::format("\"{}\"", what), std::to_string(token));
  };
  const auto hundredths = [&](std::int64_t most) {
    return static_cast<double>(rng_.uniform_int(0, most)) / 100.0;
  };
  number("NumStates", "nstates", row.states);
  for (std::int64_t i = 0; i < row.states; ++i) {
    const std::size_t behaviour = rng_.below(kBehaviours.size());
    const std::string at = std::to_string(i);
    ++behaving[behaviour];
    choice("S" + at, "s" + at, kBehaviours[behaviour], behaviour);
    if (behaviour == 0) number("RWM" + at, "rwm" + at, rng_.uniform_int(1, 100));
    if (behaviour == 2) number("ATT" + at, "att" + at, hundredths(500));
    if (behaviour == 3) number("REP" + at, "rep" + at, hundredths(500));
    if (row.states == 1) break;
    const std::int64_t ways = rng_.uniform_int(1, 4);
    number("NumConnections" + at, "n" + at, ways);
    for (std::int64_t j = 0; j < ways; ++j) {
      const std::size_t condition = rng_.below(kConditions.size());
      const std::string way = fmt::format("{}x{}", i, j);
      ++conditional[condition], ++row.transitions;
      number("N" + way, "n" + way, rng_.uniform_int(0, row.states - 2));
      choice("C" + way, "c" + way, kConditions[condition], condition);
      if (condition == 3 || condition == 4) {
        const std::string inverted = condition == 4 ? "I" : "";
        number("B" + inverted + way, "p" + way, rng_.uniform_int(0, 10));
        number("W" + inverted + way, "w" + way, hundredths(2000));
      } else {
        number("P" + way, "p" + way, hundredths(100));
      }
    }
  }
  row.parameters += "}";
  const auto count = [&](const char* module, int times) {
    if (times > 0)
      row.modules += fmt::format("{}\"{}\":{}", row.modules.empty() ? "{" : ",", module, times);
  };
  for (std::size_t i = 0; i < kBehaviours.size(); ++i)
    count(kBehaviours[i], behaving[i]);
  for (std::size_t i = 0; i < kConditions.size(); ++i)
    count(kConditions[i], conditional[i]);
  row.modules += "}";
  return row;
}

EvaluationRow SyntheticDesign::evaluation(EvaluationKey key, std::int64_t iteration) {
  EvaluationRow row{.key = key, .iteration = iteration, .source = "rvr"};
  const Rng own =
      rng_.split("evaluation", static_cast<std::uint64_t>(key.candidate.value * 1000 + key.pair));
  Rng draw = own;
  row.measured.state_digest = draw.next();
  row.measured.score =
      draw.uniform() < 0.5 ? draw.normal(3, 1) : static_cast<double>(draw.below(500));
  if (draw.bernoulli(0.001)) {
    row.status = EvaluationStatus::Rejected;
    row.measured.score = 0;
  }
  row.measured.wall_us = draw.uniform_int(200, 900);
  row.worker = draw.uniform_int(1, 4);
  return row;
}

void SyntheticDesign::drop_worst(std::vector<Row>& batch, std::size_t keep, const char* reason) {
  std::stable_sort(alive_.begin(), alive_.end(),
                   [this](CandidateId a, CandidateId b) { return mean(a) > mean(b); });
  for (std::size_t i = std::min(keep, alive_.size()); i < alive_.size(); ++i) {
    batch.push_back(EliminationRow{.candidate = alive_[i],
                                   .iteration = iteration_,
                                   .step = step_,
                                   .rank_sum = static_cast<double>(i) * 1.5,
                                   .reason = reason});
  }
  alive_.resize(std::min(keep, alive_.size()));
}

void SyntheticDesign::make_step(std::int64_t of_iteration) {
  ++step_;
  ++pair_;
  std::vector<Row> batch;
  batch.push_back(PairRow{.design = id_,
                          .purpose = Purpose::Race,
                          .number = pair_,
                          .instance = 1 + pair_ % 3,
                          .seed = rng_.uniform_int(1, 2147483647)});
  const auto before = static_cast<std::int64_t>(alive_.size());
  for (const CandidateId id : alive_) {
    const EvaluationRow row = evaluation({id, Purpose::Race, pair_}, iteration_);
    CandidateTotalsRow& totals = totals_[id.value];
    totals.candidate = id;
    ++totals.runs;
    totals.score_sum += row.measured.score;
    totals.score_squares += row.measured.score * row.measured.score;
    batch.emplace_back(row);
    batch.emplace_back(totals);
  }
  used_ += before;
  const bool test = of_iteration >= size_.first_drop;
  const auto keep =
      static_cast<std::size_t>(std::ceil(static_cast<double>(before) * size_.survive));
  drop_worst(batch, test ? std::max(keep, kElites) : alive_.size(), "test");
  RaceStepRow step;
  step.design = id_;
  step.step = step_;
  step.iteration = iteration_;
  step.pair = pair_;
  step.marker = test ? '-' : 'x';
  step.evaluated = before;
  step.alive_before = before;
  step.alive_after = static_cast<std::int64_t>(alive_.size());
  step.best = alive_.front();
  step.mean_best = mean(alive_.front());
  step.used = used_;
  if (test) step.p_value = rng_.uniform();
  step.digest = rng_.next();
  batch.emplace_back(step);
  out_.push_back(std::move(batch));
}

void SyntheticDesign::name_elites() {
  std::vector<Row> batch;
  drop_worst(batch, kElites, "not kept");
  for (std::size_t i = 0; i < alive_.size(); ++i) {
    batch.push_back(EliteRow{.design = id_,
                             .iteration = iteration_,
                             .rank = static_cast<std::int64_t>(i + 1),
                             .candidate = alive_[i],
                             .mean = mean(alive_[i]),
                             .runs = totals_.at(alive_[i].value).runs});
  }
  batch.push_back(DesignStateRow{.design = id_,
                                 .state = DesignState::Racing,
                                 .used = used_,
                                 .iteration = iteration_,
                                 .best = alive_.front(),
                                 .best_mean = mean(alive_.front()),
                                 .reason = {}});
  out_.push_back(std::move(batch));
}

void SyntheticDesign::make_iteration() {
  std::vector<Row> batch;
  batch.push_back(IterationRow{.design = id_,
                               .number = iteration_,
                               .of = size_.iterations,
                               .budget = 1000,
                               .configurations = size_.candidates,
                               .elites = static_cast<std::int64_t>(alive_.size()),
                               .model_digest = rng_.next()});
  std::vector<CandidateId> made;
  for (std::int64_t i = 0; i < size_.candidates; ++i) {
    const CandidateRow row = candidate();
    made.push_back(row.id);
    batch.emplace_back(row);
  }
  alive_.insert(alive_.end(), made.begin(), made.end());
  out_.push_back(std::move(batch));
  for (std::int64_t step = 1; step <= size_.steps; ++step)
    make_step(step);
  name_elites();
}

void SyntheticDesign::test_winner() {
  std::vector<Row> batch;
  for (std::int64_t number = 1; number <= size_.tests; ++number) {
    batch.push_back(PairRow{.design = id_,
                            .purpose = Purpose::Test,
                            .number = number,
                            .instance = 1,
                            .seed = rng_.uniform_int(1, 2147483647)});
    batch.emplace_back(evaluation({alive_.front(), Purpose::Test, number}, 0));
  }
  batch.push_back(DesignStateRow{.design = id_,
                                 .state = DesignState::Finished,
                                 .used = used_,
                                 .iteration = size_.iterations,
                                 .best = alive_.front(),
                                 .best_mean = mean(alive_.front()),
                                 .reason = "budget used"});
  out_.push_back(std::move(batch));
}

}  // namespace

SyntheticCampaign synthetic_header(const SyntheticSize& size, std::uint64_t seed) {
  SyntheticCampaign made;
  made.campaign = {.name = "synthetic",
                   .digest = fmt::format("{:032x}", seed),
                   .deciding = fmt::format(R"({{"seed":{},"race":{{"budget":100000}}}})", seed),
                   .file = "name = \"synthetic\"\n",
                   .seed = static_cast<std::int64_t>(seed)};
  for (std::int64_t number = 1; number <= size.designs; ++number) {
    made.designs.push_back({.id = {number},
                            .mission = number % 2 == 1 ? "aggregation" : "color_selection",
                            .method = "watermelon",
                            .flavour = "watermelon",
                            .repetition = (number + 1) / 2,
                            .seed = number * 17,
                            .budget = 100000});
  }
  return made;
}

std::vector<std::vector<Row>> synthetic_design(const SyntheticSize& size, DesignId id,
                                               std::uint64_t seed) {
  std::vector<std::vector<Row>> batches;
  const Rng rng = Rng(seed).split("design", static_cast<std::uint64_t>(id.value));
  SyntheticDesign(size, id, rng, batches).make();
  return batches;
}

SyntheticCampaign synthetic_campaign(const SyntheticSize& size, std::uint64_t seed) {
  SyntheticCampaign made = synthetic_header(size, seed);
  for (const DesignRow& design : made.designs)
    std::ranges::move(synthetic_design(size, design.id, seed), std::back_inserter(made.batches));
  made.batches.push_back({CampaignStateRow{.state = "finished"}});
  return made;
}

}  // namespace swarmsmith
