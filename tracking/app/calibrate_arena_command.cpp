#include <fmt/format.h>
#include <algorithm>
#include <memory>
#include <optional>
#include <span>

#include "base/output_file.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "sim/files/mission_file.h"
#include "tracking/app/calibrate_sources.h"
#include "tracking/app/commands.h"
#include "tracking/app/refusal.h"
#include "tracking/app/written_files.h"
#include "tracking/calibration/calibration_report.h"
#include "tracking/calibration/solve_place.h"
#include "tracking/detection/tag_detector.h"
#include "tracking/rig/lens_reach.h"
#include "tracking/rig/picture_size.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

/// Number of pictures for the medians; more do not improve them.
constexpr int kLooks = 20;
/// The pictures of a video span this many frames, if it has as many, so that a passing hand does
/// not affect the medians.
constexpr std::int64_t kFrames = 200;

struct ArenaArguments {
  std::vector<std::string> words;
  std::string arena;
  std::string camera;
  std::string mission;
  std::string file;
  bool again = false;
};

/// The floor tags in about twenty pictures.
Expected<std::vector<std::vector<TagLook>>> looks_of(const ArenaArguments& arguments,
                                                     const Rig& rig, const CameraSetup& camera,
                                                     Output& output) {
  const ImageSize calibrated = rig.models.at(camera.model_file).model.size;
  auto detector = TagDetector::of_family(rig.family);
  if (!detector) return Unexpected(detector.error());
  std::vector<std::vector<TagLook>> looks;
  const auto look = [&](const PictureSource& source, const FrameSource& frames) -> Expected<bool> {
    const SourceInfo& info = frames.info();
    const auto fits =
        check_picture_size(camera.model_file, calibrated, info.size, info.oddities, source.word);
    if (!fits) return Unexpected(fits.error());
    const std::int64_t span =
        info.expected_frames > 0 ? std::min(info.expected_frames, kFrames) : kFrames;
    const std::int64_t every = source.is_video ? std::max<std::int64_t>(1, span / kLooks) : 1;
    if (frames.frame().number % every != 0) return true;
    if (looks.empty() && is_mirrored(*detector, frames.frame().gray)) {
      return Unexpected(error_of(IssueCode::ReferenceTags, kMirroredAdvice, source.word));
    }
    auto& seen = looks.emplace_back();
    for (const Detection& tag : detector->find(frames.frame().gray, 1)) {
      if (tag.hamming == 0) seen.push_back({tag.tag, tag.corners});
    }
    return looks.size() < kLooks || !source.is_video;
  };
  if (const auto looked = for_each_picture(arguments.words, look, output); !looked)
    return Unexpected(looked.error());
  return looks;
}

/// The error for a floor tag that most looks contain more than once: the same sheet was printed
/// repeatedly.
std::optional<Error> repeated(const std::vector<std::vector<TagLook>>& looks,
                              std::span<const ReferenceTag> survey) {
  for (const ReferenceTag& tag : survey) {
    std::size_t times = 0;
    std::ptrdiff_t most = 0;
    for (const std::vector<TagLook>& look : looks) {
      const auto count = std::ranges::count(look, tag.tag, &TagLook::tag);
      most = std::max(most, count);
      if (count > 1) ++times;
    }
    if (2 * times <= looks.size()) continue;
    return error_of(
        IssueCode::DuplicateId,
        fmt::format("tag {} is in the picture {} times, but each floor tag needs its own "
                    "number; print them with `swarmsmith track print tags --ids`",
                    tag.tag, most),
        "");
  }
  return std::nullopt;
}

std::string place_json(const PlaceCalibration& calibration, const std::string& file) {
  const auto tag_json = [](const PlaceCalibration::Seen& seen) {
    return JsonObject()
        .add("tag", seen.tag.tag)
        .add("rms_px", seen.rms_px)
        .add("left_out_m", seen.left_out_m);
  };
  const Point3 centre = calibration.place.centre();
  return JsonObject()
             .add("file", file)
             .add("camera", std::array{centre.x, centre.y, centre.z})
             .add("rms_px", calibration.rms_px)
             .add("worst_left_out_m", calibration.worst_left_out_m)
             .add("worst_tag", calibration.worst_tag)
             .add("coverage", calibration.coverage)
             .add("tags", json_list(calibration.tags, tag_json))
             .text() +
         "\n";
}

/// The input for solving the place, from pictures or from the last calibration's medians.
Expected<PlaceQuestion> question_of(const ArenaArguments& arguments, const Rig& rig,
                                    const CameraSetup& camera, const Arena& arena, Output& output) {
  PlaceQuestion question;
  question.survey = rig.references;
  question.camera = rig.models.at(camera.model_file).model;
  question.arena = corners_of(arena);
  question.limits.least_height_m = camera.least_height_m;
  question.limits.most_height_m = camera.most_height_m;
  if (arguments.again) {
    const auto old = rig.places.find(camera.place_file);
    if (old == rig.places.end()) {
      return Unexpected(
          error_of(IssueCode::Config,
                   "--again needs an earlier calibration, but there is none; give a video "
                   "of the empty arena instead",
                   beside(arguments.arena, camera.place_file)));
    }
    return question_again(old->second, std::move(question));
  }
  const auto looks = looks_of(arguments, rig, camera, output);
  if (!looks) return Unexpected(looks.error());
  if (auto twice = repeated(*looks, rig.references)) return Unexpected(std::move(*twice));
  question.seen = median_of_looks(*looks, rig.references);
  return question;
}

Error beyond_reach(const CameraSetup& camera, double share) {
  return error_of(IssueCode::CalibrationQuality,
                  fmt::format("{:.0f} % of the arena lies where the board was in no picture (limit "
                              "{:.0f} %), so the lens is a guess there; take pictures with the "
                              "board there, too, and `calibrate camera` again",
                              100 * share, 100 * kMostBeyondReach),
                  camera.model_file);
}

ExitCode solve(const ArenaArguments& arguments, const Rig& rig, const CameraSetup& camera,
               const Arena& arena, Output& output) {
  const auto model = rig.files.find(camera.model_file);
  if (model == rig.files.end()) {
    return fail_all(output, {error_of(IssueCode::Config,
                                      "camera \"" + camera.name +
                                          "\" is not calibrated yet; first `swarmsmith track "
                                          "calibrate camera`",
                                      beside(arguments.arena, camera.model_file))});
  }
  const std::string made = beside(arguments.arena, camera.place_file);
  const std::string file = arguments.file.empty() ? made : arguments.file;
  if (const auto flaw = flaw_of_calibration_output(file, CalibrationKind::Place))
    return fail(output, exit_code_of_tracking(*flaw), *flaw);
  const auto question = question_of(arguments, rig, camera, arena, output);
  if (!question) return fail_all(output, {question.error()});
  auto calibration = solve_place(*question);
  if (!calibration) return fail_all(output, {calibration.error()});
  const auto beyond =
      share_beyond_reach(rig.models.at(camera.model_file), calibration->place, arena);
  if (beyond && *beyond > kMostBeyondReach) {
    return fail_all(output, {beyond_reach(camera, *beyond)});
  }
  calibration->camera_sha256 = model->second.sha256;
  calibration->made = utc_now();
  forget_input(made);
  if (const auto written = write_whole_file(file, calibration_text(*calibration)); !written)
    return fail(output, ExitCode::Failed, written.error());
  output.out << (output.json ? place_json(*calibration, file) : report_text(*calibration));
  print_cautions(output, cautions_of(*calibration, question->limits));
  print_note(output, "wrote " + file);
  return ExitCode::Done;
}

ExitCode run(const ArenaArguments& arguments, Output& output) {
  if (arguments.again == !arguments.words.empty()) {
    return fail(output, ExitCode::Usage,
                "give a video or pictures of the empty arena, or --again to solve from the last "
                "ones");
  }
  const auto rig = read_rig(arguments.arena);
  if (!rig) return fail_all(output, rig.error());
  const auto camera = camera_of(*rig, arguments.camera);
  if (!camera) return fail_all(output, {camera.error()});
  Arena arena = dodecagon_of_the_thesis();
  if (arguments.mission.empty()) {
    print_note(output, fmt::format("note: no --mission given: the floor tags are compared with the "
                                   "arena of the thesis, a dodecagon of {:.2f} m2",
                                   area_of(arena)));
  } else {
    auto mission = find_mission(arguments.mission, {});
    if (!mission) return fail_all(output, mission.error());
    arena = mission->mission.arena;
  }
  return solve(arguments, *rig, *camera, arena, output);
}

}  // namespace

CommandRun declare_calibrate_arena(Options& options) {
  auto arguments = std::make_shared<ArenaArguments>();
  options.words("PICTURES FILE", arguments->words,
                "A video or bag of the arena with its floor tags, or pictures or folders of them");
  options.text("--arena FILE", arguments->arena, "Arena file", Options::Need::Required);
  options.text("--camera CAMERA", arguments->camera, "Camera, if the arena has several");
  options.flag("--again", arguments->again,
               "Solve again from the corners of the last pictures, after you corrected the survey "
               "or calibrated the lens again");
  options.text("--mission MISSION|FILE", arguments->mission,
               "Mission whose arena the tags must cover (default: the thesis' dodecagon)");
  options.text("-o,--output FILE", arguments->file,
               "File to write (default: the camera's `place` of the arena file)");
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith
