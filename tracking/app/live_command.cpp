#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "base/plain_text.h"
#include "base/process/stop_signal.h"
#include "base/text/json.h"
#include "console/terminal.h"
#include "sim/files/mission_file.h"
#include "tracking/app/calibrate_sources.h"
#include "tracking/app/commands.h"
#include "tracking/app/recording.h"
#include "tracking/app/refusal.h"
#include "tracking/calibration/board_watch.h"
#include "tracking/live/delays.h"
#include "tracking/live/live_pages.h"
#include "tracking/live/live_tracker.h"
#include "tracking/live/newest_frame.h"
#include "tracking/rig/issue.h"
#include "tracking/rig/rig_file.h"
#include "tracking/video/video_writer.h"

namespace swarmsmith {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t kPort = 8080;
constexpr std::chrono::milliseconds kPatience{200};

struct LiveWords {
  std::string arena;
  std::string source;
  std::string view;
  std::string mission;
  std::optional<std::int64_t> port;
  std::string record;
  std::string board;
};

/// On a terminal one line that is overwritten, otherwise a new line now and then.
class StatusLine {
 public:
  explicit StatusLine(Output& output) : output_(&output) {}

  void tell(const LiveState& state) {
    const auto now = Clock::now();
    if (output_->quiet || now < next_) return;
    const bool terminal = output_->err_is_terminal;
    next_ = now + (terminal ? std::chrono::milliseconds(500) : std::chrono::seconds(5));
    output_->err << (terminal ? kClearLine : Verbatim{}) << live_state_line(state)
                 << (terminal ? "" : "\n") << std::flush;
    shown_ = terminal;
  }
  void clear() {
    if (shown_) output_->err << kClearLine << std::flush;
  }

 private:
  Output* output_;
  Clock::time_point next_ = Clock::now();
  bool shown_ = false;
};

/// Records the frames as they arrive.
class LiveRecording {
 public:
  static Expected<LiveRecording> open(const std::string& file, const SourceInfo& info) {
    if (const auto right = check_recording_name(file); !right) return Unexpected(right.error());
    VideoOptions options;
    options.live = true;
    if (info.frame_rate > 0) options.frame_rate = info.frame_rate;
    auto writer = VideoWriter::open(file, info.size, options);
    if (!writer) return Unexpected(writer.error());
    return LiveRecording(file, std::move(*writer), Sidecar(file, info.is_live));
  }

  Expected<void> add(FrameSource& source, double time_s) {
    if (!first_s_) first_s_ = time_s;
    if (!times_.is_later(time_s - *first_s_)) return {};
    auto written = writer_.write(source.color(), time_s - *first_s_);
    if (!written) return written;
    return times_.add(frames_++, time_s - *first_s_, time_s);
  }
  Expected<void> finish() {
    auto finished = writer_.finish();
    if (frames_ == 0) {
      remove_recording(file_);
      return Unexpected(error_of(IssueCode::VideoUnreadable, "no frame came", file_));
    }
    if (!finished) return finished;
    return times_.finish();
  }

 private:
  LiveRecording(std::string file, VideoWriter writer, Sidecar times)
      : file_(std::move(file)), writer_(std::move(writer)), times_(std::move(times)) {}

  std::string file_;
  VideoWriter writer_;
  Sidecar times_;
  std::int64_t frames_ = 0;
  std::optional<double> first_s_;
};

struct Watched {
  std::int64_t frames = 0;
  std::int64_t dropped = 0;
  LiveDelays delays;
  std::optional<Error> error;
};

/// Runs until the source ends or the user stops it.
Watched watch(FrameSource& source, LiveTracker& tracker, BoardWatch* board, LivePages& pages,
              LiveRecording* recording, Output& output) {
  NewestFrame::OnFrame keep;
  if (recording != nullptr)
    keep = [recording](FrameSource& from, double time_s) { return recording->add(from, time_s); };
  NewestFrame newest(source, keep);
  StatusLine line(output);
  Watched watched;
  while (stop_signal() == 0 && !newest.has_ended()) {
    newest.wants_color(pages.is_watched());
    auto frame = newest.take(kPatience);
    if (!frame) continue;
    LiveState state = tracker.look_at(frame->image(), frame->number, frame->time_s);
    if (board != nullptr) state.board = board->look_at(frame->image(), frame->time_s);
    state.delay_s = std::chrono::duration<double>(Clock::now() - frame->in).count();
    watched.delays.add(state.delay_s);
    state.most_delay_s = watched.delays.latest_most_s();
    state.dropped = newest.dropped();
    ++watched.frames;
    line.tell(state);
    pages.publish(std::move(state), std::move(frame->color));
  }
  line.clear();
  watched.dropped = newest.dropped();
  watched.error = newest.error();
  return watched;
}

ExitCode answer(Watched& watched, Output& output) {
  const double median_ms = 1000 * watched.delays.quantile_s(0.5);
  const double late_ms = 1000 * watched.delays.quantile_s(0.95);
  const double most_ms = 1000 * watched.delays.quantile_s(1);
  if (output.json) {
    const JsonObject delay =
        JsonObject().add("median", median_ms).add("p95", late_ms).add("most", most_ms);
    output.out << JsonObject()
                      .add("frames", watched.frames)
                      .add("dropped", watched.dropped)
                      .add("delay_ms", delay)
                      .text()
               << "\n";
  } else {
    output.out << counted(watched.frames, "frame") << ", " << watched.dropped << " dropped; delay "
               << std::lround(median_ms) << " ms, 95 % within " << std::lround(late_ms)
               << " ms, at most " << std::lround(most_ms) << " ms\n";
  }
  return ExitCode::Done;
}

ExitCode live(const LiveWords& words, Output& output) {
  const auto failed = [&](const Error& error) {
    return fail(output, exit_code_of_tracking(error), error);
  };
  auto rig = read_rig(words.arena);
  if (!rig) return fail_all(output, rig.error());
  const auto camera = camera_of(*rig, words.view, "--view");
  if (!camera) return failed(camera.error());
  // The preview shows pictures without a place, too, but positions from a wrong one would mislead.
  for (const Error& misfit : misfits_of_place(*rig, *camera)) {
    print_note(output, "note: " + to_string(misfit) + "; until then no positions are shown");
    rig->places.erase(camera->place_file);
  }
  std::optional<BoardWatch> board;
  if (!words.board.empty()) {
    const auto parsed = parse_board(words.board);
    if (!parsed) return failed(parsed.error());
    board.emplace(*parsed);
  }
  LiveScenery scenery;
  if (!words.mission.empty()) {
    auto mission = find_mission(words.mission, "");
    if (!mission) return fail_all(output, mission.error());
    scenery.mission = std::move(mission->mission);
  }
  catch_stop_signals();
  auto source = FrameSource::open(words.source);
  if (!source) return failed(source.error());
  std::optional<Arena> arena;
  if (scenery.mission) arena = scenery.mission->arena;
  auto tracker = LiveTracker::of(*rig, *camera, std::move(arena));
  if (!tracker) return failed(tracker.error());
  if (tracker->view() && tracker->view()->camera.size == (*source)->info().size)
    scenery.view = tracker->view();
  const auto pages = LivePages::start(static_cast<int>(words.port.value_or(kPort)), scenery);
  if (!pages) return failed(pages.error());
  std::unique_ptr<LiveRecording> recording;
  if (!words.record.empty()) {
    auto opened = LiveRecording::open(words.record, (*source)->info());
    if (!opened) return failed(opened.error());
    recording = std::make_unique<LiveRecording>(std::move(*opened));
  }
  if (!output.quiet) output.err << "Preview: " << (*pages)->address() << std::endl;
  Watched watched =
      watch(**source, *tracker, board ? &*board : nullptr, **pages, recording.get(), output);
  if (recording != nullptr) {
    if (const auto ended = recording->finish(); !ended && !watched.error)
      watched.error = ended.error();
  }
  if (watched.error) return failed(*watched.error);
  return answer(watched, output);
}

}  // namespace

CommandRun declare_live(Options& options) {
  auto words = std::make_shared<LiveWords>();
  options.text("--arena FILE", words->arena, "Arena file", Options::Need::Required);
  options.text("--camera CAMERA|FILE", words->source,
               "What to watch: camera:0, an address, a video file, a folder of images, a bag",
               Options::Need::Required);
  options.text("--view CAMERA", words->view, "Camera of the arena file, if it has several");
  options.text("--mission MISSION|FILE", words->mission,
               "Mission whose floor is drawn: a name or a file");
  options.integer("--port", words->port, {0, 65'535},
                  "Port of the preview on 127.0.0.1 (default 8080; 0: a free one)");
  options.text("--board BOARD", words->board,
               "Board in front of the camera: show which parts of the frame its views cover so "
               "far (as for calibrate camera)");
  options.text("--record FILE", words->record,
               "Record all frames, a .mkv, with their times beside it");
  return [words](Output& output) { return live(*words, output); };
}

}  // namespace swarmsmith
