#include "coordinator/campaign/internal/score_text.h"

#include <string>
#include <variant>

#include "base/overloaded.h"
#include "coordinator/campaign/internal/color_text.h"
#include "coordinator/campaign/internal/table_reader.h"

namespace swarmsmith {
namespace {

/// The inline table `rewards`, in the rule's own order.
std::string rewards_text(const ColorReward& rule) {
  std::string text;
  for (const ColorReward::Reward& reward : rule.rewards) {
    text +=
        (text.empty() ? "" : ", ") + color_key(reward.color) + " = " + number_text(reward.reward);
  }
  return "{ " + text + " }";
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
