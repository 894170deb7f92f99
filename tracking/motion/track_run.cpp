#include "tracking/motion/track_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "base/assert.h"
#include "base/median.h"
#include "base/plain_text.h"
#include "tracking/motion/internal/bodies.h"
#include "tracking/motion/internal/clock_checks.h"
#include "tracking/motion/internal/known_errors.h"
#include "tracking/motion/internal/robot_tags.h"
#include "tracking/motion/internal/robot_track.h"
#include "tracking/motion/internal/robot_travel.h"
#include "tracking/motion/repeats.h"
#include "tracking/rig/calibration_limits.h"
#include "tracking/rig/lens_reach.h"
#include "tracking/rig/picture_size.h"

namespace swarmsmith {
namespace {

/// A robot must have been seen by this time (tracking facts, section 8).
constexpr double kFirstLook_s = 2;

constexpr Question kOffset{"fit of the tag's offset", "mm",
                           "a tag beside its robot's centre: scores look better than they are"};
constexpr Question kSpread{"floor tags around the arena", "%",
                           "positions that are guesses near the walls"};
constexpr Question kUnknown{"undeclared tags", "", "a robot with another number"};

/// One sigma on the floor from the calibration: half of the worst tag's leave-one-out error, which
/// is about the two-sigma bound of a point between the tags.
double place_error(const Rig& rig, const CameraSetup& setup) {
  const auto place = rig.places.find(setup.place_file);
  // The table of docs/tracking.md, "Sigma", has this and the other parts of a robot's error.
  return place == rig.places.end() ? 0 : 0.5 * place->second.worst_left_out_m;
}

Expected<std::vector<TrackedCamera>> cameras_of(const Observations& observations, const Rig& rig,
                                                const RunSpan& span) {
  const std::size_t lengths = span.lengths_s.size();
  // Times of one camera must not be used for another one, so the counts must agree before any
  // index.
  if (span.starts_s.size() != observations.cameras.size() ||
      (lengths != 0 && lengths != observations.cameras.size())) {
    return Unexpected(
        error_of(IssueCode::Config,
                 fmt::format("start and length of {} are wanted, of {} given",
                             counted(observations.cameras.size(), "camera"), span.starts_s.size()),
                 rig.file));
  }
  std::vector<TrackedCamera> cameras;
  for (std::size_t i = 0; i < observations.cameras.size(); ++i) {
    const CameraRecord& record = observations.cameras[i];
    const CameraSetup* setup = rig.setup_of(record.camera);
    if (setup == nullptr) {
      return Unexpected(error_of(IssueCode::Config,
                                 "there is no camera `" + record.camera + "` in the arena file",
                                 rig.file));
    }
    const std::optional<View> view = rig.view_of(*setup);
    if (!view) {
      return Unexpected(error_of(
          IssueCode::Config,
          fmt::format("camera {} needs its calibrations `{}` and `{}`; make them with `calibrate "
                      "camera` and `calibrate arena`",
                      setup->name, setup->model_file, setup->place_file),
          rig.file));
    }
    // Focal length and centre of a lens calibration are in pixels of its own picture (tracking
    // facts, section 2).
    const auto fits = check_picture_size(setup->model_file, view->camera.size, record.size, {},
                                         record.file.empty() ? setup->model_file : record.file);
    if (!fits) return Unexpected(fits.error());
    const auto& lens = rig.models.at(setup->model_file);
    cameras.push_back({setup->name, *view, span.starts_s[i], place_error(rig, *setup),
                       lens.rms_px / lens.model.fx, setup->time_error_s});
  }
  return cameras;
}

Expected<TaggedRobot> tagged_robot(const RobotSetup& setup, bool is_another, const Rig& rig,
                                   const TrackOptions& options, TrackedRun& run) {
  const auto found = rig.offsets.find(setup.offset_file);
  std::string reason = fmt::format("{} has no offset calibration", setup.name);
  if (found != rig.offsets.end()) {
    const OffsetCalibration* const own = of_tag(found->second, setup.tag);
    if (own != nullptr) {
      const double length_m = std::hypot(own->offset.x_m, own->offset.y_m);
      // A tag sits on its robot; an offset beyond the body is a wrong calibration or another kind
      // of robot.
      if (const double most_m = most_offset_of(options.body); length_m > most_m) {
        return Unexpected(error_of(
            IssueCode::SpinQuality,
            fmt::format("the tag of {} would sit {:.1f} mm from its centre, but a robot of this "
                        "mission reaches {:.1f} mm from it; make its calibration again, or name "
                        "the mission's robot",
                        setup.name, 1000 * length_m, 1000 * most_m),
            setup.offset_file));
      }
      const TaggedRobot robot{setup, own->offset,  std::max(own->sigma_x_m, own->sigma_y_m),
                              true,  own->has_yaw, is_another};
      run.checks.push_back(answered(kOffset, robot.subject(), Check::Outcome::Passed,
                                    1000 * own->rms_m, 1000 * OffsetLimits{}.rms_m));
      return robot;
    }
    const OffsetCalibration& offset = found->second;
    reason = fmt::format("the offset calibration `{}` of {} is of tag {}, and it carries tag {}",
                         setup.offset_file, setup.name, offset.tag, setup.tag);
  }
  // Refused by default, because the error always makes the score better (tracking
  // facts, section 5).
  if (!options.takes_tags_for_centres) {
    return Unexpected(error_of(
        IssueCode::NoOffset,
        reason + "; make one with `calibrate robot`, or take the tag for its centre explicitly, "
                 "which marks the score as biased",
        rig.file));
  }
  run.checks.push_back(answered(kOffset, setup.name, Check::Outcome::Warned));
  run.issues.push_back({IssueCode::TagAsCentre,
                        reason + "; its tag was used as its centre and the score is biased",
                        setup.name});
  return TaggedRobot{setup, {}};
}

/// A copy of the robot for each of its tags. A robot with several tags needs an offset and a
/// heading for each.
Expected<std::vector<TaggedRobot>> tagged_robots(const RobotSetup& setup, const Rig& rig,
                                                 const TrackOptions& options, TrackedRun& run) {
  TrackOptions asked = options;
  // Two tags cannot both be the centre of one robot.
  if (!setup.more_tags.empty()) asked.takes_tags_for_centres = false;
  std::vector<TaggedRobot> tags;
  for (const RobotSetup& tag : each_tag(setup)) {
    auto robot = tagged_robot(tag, !tags.empty(), rig, asked, run);
    if (!robot) return Unexpected(robot.error());
    // A spin alone gives each tag's offset in the frame of that tag; the tags would have no common
    // heading (tracking facts, section 5).
    if (!setup.more_tags.empty() && !robot->has_yaw) {
      return Unexpected(
          error_of(IssueCode::NoOffset,
                   fmt::format("{} has {}, and no straight run told how tag {} is turned; make its "
                               "calibration with `calibrate robot --spin FILE --straight FILE`",
                               setup.name, tags_text(setup), tag.tag),
                   rig.file));
    }
    tags.push_back(std::move(*robot));
  }
  return tags;
}

/// Indices of the run's sightings, by their tag.
using SightingsByTag = std::map<int, std::vector<std::size_t>>;

SightingsByTag sightings_of(const Observations& observations,
                            std::span<const TrackedCamera> cameras,
                            std::span<const Repeats> repeats, const TrackOptions& options) {
  SWARMSMITH_ASSERT(repeats.size() == cameras.size(), "each camera has a word about its frames");
  // Poses are interpolated and never extrapolated, so the first and the last instant need samples
  // from outside the run: up to the longest gap that can be bridged.
  const double margin = options.limits.degraded_gap_s;
  const double end = instant_s(options.span.cycles) + margin;
  SightingsByTag found;
  for (std::size_t i = 0; i < observations.sightings.size(); ++i) {
    const Sighting& seen = observations.sightings[i];
    // A damaged store may name a camera that does not exist.
    if (seen.camera < 0 || seen.camera >= static_cast<int>(cameras.size())) continue;
    const auto camera = static_cast<std::size_t>(seen.camera);
    const std::vector<bool>& again = repeats[camera].again;
    const auto frame = static_cast<std::size_t>(std::max<std::int64_t>(seen.frame, 0));
    // A copy shows an earlier time than its stamp (docs/tracking.md, "Videos and time").
    if (frame < again.size() && again[frame]) continue;
    const double time = seen.time_s - cameras[camera].start_s;
    if (time >= -margin && time <= end) found[seen.tag].push_back(i);
  }
  return found;
}

void list_unknown(const SightingsByTag& sightings, const Rig& rig, const TrackOptions& options,
                  TrackedRun& run) {
  std::set<int> known(options.other_tags.begin(), options.other_tags.end());
  for (const RobotSetup& robot : each_tag(rig.robots))
    known.insert(robot.tag);
  for (const ReferenceTag& reference : rig.references)
    known.insert(reference.tag);
  std::string list;
  int count = 0;
  // Only listed: an unknown tag cannot be a robot of the run (tracking facts, section 8).
  for (const auto& [tag, seen] : sightings) {
    if (known.contains(tag)) continue;
    ++count;
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", tag, counted(seen.size(), "time"));
  }
  run.checks.push_back(answered(
      kUnknown, "", count == 0 ? Check::Outcome::Passed : Check::Outcome::Warned, count, 0));
  if (list.empty()) return;
  run.issues.push_back({IssueCode::UnknownTags, "undeclared tags were seen: " + list});
}

/// Observations that may be the cause: notes about the film, and tags that appear twice.
std::string causes(const Observations& observations, const Rig& rig) {
  std::string text;
  for (const Issue& issue : observations.issues) {
    if (issue.code == IssueCode::FilmOdd) text += ". Note: " + issue.text;
  }
  for (const RobotSetup& robot : each_tag(rig.robots)) {
    std::map<std::pair<int, std::int64_t>, int> frames;
    for (const Sighting& seen : observations.sightings) {
      if (seen.tag == robot.tag) ++frames[{seen.camera, seen.frame}];
    }
    const auto twice =
        std::ranges::count_if(frames, [](const auto& frame) { return frame.second > 1; });
    // In most of its pictures: then a second robot may carry the number all the time.
    if (twice == 0 || 2 * static_cast<std::size_t>(twice) < frames.size()) continue;
    text += fmt::format(
        ". Note: tag {} is there twice in {} of the {} frames in which it is seen; "
        "does another robot carry it?",
        robot.tag, twice, frames.size());
  }
  return text;
}

/// The reason why a robot has no sample in the first seconds.
Error missing(const TaggedRobot& robot, const RobotSamples& samples, const FrameReport& frames,
              const std::string& spans, const std::string& causes) {
  const auto of = [&](Sample::Use use) {
    return std::ranges::count(samples.samples, use, &Sample::use);
  };
  const std::string who = fmt::format("{} ({})", robot.setup.name, tags_text(robot.setup));
  // The likely causes, from the film as a whole to the single sighting: no picture, two tags with
  // one number, a tag that is not flat, a tag that was not seen.
  if (frames.frames == 0 || frames.from_s > kFirstLook_s) {
    return error_of(
        IssueCode::VideoTruncated,
        fmt::format("covered {:.2f} s of the run, and nothing of its first {:.0f} s: {}; "
                    "check its start",
                    frames.covered_s, kFirstLook_s, spans),
        robot.setup.name);
  }
  if (samples.twice_unresolved > 0 && of(Sample::Use::Used) == 0) {
    return error_of(IssueCode::DuplicateId,
                    fmt::format("{} was seen twice in {}, from frame {} to frame {}; take "
                                "one of the tags away",
                                who, counted(samples.twice.size(), "frame"),
                                std::ranges::min(samples.twice), std::ranges::max(samples.twice)),
                    robot.setup.name);
  }
  const auto bad = of(Sample::Use::BadFit);
  if (2 * static_cast<std::size_t>(bad) > samples.samples.size()) {
    return error_of(
        IssueCode::RobotMissing,
        fmt::format("{} was seen {}, and in {} of them its tag is not a square of {:g} m at "
                    "{:g} m above the floor: it does not lie level, or is bent; mount it flat{}",
                    who, counted(samples.samples.size(), "time"), bad, robot.setup.edge_m,
                    robot.setup.height_m, causes),
        robot.setup.name);
  }
  return error_of(
      IssueCode::RobotMissing,
      fmt::format("{} was not seen in the first {:.0f} s: {} in all, {}, {} outside of the "
                  "arena, {}; check its number, light and start{}",
                  who, kFirstLook_s, counted(samples.samples.size(), "sighting"),
                  counted(of(Sample::Use::BadFit), "bad fit"), of(Sample::Use::Outside),
                  counted(of(Sample::Use::Outlier), "outlier"), causes),
      robot.setup.name);
}

/// The start of the run on each camera's clock, and the period of its video on the same clock.
std::string spans_text(const Observations& observations, std::span<const TrackedCamera> cameras) {
  std::string text;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const std::vector<double>& times = observations.cameras[i].frame_times;
    if (times.empty()) continue;
    text += fmt::format(
        "{}on the clock of camera {} the video goes from {:.2f} s to {:.2f} s, and "
        "the run begins at {:.2f} s",
        text.empty() ? "" : "; ", cameras[i].name, times.front(), times.back(), cameras[i].start_s);
  }
  return text.empty() ? "the video has no frame" : text;
}

bool is_seen_early(const RobotSamples& samples) {
  return std::ranges::any_of(samples.samples, [](const Sample& sample) {
    return sample.use == Sample::Use::Used && sample.time_s <= kFirstLook_s;
  });
}

/// All tags that were seen, of all robots, each with its own samples.
std::vector<TrackedTag> seen_tags(const std::vector<TaggedRobot>& robots,
                                  const std::vector<std::vector<OneOfTags>>& several,
                                  const TrackedRun& run) {
  SWARMSMITH_ASSERT(several.size() == robots.size() && run.robots.size() == robots.size(),
                    "each robot has its tags and its part of the run");
  std::vector<TrackedTag> tags;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const TrackedRobot& tracked = run.robots[i];
    if (several[i].empty()) tags.push_back({&robots[i], i, tracked.samples, tracked.mean_scale});
    for (const OneOfTags& one : several[i]) {
      if (!one.samples.samples.empty())
        tags.push_back({&one.tag, i, one.samples.samples, one.samples.scale});
    }
  }
  return tags;
}

/// Collects the robots' poses, instant by instant.
void join(const std::vector<RobotTrack>& tracks, int cycles, TrackedRun& run) {
  SWARMSMITH_ASSERT(tracks.size() == run.robots.size(), "each robot of the run has a track");
  run.trajectory.robots = static_cast<int>(tracks.size());
  for (int cycle = 0; cycle <= cycles; ++cycle) {
    for (const RobotTrack& track : tracks) {
      const Pose& pose = track.poses[static_cast<std::size_t>(cycle)];
      (cycle == 0 ? run.starts : run.trajectory.poses).push_back(pose);
    }
  }
}

/// One dropped frame is not a gap at 12 frames/s, but five dropped frames are a gap at 30 frames/s.
TrackOptions for_rate(TrackOptions options, double frame_rate) {
  constexpr double kLeast_s = 0.15;
  // The values are those of the table in docs/tracking.md, "Videos and time".
  constexpr double kJitter = 1.1;
  if (frame_rate > 0) {
    double& gap = options.limits.measured_gap_s;
    gap = std::min(gap, std::max(kLeast_s, kJitter * 2 / frame_rate));
  }
  return options;
}

/// Checks whether each lens was calibrated in the part of its picture that shows the arena.
void judge_lenses(const Rig& rig, const Arena& arena, TrackedRun& run) {
  for (const CameraSetup& camera : rig.cameras) {
    const std::optional<View> view = rig.view_of(camera);
    if (!view) continue;
    // A lens polynomial is fitted to the corners of the board; beyond them it is a guess.
    const auto share = share_beyond_reach(rig.models.at(camera.model_file), view->place, arena);
    Check check{.name = "reach of the lens calibration",
                .subject = camera.name,
                .limit = 100 * kMostBeyondReach,
                .unit = "%",
                .catches = "a lens calibration that is a guess where robots drive"};
    if (!share) {
      check.outcome = Check::Outcome::NotRun;
      check.reason = "its file does not say where the board was; `calibrate camera` again";
    } else {
      check.value = 100 * *share;
    }
    const bool is_beyond = share && *share > kMostBeyondReach;
    if (is_beyond) {
      check.outcome = Check::Outcome::Failed;
      run.issues.push_back(
          {IssueCode::CalibrationQuality,
           fmt::format(
               "{:.0f} % of the arena lies where the board never was in the picture of camera "
               "{} (limit {:.0f} %), where its lens is a guess; calibrate it there, too",
               100 * *share, camera.name, 100 * kMostBeyondReach)});
    }
    run.checks.push_back(std::move(check));
  }
}

/// Checks whether the floor tags surround the arena of this run. The calibration of the place asked
/// the same of the arena that it was given.
void judge_survey(const Rig& rig, const Arena& arena, TrackedRun& run) {
  const double limit = PlaceLimits{}.least_coverage;
  for (const CameraSetup& camera : rig.cameras) {
    const std::optional<View> view = rig.view_of(camera);
    if (!view) continue;
    std::vector<ReferenceTag> tags;
    for (const PlaceCalibration::Seen& seen : rig.places.at(camera.place_file).tags)
      tags.push_back(seen.tag);
    // Half of the arena or more (tracking facts, section 3).
    const double share = share_within_tags(tags, *view, corners_of(arena));
    const bool is_within = share >= limit;
    run.checks.push_back(answered(kSpread, camera.name,
                                  is_within ? Check::Outcome::Passed : Check::Outcome::Failed,
                                  100 * share, 100 * limit));
    if (is_within) continue;
    run.issues.push_back(
        {IssueCode::ReferenceTags,
         fmt::format("the floor tags of camera {} surround {:.0f} % of the mission's arena, at "
                     "least {:.0f} % is needed, else positions are extrapolated; lay tags near its "
                     "walls, and `swarmsmith track calibrate arena --mission` with this mission",
                     camera.name, 100 * share, 100 * limit)});
  }
}

/// The reason why a camera cannot film as its setup says: it reads out and exposes one picture
/// after another.
std::optional<Error> flaw_of_shutter(const CameraRecord& record, const Repeats& repeats,
                                     const CameraSetup& camera, const std::string& file) {
  std::vector<double> intervals;
  std::optional<double> last_s;
  for (std::size_t i = 0; i < record.frame_times.size(); ++i) {
    if (repeats.again[i]) continue;
    if (last_s) intervals.push_back(record.frame_times[i] - *last_s);
    last_s = record.frame_times[i];
  }
  if (intervals.empty()) return std::nullopt;
  // The median, because lost frames make some intervals longer.
  const double interval_s = upper_median(std::move(intervals));
  // Clocks round to milliseconds.
  constexpr double kRounding_s = 0.001;
  for (const auto& [key, time_s] :
       {std::pair{"readout", camera.readout_s}, {"exposure", camera.exposure_s}}) {
    if (time_s <= interval_s + kRounding_s) continue;
    return error_of(
        IssueCode::Config,
        fmt::format(
            "`{}` of camera \"{}\" is {:.1f} ms, and its film has a picture each {:.1f} ms; "
            "give the time that the camera needs for one picture",
            key, camera.name, 1000 * time_s, 1000 * interval_s),
        file);
  }
  return std::nullopt;
}

}  // namespace

std::string_view name_of(CycleKind kind) {
  switch (kind) {
    case CycleKind::Measured:
      return "measured";
    case CycleKind::Interpolated:
      return "interpolated";
    case CycleKind::Degraded:
      return "degraded";
    case CycleKind::Missing:
      return "missing";
  }
  return "";
}

void allow_speed(TrackLimits& limits, double speed_m_s, double turn_rad_s) {
  const TrackLimits usual;
  const double faster = std::max(1.0, speed_m_s / usual.driving_speed_m_s);
  const double quicker = std::max(1.0, turn_rad_s / usual.driving_turn_rad_s);
  limits.driving_speed_m_s = usual.driving_speed_m_s * faster;
  limits.driving_turn_rad_s = usual.driving_turn_rad_s * quicker;
  limits.top_speed_m_s = usual.top_speed_m_s * faster;
  limits.top_turn_rad_s = usual.top_turn_rad_s * quicker;
  limits.jump_m = usual.jump_m * faster;
  limits.corner_speed_m_s = usual.corner_speed_m_s * faster;
}

TrackLimits limits_of(const Robot& robot, double logged_m_s) {
  const RobotDrive& drive = robot.drive;
  const bool is_rvr = drive.max_speed_mps == kMaxWheelSpeed_mps &&
                      robot.body.outline == Outline(BoxOutline{kBodySide_m, kBodySide_m});
  double most = is_rvr ? 0 : drive.max_speed_mps;
  // A node that works as in the simulator has the motors' limit in its log.
  if (logged_m_s != kMaxWheelSpeed_mps) most = std::max(most, logged_m_s);
  TrackLimits limits;
  allow_speed(limits, most, 2 * most / drive.track_m);
  // Logs have the limit of the treads' speed, so a film in which robots are faster is an error, not
  // only a doubt (docs/tracking.md, "Is the clock right?").
  if (!(logged_m_s > 0)) return limits;
  limits.driving_speed_m_s = logged_m_s;
  limits.driving_turn_rad_s = 2 * logged_m_s / drive.track_m;
  limits.knows_driving_speed = true;
  return limits;
}

Expected<TrackedRun> track_run(const Observations& observations, const Rig& rig, const Arena& arena,
                               const TrackOptions& asked) {
  const Expected<std::vector<TrackedCamera>> cameras = cameras_of(observations, rig, asked.span);
  if (!cameras) return Unexpected(cameras.error());
  // Copies are found first: they are neither frames nor samples for anything that follows.
  std::vector<Repeats> repeats;
  for (std::size_t c = 0; c < cameras->size(); ++c)
    repeats.push_back(
        repeats_of(observations, static_cast<int>(c), rig.robots, asked.limits.corner_speed_m_s));
  for (std::size_t c = 0; c < cameras->size(); ++c) {
    const CameraRecord& record = observations.cameras[c];
    if (auto flaw = flaw_of_shutter(record, repeats[c], *rig.setup_of(record.camera), rig.file))
      return Unexpected(std::move(*flaw));
  }
  FrameReport frames = frame_report(observations, *cameras, repeats, rig, asked);
  // How long a gap may be and still count as measured depends on the rate of the film.
  const TrackOptions options = for_rate(asked, frames.frame_rate_median);
  TrackedRun run{.covered_s = frames.covered_s,
                 .frame_rate_least = frames.frame_rate_least,
                 .frame_rate_median = frames.frame_rate_median,
                 .frame_rate_most = frames.frame_rate_most,
                 .frames = frames.frames,
                 .frames_dropped = frames.dropped,
                 .frames_twice = frames.twice,
                 .issues = frames.issues,
                 .checks = frames.checks};
  const SightingsByTag sightings = sightings_of(observations, *cameras, repeats, options);
  list_unknown(sightings, rig, options, run);
  std::vector<TaggedRobot> robots;
  std::vector<RobotTrack> tracks;
  std::vector<std::vector<OneOfTags>> several;  ///< tags of robots with more than one
  for (const RobotSetup& setup : rig.robots) {
    const auto tags = tagged_robots(setup, rig, options, run);
    if (!tags) return Unexpected(tags.error());
    const TaggedRobot* const robot = &tags->front();
    const auto samples_by = [&](const TaggedRobot& tag) {
      const auto seen = sightings.find(tag.setup.tag);
      return samples_of(tag, observations.sightings,
                        seen == sightings.end() ? std::vector<std::size_t>{} : seen->second,
                        *cameras, arena, options);
    };
    std::vector<OneOfTags>& each = several.emplace_back();
    for (const TaggedRobot& tag : *tags) {
      if (tags->size() > 1) each.push_back({tag, samples_by(tag)});
    }
    RobotSamples samples = each.empty() ? samples_by(*robot) : fused_samples(each, *cameras, rig);
    // A score needs all robots, so the first one that is missing ends the tracking.
    if (!is_seen_early(samples)) {
      Error error = missing(*robot, samples, frames, spans_text(observations, *cameras),
                            causes(observations, rig));
      const auto& of_first = each.empty() ? samples.samples : each.front().samples.samples;
      error.message += tilt_clause(setup, of_first, observations.sightings, *cameras);
      return Unexpected(std::move(error));
    }
    tracks.push_back(track_of(*robot, samples, *cameras, options));
    run.robots.push_back(tracked_robot(*robot, std::move(samples), tracks.back(), frames, options,
                                       run.issues, run.checks));
    robots.push_back(*robot);
    if (!each.empty()) {
      // Half of a corner's speed is that of the robot.
      judge_agreement(each, *cameras, rig, options.limits.corner_speed_m_s / 2, run);
    }
  }
  join(tracks, options.span.cycles, run);
  Findings of_speeds;
  check_speeds(run.robots, options.limits, instant_s(options.span.cycles), of_speeds);
  std::ranges::move(of_speeds.issues, std::back_inserter(run.issues));
  std::ranges::move(of_speeds.checks, std::back_inserter(run.checks));
  judge_lenses(rig, arena, run);
  judge_survey(rig, arena, run);
  const std::vector<TrackedTag> tags = seen_tags(robots, several, run);
  const std::vector<TagEvidence> evidence =
      judge_tags(tags, observations, *cameras, rig, options.limits, run);
  judge_travel(robots, tracks, arena, options, run);
  judge_bodies(tracks, arena, options, run);
  add_known_errors(tags, evidence, *cameras, rig, run);
  return run;
}

}  // namespace swarmsmith
