#include <fmt/format.h>
#include <algorithm>
#include <memory>
#include <numeric>

#include "base/output_file.h"
#include "base/plain_text.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "tracking/app/calibrate_sources.h"
#include "tracking/app/commands.h"
#include "tracking/app/refusal.h"
#include "tracking/app/written_files.h"
#include "tracking/calibration/calibration_report.h"
#include "tracking/calibration/find_board.h"
#include "tracking/rig/calibration_limits.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

/// In a video, about `kLooks` pictures are searched for the board, and at most `kMostViews` of them
/// are used.
constexpr std::int64_t kLooks = 300;
constexpr std::size_t kMostViews = 40;

struct CameraArguments {
  std::vector<std::string> words;
  std::string board;
  std::string file;
  std::string lens = "pinhole";
  std::string arena;
  std::string camera;
  std::string map;
};

/// The file for the calibration, and whether a place was calibrated with the file that it replaces.
struct Target {
  std::string file;
  bool has_place = false;
};

/// The file of `-o`, or else the `model` of the camera in the arena file, or else a name from the
/// camera's name.
tl::expected<Target, std::vector<Error>> target_of(const CameraArguments& arguments) {
  Target target;
  if (arguments.arena.empty()) {
    target.file = (arguments.camera.empty() ? "ceiling" : arguments.camera) + ".camera.toml";
  } else {
    const auto rig = read_rig(arguments.arena);
    if (!rig) return tl::unexpected(rig.error());
    const auto camera = camera_of(*rig, arguments.camera);
    if (!camera) return tl::unexpected(std::vector<Error>{camera.error()});
    target = {beside(arguments.arena, camera->model_file),
              rig->places.contains(camera->place_file)};
    forget_input(target.file);
  }
  if (!arguments.file.empty()) target.file = arguments.file;
  return target;
}

/// The boards that were found. Boards in videos are kept separately, because only different views
/// of them are used.
struct Finds {
  ImageSize size;
  std::vector<BoardView> views;
  std::vector<BoardSight> of_video;
  std::int64_t looked_at = 0;
  bool has_smaller = false;  ///< the user counted squares of a chessboard instead of corners
};

constexpr std::int64_t kLooksForSmaller = 10;

/// Whether the board has one row and one column less than specified.
bool has_one_row_less(const GrayImage& image, const Board& board) {
  if (board.kind != Board::Kind::Chessboard || board.columns < 4 || board.rows < 4) return false;
  Board smaller = board;
  --smaller.columns;
  --smaller.rows;
  return find_board(image, smaller).has_value();
}

std::string name_of_frame(const PictureSource& source, const FrameSource& frames) {
  const Frame& frame = frames.frame();
  return frame.file.empty() ? fmt::format("{} frame {}", source.word, frame.number) : frame.file;
}

Expected<bool> look(const PictureSource& source, const FrameSource& frames, const Board& board,
                    Finds& finds) {
  finds.size = frames.info().size;
  const std::int64_t every =
      source.is_video ? std::max<std::int64_t>(1, frames.info().expected_frames / kLooks) : 1;
  if (frames.frame().number % every != 0) return true;
  ++finds.looked_at;
  auto sight = find_board(frames.frame().gray, board);
  if (!sight && !finds.has_smaller && finds.looked_at <= kLooksForSmaller)
    finds.has_smaller = has_one_row_less(frames.frame().gray, board);
  if (!sight) return true;
  sight->view.name = name_of_frame(source, frames);
  if (source.is_video) {
    finds.of_video.push_back(std::move(*sight));
  } else {
    finds.views.push_back(std::move(sight->view));
  }
  return true;
}

std::string solution_json(const CameraSolution& solution, const std::vector<BoardView>& views,
                          const std::string& file) {
  const CameraCalibration& calibration = solution.calibration;
  const CameraModel& model = calibration.model;
  const auto view_json = [&](std::size_t i) {
    return JsonObject()
        .add("name", views[i].name)
        .add("corners", views[i].seen.size())
        .add("rms_px", solution.views[i].rms_px)
        .add("dropped", solution.views[i].dropped);
  };
  std::vector<std::size_t> numbers(views.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return JsonObject()
             .add("file", file)
             .add("width", model.size.width)
             .add("height", model.size.height)
             .add("lens", model.lens == Lens::Fisheye ? "fisheye" : "pinhole")
             .add("fx", model.fx)
             .add("fy", model.fy)
             .add("cx", model.cx)
             .add("cy", model.cy)
             .add("distortion", model.distortion)
             .add("rms_px", calibration.rms_px)
             .add("worst_view_px", calibration.worst_view_px)
             .add("focal_sigma_px", calibration.focal_sigma_px)
             .add("coverage", calibration.coverage)
             .add("ninths", solution.ninths)
             .add("views_used", calibration.views)
             .add("views_dropped", calibration.views_dropped)
             .add("views", json_list(numbers, view_json))
             .text() +
         "\n";
}

/// Report and map are written even for a refused calibration, because they show the reason.
Expected<void> write_map(const CameraSolution& solution, const std::vector<BoardView>& views,
                         const std::string& file) {
  if (file.empty()) return {};
  return write_whole_file(file, residual_map_svg(solution, views));
}

ExitCode solve(const CameraArguments& arguments, const Target& target, const Board& board,
               const Finds& finds, Output& output) {
  const Lens lens = arguments.lens == "fisheye" ? Lens::Fisheye : Lens::Pinhole;
  print_note(output, fmt::format("the board is in {} of {}; solving",
                                 finds.views.size() + finds.of_video.size(),
                                 counted(finds.looked_at, "picture")));
  std::vector<BoardView> views = finds.views;
  for (const std::size_t i : pick_views(finds.of_video, board, finds.size, kMostViews))
    views.push_back(finds.of_video[i].view);
  auto solution = solve_camera(views, finds.size, lens);
  if (!solution) return fail_all(output, {solution.error()});
  CameraCalibration& calibration = solution->calibration;
  calibration.board = board_text(board);
  calibration.made = utc_now();
  if (const auto drawn = write_map(*solution, views, arguments.map); !drawn)
    return fail(output, ExitCode::Failed, drawn.error());
  const std::vector<Error> faults = faults_of(calibration);
  if (!output.json) output.out << report_text(*solution, views);
  if (!faults.empty()) return fail_all(output, faults);
  if (const auto written = write_whole_file(target.file, calibration_text(calibration)); !written)
    return fail(output, ExitCode::Failed, written.error());
  if (output.json) output.out << solution_json(*solution, views, target.file);
  print_cautions(output, cautions_of(calibration));
  print_note(output, "wrote " + target.file);
  if (target.has_place) {
    print_note(output,
               "note: the camera's place was found with its last calibration; next: `swarmsmith "
               "track calibrate arena --again --arena " +
                   command_word(arguments.arena) + "`");
  }
  return ExitCode::Done;
}

ExitCode run(const CameraArguments& arguments, Output& output) {
  const auto board = parse_board(arguments.board);
  if (!board) return fail(output, ExitCode::Usage, board.error());
  const auto target = target_of(arguments);
  if (!target) return fail_all(output, target.error());
  if (const auto own = each_its_own_file({{"--output", target->file}, {"--map", arguments.map}});
      !own)
    return fail(output, ExitCode::Usage, own.error());
  auto flaw = flaw_of_calibration_output(target->file, CalibrationKind::Camera);
  if (!flaw) flaw = flaw_of_output(arguments.map);
  if (flaw) return fail(output, exit_code_of_tracking(*flaw), *flaw);
  Finds finds;
  const auto looked = for_each_picture(
      arguments.words,
      [&](const PictureSource& source, const FrameSource& frames) {
        return look(source, frames, *board, finds);
      },
      output);
  if (!looked) return fail(output, exit_code_of_tracking(looked.error()), looked.error());
  if (finds.views.empty() && finds.of_video.empty() && finds.has_smaller) {
    Board right = *board;
    --right.columns;
    --right.rows;
    return fail_all(
        output, {error_of(IssueCode::CalibrationQuality,
                          "this board is in none of the pictures, but one of " +
                              std::to_string(right.columns) + " x " + std::to_string(right.rows) +
                              " inner corners is: count the inner corners of a chessboard, "
                              "not its squares; use --board " +
                              board_text(right),
                          arguments.board)});
  }
  return solve(arguments, *target, *board, finds, output);
}

}  // namespace

CommandRun declare_calibrate_camera(Options& options) {
  auto arguments = std::make_shared<CameraArguments>();
  options.words("PICTURES FILE", arguments->words,
                "Pictures of the board, folders of them, or a video or bag of it",
                Options::Need::Required);
  options.text("--board BOARD", arguments->board,
               "The board: charuco:COLUMNSxROWS:SQUARE:MARKER:DICTIONARY or "
               "chessboard:COLUMNSxROWS:SQUARE, edges in metres as measured on paper",
               Options::Need::Required);
  options.text("--arena FILE", arguments->arena, "Arena file, which names the file to write");
  options.text("--camera CAMERA", arguments->camera,
               "The camera's name, if the arena has several (without an arena: ceiling)");
  options.text("-o,--output FILE", arguments->file,
               "File to write (default: the camera's `model` of the arena file, else its name and "
               ".camera.toml)");
  options.choice("--lens", arguments->lens, {"pinhole", "fisheye"},
                 "Model of the lens; fisheye for over about 100 degrees");
  options.text("--map FILE", arguments->map,
               "Draw the corners' residuals over the frame into this .svg");
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith
