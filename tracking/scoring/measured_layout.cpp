#include "tracking/scoring/measured_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/median.h"
#include "sim/files/color_text.h"
#include "sim/mission/polygon.h"
#include "tracking/rig/issue.h"
#include "tracking/scoring/internal/color_match.h"
#include "tracking/scoring/internal/floor_light.h"

namespace swarmsmith {
namespace {

/// With a smaller confidence, the best colour is hardly better than the second best.
constexpr double kLeastConfidence = 0.35;
/// Neighbouring colours of the labeler are 1 apart; a measured colour farther away than this
/// matches none.
constexpr double kMostDistance = 0.6;

Unexpected missing(const std::string& text, const Mission& mission) {
  return Unexpected(error_of(IssueCode::LayoutMissing,
                             text + "; say the patches in the run log ([[patch]])", mission.name));
}

std::string ratio_text(const std::array<double, 3>& ratio) {
  return fmt::format("red {:.2f}, green {:.2f}, blue {:.2f} of the floor around it", ratio[0],
                     ratio[1], ratio[2]);
}

/// The median over the pictures, channel by channel.
std::array<double, 3> median_ratio(const std::vector<std::array<double, 3>>& ratios) {
  std::array<double, 3> medians{};
  for (std::size_t channel = 0; channel < medians.size(); ++channel) {
    std::vector<double> values;
    values.reserve(ratios.size());
    for (const auto& ratio : ratios)
      values.push_back(ratio.at(channel));
    medians.at(channel) = upper_median(std::move(values));
  }
  return medians;
}

/// Whether some of the places have no patch.
bool has_bare_places(const Mission& mission) {
  std::size_t patches = 0;
  for (const ShuffledPatches::Share& share : mission.shuffled.shares)
    patches += static_cast<std::size_t>(share.count);
  return patches < mission.shuffled.places.size();
}

/// The mission's colours, and the colour of its floor.
std::vector<Rgb> candidates_of(const Mission& mission) {
  std::vector<Rgb> colors;
  for (const ShuffledPatches::Share& share : mission.shuffled.shares)
    colors.push_back(share.color);
  colors.push_back(mission.arena.floor);
  return colors;
}

Expected<MeasuredPatch> measured_patch(const Rectangle& place,
                                       const std::vector<std::array<double, 3>>& ratios,
                                       const Mission& mission) {
  const std::string where = "the patch at " + point_text(place.centre);
  if (ratios.empty()) {
    return missing(where + " cannot be measured: it is in no picture, or always hidden by a robot",
                   mission);
  }
  MeasuredPatch patch{
      .place = place, .ratio = median_ratio(ratios), .pictures = static_cast<int>(ratios.size())};
  const ColorMatch match = nearest_color(patch.ratio, candidates_of(mission), mission.arena.floor);
  patch.color = match.best;
  patch.confidence = match.confidence;
  const bool is_bare = match.best == mission.arena.floor && !has_bare_places(mission);
  if (is_bare || match.distance > kMostDistance || match.confidence < kLeastConfidence) {
    return missing(
        fmt::format("{} cannot be measured: it has {}, between {} and {}", where,
                    ratio_text(patch.ratio), color_text(match.best), color_text(match.second)),
        mission);
  }
  return patch;
}

/// The number of places with a colour.
std::int64_t count_of(const MeasuredLayout& layout, Rgb color) {
  return std::ranges::count(layout.places, color, &MeasuredPatch::color);
}

std::optional<std::string> wrong_numbers(const MeasuredLayout& layout, const Mission& mission) {
  std::string seen;
  std::string wanted;
  bool is_wrong = false;
  for (const ShuffledPatches::Share& share : mission.shuffled.shares) {
    const std::int64_t count = count_of(layout, share.color);
    is_wrong = is_wrong || count != share.count;
    seen += fmt::format("{}{} {}", seen.empty() ? "" : ", ", count, color_text(share.color));
    wanted +=
        fmt::format("{}{} {}", wanted.empty() ? "" : ", ", share.count, color_text(share.color));
  }
  if (!is_wrong) return std::nullopt;
  const auto worst = std::ranges::min_element(layout.places, {}, &MeasuredPatch::confidence);
  return fmt::format(
      "patches were seen as {}, and the mission has {}; least certain is {} at {}, "
      "which has {}",
      seen, wanted, color_text(worst->color), point_text(worst->place.centre),
      ratio_text(worst->ratio));
}

}  // namespace

std::vector<Patch> MeasuredLayout::patches(const Arena& arena) const {
  std::vector<Patch> patches;
  for (const MeasuredPatch& patch : places) {
    if (patch.color != arena.floor) patches.push_back({patch.place, patch.color});
  }
  return patches;
}

Expected<MeasuredLayout> measure_layout(std::span<const FloorPicture> pictures,
                                        const Mission& mission) {
  const std::vector<Rectangle>& places = mission.shuffled.places;
  if (places.empty()) {
    return Unexpected(error_of(IssueCode::Config,
                               "the mission's floor is always the same; nothing is to be measured",
                               mission.name));
  }
  std::vector<std::vector<std::array<double, 3>>> ratios(places.size());
  std::string no_light = "there is no picture to measure the patches in";
  for (const FloorPicture& picture : pictures) {
    const FloorLight light(picture, mission);
    if (const auto fault = light.fault()) {
      no_light = *fault;
      continue;
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (const auto ratio = light.ratio_of(places[i])) ratios[i].push_back(*ratio);
    }
  }
  if (std::ranges::all_of(ratios, [](const auto& of_place) { return of_place.empty(); })) {
    return missing(no_light, mission);
  }
  MeasuredLayout layout;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Expected<MeasuredPatch> patch = measured_patch(places[i], ratios[i], mission);
    if (!patch) return Unexpected(std::move(patch.error()));
    layout.places.push_back(*patch);
  }
  if (const auto wrong = wrong_numbers(layout, mission)) return missing(*wrong, mission);
  return layout;
}

}  // namespace swarmsmith
