#include "tracking/rig/issue.h"

#include <algorithm>
#include <array>
#include <utility>

#include "tracking/rig/check.h"

namespace swarmsmith {
namespace {

/// In the order of IssueCode.
constexpr std::array<std::string_view, 53> kNames = {"E_VIDEO_UNREADABLE",
                                                     "E_VIDEO_TRUNCATED",
                                                     "E_CALIB_SIZE",
                                                     "E_CALIB_QUALITY",
                                                     "E_REF_TAGS",
                                                     "E_EXTRINSICS",
                                                     "E_CAMERA_MOVED",
                                                     "E_ROBOT_MISSING",
                                                     "E_GAP",
                                                     "E_DUPLICATE_ID",
                                                     "E_TAG_SIZE",
                                                     "E_NO_OFFSET",
                                                     "E_SPIN_QUALITY",
                                                     "W_FRAMES_DROPPED",
                                                     "E_TIMESTAMPS",
                                                     "E_FRAME_RATE",
                                                     "E_SIDECAR_MISMATCH",
                                                     "E_LAYOUT_MISSING",
                                                     "E_CONFIG",
                                                     "E_OUTSIDE_ARENA",
                                                     "W_OUTLIERS",
                                                     "W_INTERPOLATED",
                                                     "W_TOO_CLOSE_TO_CALL",
                                                     "W_UNKNOWN_TAGS",
                                                     "W_CAMERAS_DISAGREE",
                                                     "W_TAG_AS_CENTRE",
                                                     "E_DURATION",
                                                     "W_CAMERA_UNCHECKED",
                                                     "W_SURVEY_CHANGED",
                                                     "W_BY_HAND",
                                                     "W_LOG_UNREADABLE",
                                                     "E_LOG_FOREIGN",
                                                     "E_LOG_SHORT",
                                                     "W_CLOCK_OFFSET",
                                                     "W_ROBOT_DEGRADED",
                                                     "E_ROBOT_INVALID",
                                                     "W_MOTION_UNLIKE_LOG",
                                                     "W_SYNC_DIFFERS",
                                                     "E_TAG_TURNED",
                                                     "W_HEADING_OFF",
                                                     "E_PUSHED",
                                                     "W_TAG_SIZE",
                                                     "W_TILTED",
                                                     "W_PICTURES_REPEATED",
                                                     "W_CLOCK_COUNTED",
                                                     "E_CLOCK_STEP",
                                                     "W_FILM_SPEED",
                                                     "W_FILM_ODD",
                                                     "E_FILM_SPEED",
                                                     "W_TAG_PLACE",
                                                     "W_PUSHED",
                                                     "E_TAGS_DISAGREE",
                                                     "W_BODIES_OVERLAP"};
static_assert(kNames.size() == static_cast<std::size_t>(IssueCode::BodiesOverlap) + 1);

constexpr std::array<std::string_view, 3> kVerdicts = {"VALID", "DEGRADED", "INVALID"};

}  // namespace

std::string_view name_of(IssueCode code) {
  return kNames.at(static_cast<std::size_t>(code));
}

std::optional<IssueCode> issue_code_from_name(std::string_view name) {
  const auto* const found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<IssueCode>(found - kNames.begin());
}

bool is_error(IssueCode code) {
  return name_of(code).starts_with("E_");
}

Error error_of(IssueCode code, std::string text, std::string where, bool in_config) {
  const bool is_usage = code == IssueCode::Config || in_config;
  return {is_usage ? ErrorKind::BadInput : ErrorKind::Corrupt,
          std::string(name_of(code)) + ": " + std::move(text), std::move(where)};
}

std::string_view name_of(Check::Outcome outcome) {
  switch (outcome) {
    case Check::Outcome::Passed:
      return "passed";
    case Check::Outcome::Warned:
      return "warned";
    case Check::Outcome::Failed:
      return "failed";
    case Check::Outcome::NotRun:
      return "not run";
  }
  return "";
}

std::string_view name_of(Verdict verdict) {
  return kVerdicts.at(static_cast<std::size_t>(verdict));
}

std::optional<Verdict> verdict_from_name(std::string_view name) {
  const auto* const found = std::find(kVerdicts.begin(), kVerdicts.end(), name);
  if (found == kVerdicts.end()) return std::nullopt;
  return static_cast<Verdict>(found - kVerdicts.begin());
}

}  // namespace swarmsmith
