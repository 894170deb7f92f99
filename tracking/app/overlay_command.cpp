#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/id.h"
#include "base/plain_text.h"
#include "base/text/json.h"
#include "base/text/table_reader.h"
#include "base/text/whole_file.h"
#include "console/counter.h"
#include "tracking/app/commands.h"
#include "tracking/app/run_analysis.h"
#include "tracking/app/run_plan.h"
#include "tracking/app/run_store.h"
#include "tracking/app/watch_run.h"
#include "tracking/app/written_files.h"
#include "tracking/overlay/draw_overlay.h"
#include "tracking/video/picture_bytes.h"
#include "tracking/video/video_writer.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

/// Time shown before and after the run.
constexpr double kAround_s = 1;
/// A floor tag is drawn where it was seen within this time.
constexpr double kReferenceHolds_s = 5;

struct OverlayArguments {
  ScoreArguments run;
  std::string video;
  std::string camera;
  std::string at;
  std::string out;
};

/// A run, with its videos and the camera to draw.
struct DrawnRun {
  AnalysedRun run;
  std::vector<fs::path> videos;
  std::size_t camera = 0;
};

OrRefusal<DrawnRun> run_of_videos(const OverlayArguments& words, Output& output) {
  auto plan = plan_run(words.run);
  if (!plan) return tl::unexpected(std::move(plan.error()));
  auto run = watch_run(*plan, output);
  if (!run) return tl::unexpected(std::move(run.error()));
  DrawnRun drawn{std::move(*run), {}};
  for (const PlannedVideo& video : plan->videos)
    drawn.videos.push_back(video.path);
  return drawn;
}

OrRefusal<DrawnRun> run_of_store(const OverlayArguments& words) {
  const auto kept = kept_run(words.run.store, words.run.videos.front());
  if (!kept) return tl::unexpected(kept.error());
  auto run = analyse_again(kept->rows);
  if (!run) return tl::unexpected(std::move(run.error()));
  DrawnRun drawn{std::move(*run), {}};
  for (const RunVideo& video : drawn.run.log.videos)
    drawn.videos.emplace_back(video.file);
  return drawn;
}

/// Selects the camera, and checks that its video is the one that was scored.
std::optional<Refusal> settle_video(const OverlayArguments& words, DrawnRun& drawn) {
  const auto& cameras = drawn.run.rig.cameras;
  if (!words.camera.empty()) {
    const auto found = std::find_if(cameras.begin(), cameras.end(),
                                    [&](const CameraSetup& c) { return c.name == words.camera; });
    if (found == cameras.end())
      return refused(ExitCode::Usage,
                     {ErrorKind::BadInput, "no camera \"" + words.camera + "\" filmed this run",
                      "--camera"})
          .value();
    drawn.camera = static_cast<std::size_t>(found - cameras.begin());
  }
  fs::path& file = drawn.videos.at(drawn.camera);
  if (!words.video.empty()) file = words.video;
  const auto sha256 = sha256_of_source(file.string());
  if (!sha256) {
    Error error = sha256.error();
    error.message += "; name the run's video by --video";
    return refused(std::move(error)).value();
  }
  if (*sha256 != drawn.run.observations.cameras.at(drawn.camera).sha256)
    return refused(
               ExitCode::Failed,
               {ErrorKind::Conflict,
                "this is not the video that the run was scored from; name that one with --video",
                file.string()})
        .value();
  return std::nullopt;
}

/// The tags of a frame, of robots and unknown ones; `next` is the position in the list of
/// sightings.
std::vector<OverlayTag> tags_of(const DrawnRun& drawn, std::int64_t frame, double time_s,
                                std::size_t& next) {
  const std::vector<Sighting>& all = drawn.run.observations.sightings;
  const auto camera = static_cast<int>(drawn.camera);
  const std::vector<RobotSetup> robots = each_tag(drawn.run.rig.robots);
  std::vector<OverlayTag> tags;
  while (next < all.size() &&
         (all[next].camera < camera || (all[next].camera == camera && all[next].frame < frame)))
    ++next;
  for (; next < all.size() && all[next].camera == camera && all[next].frame == frame; ++next) {
    const bool is_robot =
        std::ranges::find(robots, all[next].tag, &RobotSetup::tag) != robots.end();
    tags.push_back({all[next].tag, all[next].corners,
                    is_robot ? OverlayTag::Kind::Robot : OverlayTag::Kind::Unknown});
  }
  for (const ReferenceTag& reference : drawn.run.rig.references) {
    const ReferenceLook* nearest = nullptr;
    for (const ReferenceLook& look : drawn.run.observations.cameras[drawn.camera].references) {
      const double away_s = std::abs(look.time_s - time_s);
      if (look.tag == reference.tag && away_s <= kReferenceHolds_s &&
          (nearest == nullptr || away_s < std::abs(nearest->time_s - time_s)))
        nearest = &look;
    }
    if (nearest != nullptr)
      tags.push_back({reference.tag, nearest->corners, OverlayTag::Kind::Reference});
  }
  return tags;
}

Expected<void> write_png(const std::string& path, const ColorImage& image) {
  const auto bytes = png_of(image);
  if (!bytes) return Unexpected(bytes.error());
  return write_whole_file(path, *bytes);
}

bool is_folder(const std::string& out) {
  std::error_code none;
  return out.ends_with('/') || fs::is_directory(out, none);
}

/// Writes the pictures to a video, a folder, or a single picture.
class Sink {
 public:
  Sink(std::string out, bool one) : out_(std::move(out)), one_(one) {}

  Expected<void> add(const ColorImage& image, double time_s, double frame_rate) {
    ++count_;
    if (one_) return write_png(out_, image);
    if (is_folder(out_)) {
      std::error_code ignored;
      fs::create_directories(out_, ignored);
      return write_png((fs::path(out_) / fmt::format("{:06}.png", count_)).string(), image);
    }
    if (!writer_) {
      VideoOptions options;
      if (frame_rate > 0) options.frame_rate = frame_rate;
      auto opened = VideoWriter::open(out_, {image.width, image.height}, options);
      if (!opened) return Unexpected(opened.error());
      writer_ = std::make_unique<VideoWriter>(std::move(*opened));
      first_s_ = time_s;
    }
    return writer_->write(image, time_s - first_s_);
  }
  Expected<void> finish() { return writer_ ? writer_->finish() : Expected<void>(); }
  std::int64_t count() const { return count_; }

 private:
  std::string out_;
  bool one_;
  std::int64_t count_ = 0;
  double first_s_ = 0;
  std::unique_ptr<VideoWriter> writer_;
};

Expected<std::int64_t> draw(const DrawnRun& drawn, std::optional<double> at_s,
                            const OverlayArguments& words, Output& output) {
  Mission mission = drawn.run.log.mission;
  mission.arena.patches.insert(mission.arena.patches.end(), drawn.run.scored.patches.begin(),
                               drawn.run.scored.patches.end());
  const View view = drawn.run.rig.view_of(drawn.run.rig.cameras[drawn.camera]).value();
  const OverlayRun overlay(drawn.run.tracked, drawn.run.rig, mission, drawn.run.scored.issues);
  const std::vector<double>& times = drawn.run.observations.cameras[drawn.camera].frame_times;
  const double start_s = drawn.run.starts_s[drawn.camera];
  auto source = FrameSource::open(drawn.videos[drawn.camera].string());
  if (!source) return Unexpected(source.error());
  const double from_s = at_s.value_or(-kAround_s);
  const double until_s = overlay.duration_s() + kAround_s;
  constexpr double kRounding_s = 5e-7;  // of the clocks' differences
  if (at_s && !times.empty()) {
    const double first_s = times.front() - start_s;
    const double last_s = std::min(times.back() - start_s, until_s);
    if (*at_s < first_s - kRounding_s || *at_s > last_s + kRounding_s) {
      return Unexpected(Error{ErrorKind::BadInput,
                              fmt::format("the video has no frame there: it shows the run from "
                                          "{:.2f} s to {:.2f} s",
                                          first_s, last_s),
                              "--at"});
    }
  }
  Sink sink(words.out, at_s.has_value());
  Counter drawing(output, "drew", "frames");
  std::size_t next = 0;
  for (std::size_t frame = 0; frame < times.size(); ++frame) {
    const auto more = (*source)->next();
    if (!more) return Unexpected(more.error());
    if (!*more) break;
    const double time_s = times[frame] - start_s;
    if (time_s < from_s - kRounding_s) continue;
    if (time_s > until_s) break;
    ColorImage image = (*source)->color();
    draw_overlay(image, view, mission, overlay.at(time_s),
                 tags_of(drawn, static_cast<std::int64_t>(frame), times[frame], next));
    if (auto added = sink.add(image, time_s, (*source)->info().frame_rate); !added)
      return Unexpected(added.error());
    drawing.tell(static_cast<std::int64_t>(frame + 1), static_cast<std::int64_t>(times.size()));
    if (at_s) break;
  }
  if (auto finished = sink.finish(); !finished) return Unexpected(finished.error());
  if (sink.count() > 0) return sink.count();
  return Unexpected(Error{ErrorKind::BadInput, "the video has no frame there", words.out});
}

/// The value of `--at`, in seconds of the run.
Expected<std::optional<double>> instant_of(const OverlayArguments& words) {
  if (words.at.empty()) return std::optional<double>();
  // As `--start`: 12.4 or "12.4 s".
  std::optional<double> value = parse_seconds(words.at);
  if (!value) value = parse_seconds(words.at + " s");
  if (!value || !std::isfinite(*value))
    return bad_input("\"" + words.at + "\" is not a time, such as 12.4 or \"12.4 s\"", "--at");
  if (!words.out.ends_with(".png")) return bad_input("one picture is a .png", "-o");
  return value;
}

ExitCode overlay(const OverlayArguments& words, Output& output) {
  const auto at_s = instant_of(words);
  if (!at_s) return fail(output, ExitCode::Usage, at_s.error());
  const bool is_stored =
      words.run.videos.size() == 1 && id_from_text<RealRunTag>(words.run.videos[0]).has_value();
  if (!is_stored && words.run.arena.empty())
    return fail(output, ExitCode::Usage,
                "a video needs its arena file: --arena FILE; a stored run is called r7");
  const auto flaw =
      is_folder(words.out) ? flaw_of_new_folder(words.out) : flaw_of_new_output(words.out);
  if (flaw) return fail(output, exit_code_of_tracking(*flaw), *flaw);
  auto run = is_stored ? run_of_store(words) : run_of_videos(words, output);
  if (!run) return fail(output, run.error());
  if (const auto wrong = settle_video(words, *run)) return fail(output, *wrong);
  const auto drawn = draw(*run, *at_s, words, output);
  if (!drawn) return fail(output, exit_code_of_tracking(drawn.error()), drawn.error());
  if (output.json)
    output.out << JsonObject().add("file", words.out).add("frames", *drawn).text() << "\n";
  else
    output.out << words.out << ": " << counted(*drawn, "frame") << "\n";
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_overlay(Options& options) {
  auto words = std::make_shared<OverlayArguments>();
  ScoreArguments& run = words->run;
  options.words("RUN|VIDEO RUN|FILE", run.videos, "A stored run, r7, or its videos, one per camera",
                Options::Need::Required);
  options.text("-o,--output FILE", words->out,
               "Video (.mp4, .mkv), a folder (DIR/), or one .png; never overwritten",
               Options::Need::Required);
  options.text("--store STORE", run.store, "Store of the run (else SWARMSMITH_STORE)");
  options.text("--video FILE", words->video, "Where a stored run's video is now");
  options.text("--camera CAMERA", words->camera,
               "Camera, if there are several (default: the first)");
  options.text("--at SECONDS", words->at,
               "Write one picture, at this time after the start of the run: 12.4 s");
  options.text("--arena FILE", run.arena, "Arena file of a run that is not stored");
  options.text("--run FILE", run.run, "Run log of a run that is not stored");
  options.text("--mission MISSION|FILE", run.mission, "Mission, of a run that is not stored");
  run.begin.declare(options);
  options.text("--patches FILE", run.patches, "Colour patches: a CSV with seed,x,y,color");
  options.texts("--times FILE", run.times,
                "CSV with a time for each frame, one per video: frame,time_s");
  options.flag("--accept-tag-as-centre", run.takes_tags_for_centres,
               "Draw robots without an offset calibration at their tags");
  return [words](Output& output) { return overlay(*words, output); };
}

}  // namespace swarmsmith
