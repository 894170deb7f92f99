#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// What can be wrong with a calibration or a run, by the names that people and scripts see
/// (docs/tracking.md lists them): "E_GAP", "W_FRAMES_DROPPED". E_ stops a score from counting, W_
/// is to be known.
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
  Outliers,          ///< a warning: samples were dropped
  Interpolated,      ///< a warning: cycles were bridged
  TooCloseToCall,    ///< a warning: a robot stands on a border as far as can be told
  UnknownTags,       ///< a warning: ids that are not declared
  CamerasDisagree,   ///< a warning
  TagAsCentre,       ///< a warning: the score is biased
  Duration,          ///< the video's length is not the log's
  CameraUnchecked,   ///< a warning: too few floor tags were seen to tell whether a camera moved
  SurveyChanged,     ///< a warning: floor tags were surveyed anew since a place was found
  ByHand,            ///< a warning: a person said where a robot was
  LogUnreadable,     ///< a warning: a robot's log is not there, or is none
  LogForeign,        ///< a robot's log is of another run, robot or machine
  LogShort,          ///< a robot's log ends before the run does
  ClockOffset,       ///< a warning: a robot's clock was off
  RobotDegraded,     ///< a warning: a robot's node says that it did not run as it should
  RobotInvalid,      ///< the same, beyond what counts
  MotionUnlikeLog,   ///< a warning: a robot did not move as its log commands
  SyncDiffers,       ///< a warning: the log's start is not when the sync tag says
  TagTurned,         ///< a robot's tag does not sit as it was calibrated, by how the robot moves
  HeadingOff,        ///< a warning: the same, and no position is wrong by it
  Pushed,            ///< a robot went where treads cannot take it
  TagSizeDoubtful,   ///< a warning: a tag's size and height do not quite fit together
  Tilted,            ///< a warning: a tag or its robot is not level
  PicturesRepeated,  ///< a warning: pictures that show the one before once more
  ClockCounted,      ///< a warning: the film's times were counted, and no other clock agrees
  ClockStep,         ///< the film's clock was set within the run
  FilmSpeed,         ///< a warning: robots are faster than they should be able to
  FilmOdd,           ///< a warning, which degrades nothing: why tags may not be found
  FilmTooFast,       ///< the film runs at another speed than the robots' own logs say
  TagPlaceDoubtful,  ///< a warning: a tag may sit a little otherwise than calibrated
  PushedDoubtful,    ///< a warning: a robot may have been pushed
  TagsDisagree,      ///< tags of one robot are not where its calibration has them
};

/// "E_GAP".
std::string_view name_of(IssueCode code);
std::optional<IssueCode> issue_code_from_name(std::string_view name);
/// Whether its name begins with E_.
bool is_error(IssueCode code);

/// One thing that is wrong with a run: what was found, the limit, and what to do.
struct Issue {
  IssueCode code = IssueCode::Config;
  std::string text;
  std::string robot = {};           ///< its name; empty when none is concerned
  std::optional<double> from = {};  ///< seconds of the run
  std::optional<double> to = {};

  friend bool operator==(const Issue&, const Issue&) = default;
};

/// The issue as an error that ends a command: "E_GAP: rvr2 was not seen ...". Kind BadInput (exit
/// code 2) for E_CONFIG and for a duplicate id in the map, which is E_DUPLICATE_ID with
/// `in_config`; Corrupt (exit code 1) for all others.
Error error_of(IssueCode code, std::string text, std::string where, bool in_config = false);

/// How far a score can be trusted.
enum class Verdict { Valid, Degraded, Invalid };
std::string_view name_of(Verdict verdict);  ///< "VALID", "DEGRADED", "INVALID"
std::optional<Verdict> verdict_from_name(std::string_view name);

}  // namespace swarmsmith
