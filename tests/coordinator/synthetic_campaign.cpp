#include "tests/coordinator/synthetic_campaign.h"

#include <algorithm>
#include <bit>

#include "base/hash.h"

namespace swarmsmith::cluster {

Truth truth_of(const CampaignShape& shape, const EvaluationKey& key) {
  const auto number = number_of(key.candidate);
  const auto design = design_of(key.candidate).value;
  if (shape.failing && design == 1 && number == 3 && key.pair == 2) {
    return {.kind = Truth::Kind::Fails};
  }
  if (shape.killing && design == shape.designs && number == 2 && key.pair == 3) {
    return {.kind = Truth::Kind::Kills};
  }
  const std::uint64_t bits = mix64(pack(key) + mix64(shape.seed));
  return {.kind = Truth::Kind::Score,
          .score = static_cast<double>(bits >> 40U) / 1000.0,
          .state_digest = mix64(bits)};
}

SyntheticCampaign::SyntheticCampaign(const CampaignShape& shape)
    : shape_(shape), races_(static_cast<std::size_t>(shape.designs)) {
  for (std::size_t design = 0; design < races_.size(); ++design) {
    for (int i = 1; i <= shape_.candidates; ++i)
      races_[design].alive.push_back(i);
    ask(design);
  }
}

EvaluationKey SyntheticCampaign::key_of(std::size_t design, std::int64_t candidate) const {
  const DesignId id{static_cast<std::int64_t>(design) + 1};
  return {candidate_id(id, candidate), Purpose::Race, races_[design].step};
}

std::vector<DesignId> SyntheticCampaign::unfinished() const {
  std::vector<DesignId> designs;
  for (std::size_t i = 0; i < races_.size() && !finished(); ++i)
    designs.push_back({static_cast<std::int64_t>(i) + 1});
  return designs;
}

void SyntheticCampaign::ask(std::size_t design) {
  Race& race = races_[design];
  if (race.step == shape_.steps) return;
  ++race.step;
  race.scores.clear();
  for (const std::int64_t candidate : race.alive) {
    const EvaluationKey key = key_of(design, candidate);
    asked_[pack(key)] = false;
    tasks_.push_back({{.seed = key.pair, .machine = "--nstates 1 --s0 1"}, key});
  }
}

void SyntheticCampaign::tell(const Outcome& outcome) {
  const auto asked = asked_.find(pack(outcome.key));
  if (asked == asked_.end()) {
    complaint_ = "told what was never asked";
    return;
  }
  if (std::exchange(asked->second, true)) {
    complaint_ = "told twice";
    return;
  }
  rows_.emplace_back(EvaluationRow{.key = outcome.key,
                                   .status = outcome.status,
                                   .measured = outcome.measured,
                                   .source = "test",
                                   .worker = outcome.worker,
                                   .attempt = outcome.attempt});
  const auto design = static_cast<std::size_t>(design_of(outcome.key.candidate).value - 1);
  put(design, outcome.key, outcome.status, outcome.measured.score);
}

void SyntheticCampaign::put(std::size_t design, const EvaluationKey& key, EvaluationStatus status,
                            double score) {
  Race& race = races_[design];
  const bool ok = status == EvaluationStatus::Ok;
  race.scores[number_of(key.candidate)] = ok ? std::optional(score) : std::nullopt;
  if (race.scores.size() == race.alive.size()) decide(design);
}

/// In the order of candidates, never in that of arrival.
void SyntheticCampaign::decide(std::size_t design) {
  Race& race = races_[design];
  race.log.append("step ").append(std::to_string(race.step)).append(":");
  std::vector<std::int64_t> left;
  for (const std::int64_t candidate : race.alive) {
    const std::optional<double> score = race.scores.at(candidate);
    race.log.append(" ").append(std::to_string(candidate)).append("=");
    race.log += score ? std::to_string(std::bit_cast<std::uint64_t>(*score)) : "rejected";
    if (!score) continue;
    race.sums[candidate] += *score;
    left.push_back(candidate);
  }
  race.log += "\n";
  if (race.step >= 2 && left.size() > 2) {
    left.erase(std::ranges::min_element(left, {}, [&](auto c) { return race.sums.at(c); }));
  }
  race.alive = std::move(left);
  RaceStepRow row;
  row.design = {static_cast<std::int64_t>(design) + 1};
  row.step = race.step;
  row.pair = race.step;
  rows_.emplace_back(std::move(row));
  ask(design);
}

std::vector<Task> SyntheticCampaign::take_tasks() {
  return std::exchange(tasks_, {});
}
std::vector<Row> SyntheticCampaign::take_rows() {
  return std::exchange(rows_, {});
}

bool SyntheticCampaign::finished() const {
  return std::ranges::all_of(races_, [&](const Race& race) {
    return race.step == shape_.steps && race.scores.size() >= race.alive.size();
  });
}

std::string SyntheticCampaign::dump() const {
  std::string out;
  for (const Race& race : races_)
    out += "race\n" + race.log;
  return out;
}

std::string undisturbed_dump(const CampaignShape& shape) {
  SyntheticCampaign campaign(shape);
  for (auto tasks = campaign.take_tasks(); !tasks.empty(); tasks = campaign.take_tasks()) {
    for (const Task& task : tasks) {
      const Truth truth = truth_of(shape, task.key);
      const bool ok = truth.kind == Truth::Kind::Score;
      campaign.tell({.key = task.key,
                     .status = ok ? EvaluationStatus::Ok : EvaluationStatus::Rejected,
                     .measured = {.score = truth.score, .state_digest = truth.state_digest}});
    }
  }
  return campaign.dump();
}

}  // namespace swarmsmith::cluster
