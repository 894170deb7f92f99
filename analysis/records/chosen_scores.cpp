#include "analysis/records/chosen_scores.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "analysis/statistics/summary.h"
#include "base/plain_text.h"

namespace swarmsmith {
namespace {

using Place = std::pair<std::string, std::string>;  // mission, source

bool is_of_campaign(const DesignScore& score) {
  return score.purpose == "test" || score.is_transfer;
}

void keep(std::vector<DesignScore>& scores, const std::string& purpose) {
  if (purpose == "all") return;
  std::set<Place> tested;
  for (const DesignScore& score : scores) {
    if (is_of_campaign(score)) tested.insert({score.mission, score.source});
  }
  std::erase_if(scores, [&](const DesignScore& score) {
    if (!purpose.empty()) return score.purpose != purpose;
    // Tests and later evaluations are not mixed in one mission and source, because an occasional
    // `evaluate best` must not change the figures of a campaign (docs/figures.md, "box").
    return !is_of_campaign(score) && tested.contains({score.mission, score.source});
  });
}

bool has_designs_to_compare(const std::vector<DesignScore>& scores) {
  std::map<std::tuple<std::string, std::string, std::string>, DesignId> first;
  return std::ranges::any_of(scores, [&](const DesignScore& score) {
    const auto known =
        first.try_emplace({score.mission, score.method, score.source}, score.design).first;
    return known->second != score.design;
  });
}

/// The origin of the scores, in words.
std::string purposes_of(const std::vector<DesignScore>& scores) {
  if (std::ranges::all_of(scores, is_of_campaign)) return "tests";
  return std::ranges::any_of(scores, is_of_campaign) ? "tests or later runs" : "later runs";
}

}  // namespace

ChosenScores chosen(std::vector<DesignScore> scores, const ScoreChoice& choice) {
  keep(scores, choice.purpose);
  ChosenScores result{.scores = std::move(scores)};
  result.unit = choice.unit.value_or(has_designs_to_compare(result.scores) ? ScoreUnit::Design
                                                                           : ScoreUnit::Run);
  const std::string runs = purposes_of(result.scores);
  result.said = result.unit == ScoreUnit::Design ? "a value is a design: the mean of its " + runs
                                                 : "a value is a run, out of the designs' " + runs;
  return result;
}

std::vector<ScoreValue> values_of(const ChosenScores& taken) {
  std::vector<ScoreValue> values;
  std::map<std::pair<DesignId, std::string>, std::size_t> places;
  for (const DesignScore& score : taken.scores) {
    const auto [place, is_new] = places.try_emplace({score.design, score.source}, values.size());
    if (is_new || taken.unit == ScoreUnit::Run) {
      values.push_back({.score = score, .runs = {score.score}});
      continue;
    }
    ScoreValue& value = values[place->second];
    value.runs.push_back(score.score);
    if (value.score.purpose != score.purpose) value.score.purpose = "all";
  }
  for (ScoreValue& value : values)
    value.score.score = mean_of(value.runs);
  return values;
}

std::optional<std::string> seeds_differ(const std::vector<DesignScore>& scores,
                                        const std::string& first, const std::string& second) {
  constexpr std::string_view kRobots = "real";
  if (first == kRobots || second == kRobots) return std::nullopt;
  using Seeds = std::multiset<std::pair<std::int64_t, std::int64_t>>;  // instance and seed
  std::map<DesignId, std::pair<Seeds, Seeds>> designs;
  for (const DesignScore& score : scores) {
    if (score.source != first && score.source != second) continue;
    auto& [of_first, of_second] = designs[score.design];
    if (score.seed != 0)
      (score.source == first ? of_first : of_second).insert({score.instance, score.seed});
  }
  std::size_t paired = 0;
  std::size_t different = 0;
  for (const auto& [design, seeds] : designs) {
    // Imported scores may have no seeds, which says nothing about a difference.
    if (seeds.first.empty() || seeds.second.empty()) continue;
    ++paired;
    different += seeds.first != seeds.second ? 1U : 0U;
  }
  if (different == 0) return std::nullopt;
  return fmt::format(
      "the seeds of {} and {} differ in {} of {}, so part of the difference may come from "
      "the seeds",
      first, second, different, counted(paired, "design"));
}

}  // namespace swarmsmith
