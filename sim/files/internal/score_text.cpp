#include "sim/files/internal/score_text.h"

#include <variant>

#include "base/overloaded.h"
#include "sim/files/color_text.h"
#include "sim/files/internal/arena_text.h"

namespace swarmsmith {
namespace {

/// The inline table `rewards`, in the rule's own order.
std::string rewards_text(const ColorReward& rule) {
  return "{ " +
         list_of(rule.rewards,
                 [](const ColorReward::Reward& reward) {
                   return color_key(reward.color) + " = " + number_text(reward.reward);
                 }) +
         " }";
}

}  // namespace

std::vector<SectionLine> score_lines(const ScoreRule& rule) {
  return std::visit(
      Overloaded{
          [](const RobotsOn& robots) -> std::vector<SectionLine> {
            return {{"kind", "\"robots_on\""}, {"color", quoted_text(color_text(robots.color))}};
          },
          [](const Coverage& coverage) -> std::vector<SectionLine> {
            return {{"kind", "\"coverage\""},
                    {"tiles", std::to_string(coverage.tiles)},
                    {"side", number_text(coverage.side_m)}};
          },
          [](const ColorReward& reward) -> std::vector<SectionLine> {
            return {{"kind", "\"color_reward\""}, {"rewards", rewards_text(reward)}};
          }},
      rule);
}

}  // namespace swarmsmith
