#include <optional>

#include <fmt/format.h>

#include "analysis/comparison/internal/score_table.h"

namespace swarmsmith {
namespace {

/// A row of Friedman's table that may still be incomplete: values by name.
struct Block {
  std::string mission;
  std::map<std::string, double, NameOrder> values;
};

/// Ranks the blocks, in order, that have a value for all of `names`.
std::optional<ComparedRanks> ranked(const Names& names, const std::vector<Block>& blocks) {
  ComparedRanks ranks{.names = {names.begin(), names.end()}};
  std::vector<std::vector<double>> values;
  std::set<std::string> missions;
  for (const Block& block : blocks) {
    if (block.values.size() < names.size()) {
      ++ranks.incomplete;
      continue;
    }
    missions.insert(block.mission);
    values.emplace_back();
    for (const auto& [name, value] : block.values)
      values.back().push_back(value);
  }
  // One block has no spread of ranks, so it gives no half width.
  if (values.size() < 2) return std::nullopt;
  ranks.missions.assign(missions.begin(), missions.end());
  ranks.test = friedman_test(values);
  return ranks;
}

template <class Key>
std::vector<Block> in_order(const std::map<Key, Block>& blocks) {
  std::vector<Block> result;
  result.reserve(blocks.size());
  for (const auto& [key, block] : blocks)
    result.push_back(block);
  return result;
}

}  // namespace

void add_method_ranks(const ScoreTable& table, Comparison& comparison) {
  for (const std::string& source : names_in(table, &GroupKey::source)) {
    Names methods;
    std::map<std::string, Block> blocks;
    for (const auto& [key, designs] : table) {
      if (key.source != source) continue;
      methods.insert(key.method);
      Block& block = blocks[key.mission];
      block.mission = key.mission;
      // Each design has the same weight, however many runs it has; also with --per run
      // (docs/statistics.md, "Friedman's blocks").
      block.values[key.method] = mean_of(values_of(designs, ScoreUnit::Design));
    }
    if (methods.size() < 2) continue;
    if (auto ranks = ranked(methods, in_order(blocks))) {
      ranks->source = source;
      comparison.ranks.push_back(std::move(*ranks));
    } else {
      comparison.unranked.push_back(fmt::format(
          "{}: no ranks, since fewer than two missions have designs of every method; within "
          "a mission the tests of `compare` compare them",
          source));
      comparison.notes.push_back(comparison.unranked.back());
    }
  }
}

void add_source_ranks(const ScoreTable& table, Comparison& comparison) {
  const Names sources = names_in(table, &GroupKey::source);
  if (sources.size() < 2) return;
  std::map<DesignId, Block> blocks;
  for (const auto& [key, designs] : table) {
    for (const auto& [id, design] : designs) {
      blocks[id].mission = key.mission;
      blocks[id].values[key.source] = mean_of(design.scores);
    }
  }
  if (auto ranks = ranked(sources, in_order(blocks))) {
    comparison.ranks.push_back(std::move(*ranks));
  } else {
    comparison.unranked.emplace_back(
        "no ranks, since fewer than two designs have scores in every source");
    comparison.notes.push_back(comparison.unranked.back());
  }
}

}  // namespace swarmsmith
