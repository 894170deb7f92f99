#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// The problems that a calibration or a run can have. People and scripts see their names, such as
/// "E_GAP" and "W_FRAMES_DROPPED" (docs/tracking.md lists them). An E_ is an error: the score does
/// not count. A W_ is a warning.
enum class IssueCode {
  VideoUnreadable,
  VideoTruncated,
  CalibrationSize,
  CalibrationQuality,
  ReferenceTags,
  Extrinsics,
  CameraMoved,
  RobotMissing,
  Gap,
  DuplicateId,
  TagSize,
  NoOffset,
  SpinQuality,
  FramesDropped,  ///< a warning
  Timestamps,
  FrameRate,
  SidecarMismatch,
  LayoutMissing,
  Config,
  OutsideArena,      ///< a robot left the arena
  Outliers,          ///< a warning: samples were dropped as outliers
  Interpolated,      ///< a warning: short gaps were interpolated
  TooCloseToCall,    ///< a warning: a robot is so near a border that its side is uncertain
  UnknownTags,       ///< a warning: tags were seen that no file declares
  CamerasDisagree,   ///< a warning
  TagAsCentre,       ///< a warning: the score is biased
  Duration,          ///< the length of the video differs from the length in the run log
  CameraUnchecked,   ///< a warning: too few floor tags were seen to check that no camera moved
  SurveyChanged,     ///< a warning: floor tags have new coordinates since a place was calibrated
  ByHand,            ///< a warning: a person gave the place of a robot
  LogUnreadable,     ///< a warning: a robot's log is missing, or is not a log
  LogForeign,        ///< a robot's log belongs to another run, robot or machine
  LogShort,          ///< a robot's log ends before the run does
  ClockOffset,       ///< a warning: a robot's clock was wrong
  RobotDegraded,     ///< a warning: a robot's node reports that it did not run properly
  RobotInvalid,      ///< a robot's node reports that it ran too badly for a valid score
  MotionUnlikeLog,   ///< a warning: a robot did not move as its log commands
  SyncDiffers,       ///< a warning: the log and the sync tag give different starts
  TagTurned,         ///< a robot's motion shows that its tag was moved after its calibration
  HeadingOff,        ///< a warning: the same, but only headings are affected, not positions
  Pushed,            ///< a robot moved in a way that treads cannot move it
  TagSizeDoubtful,   ///< a warning: a tag's size and height disagree slightly
  Tilted,            ///< a warning: a tag or its robot is not level
  PicturesRepeated,  ///< a warning: some pictures repeat the picture before them
  ClockCounted,      ///< a warning: frame times were counted, and no other clock confirms them
  ClockStep,         ///< the clock of the film was set during the run
  FilmSpeed,         ///< a warning: robots move faster than they can
  FilmOdd,           ///< a warning that degrades nothing: a reason why tags may not be found
  FilmTooFast,       ///< the film plays at another speed than the robots' logs show
  TagPlaceDoubtful,  ///< a warning: a tag may not be exactly where it was calibrated
  PushedDoubtful,    ///< a warning: a robot may have been pushed
  TagsDisagree,      ///< the tags of one robot contradict their calibration
  BodiesOverlap,     ///< a warning: robots are inside each other, or in walls, for long
};

/// The name of an issue: "E_GAP".
std::string_view name_of(IssueCode code);
std::optional<IssueCode> issue_code_from_name(std::string_view name);
/// Whether its name begins with E_.
bool is_error(IssueCode code);

/// One problem of a run: the finding, its limit, and advice.
struct Issue {
  IssueCode code = IssueCode::Config;
  std::string text;
  std::string robot = {};           ///< name of the robot; empty if there is none
  std::optional<double> from = {};  ///< seconds of the run
  std::optional<double> to = {};

  friend bool operator==(const Issue&, const Issue&) = default;
};

/// The issue as an error that ends a command: "E_GAP: rvr2 was not seen ...". The kind is BadInput
/// (exit code 2) for E_CONFIG, and, with `in_config`, for an E_DUPLICATE_ID in the arena file; it
/// is Corrupt (exit code 1) for all others.
Error error_of(IssueCode code, std::string text, std::string where, bool in_config = false);

/// How far a score can be trusted.
enum class Verdict { Valid, Degraded, Invalid };
std::string_view name_of(Verdict verdict);  ///< "VALID", "DEGRADED", "INVALID"
std::optional<Verdict> verdict_from_name(std::string_view name);

}  // namespace swarmsmith
