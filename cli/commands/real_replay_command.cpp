#include "cli/commands/real_replay_command.h"

#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "analysis/arena/arena_picture.h"
#include "analysis/drawing/svg.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "cli/output/progress_text.h"
#include "cli/replay/real_replay.h"
#include "console/seeds.h"
#include "console/terminal.h"

namespace swarmsmith::cli {
namespace {

Expected<std::vector<std::int64_t>> seeds_of(const RealReplayWords& words) {
  if (words.beside && !words.seeds.empty())
    return bad_input("says how many, --seeds says which: give one of them", "--beside");
  if (!words.seeds.empty()) return parse_seeds(words.seeds);
  std::vector<std::int64_t> seeds(static_cast<std::size_t>(words.beside.value_or(0)));
  std::iota(seeds.begin(), seeds.end(), 1);
  return seeds;
}

Expected<double> width_of(const RecordingArguments& recording) {
  for (const auto& [text, option] :
       {std::pair(&recording.readings, "--readings"),
        std::pair(&recording.objects_csv, "--objects-csv"), std::pair(&recording.at, "--at"),
        std::pair(&recording.from, "--from"), std::pair(&recording.to, "--to")}) {
    if (!text->empty())
      return bad_input("applies to simulations; a real run takes --svg, --csv and --width", option);
  }
  if (recording.width.empty()) return 174.0;
  const double width_mm = millimetres_from_text(recording.width);
  if (width_mm >= kLeastPictureWidth_mm && width_mm <= kMostPictureWidth_mm) return width_mm;
  return bad_input(
      "a picture is 40mm to 1000mm wide (also cm, in), not \"" + recording.width + "\"", "--width");
}

Expected<void> write(const std::string& file, const std::string& bytes, Output& output) {
  if (file.empty()) return {};
  if (file != "-") return write_whole_file(file, bytes);
  write_data(output, bytes);
  return {};
}

std::string as_json(const RealReplay& replay, RealRunId id, bool same) {
  const std::optional<double> stored = replay.rows.score.score;
  const auto run_json = [](const ShownRun& run) {
    return JsonObject().add("source", run.source).add("seed", run.seed).add("score", run.score);
  };
  return JsonObject()
             .add("id", id)
             .add("candidate", replay.rows.candidate)
             .add("score", replay.score)
             .add("stored_score", stored)
             .add("same_bits", stored ? std::optional(same) : std::nullopt)
             .add("verdict", replay.verdict)
             .add("starts_as_real", replay.starts_as_real)
             .add("beside", json_list(std::span(replay.runs).subspan(1), run_json))
             .text() +
         "\n";
}

std::string as_text(const RealReplay& replay, RealRunId id) {
  std::string text = to_string(id) + ": ";
  text +=
      replay.rows.score.score ? "same score as stored: " : "no score is stored; its cycles give ";
  text += json_number(replay.score) + ", " + replay.verdict + "\n";
  for (const ShownRun& run : replay.runs) {
    if (&run == &replay.runs.front()) continue;
    text += run.source + ", seed " + std::to_string(run.seed) + ": score " +
            json_number(run.score) + "\n";
  }
  if (!replay.starts_as_real)
    text += "the simulations start elsewhere: simulated robots cannot start at the real places\n";
  return text;
}

}  // namespace

ExitCode replay_real(std::unique_ptr<StoreReader> store, const RealReplayWords& words,
                     Output& output) {
  const auto seeds = seeds_of(words);
  if (!seeds) return fail(output, ExitCode::Usage, seeds.error());
  const auto width_mm = width_of(words.recording);
  if (!width_mm) return fail(output, ExitCode::Usage, width_mm.error());
  const int to_output = (words.recording.csv == "-" ? 1 : 0) +
                        (words.recording.svg == "-" ? 1 : 0) + (output.json ? 1 : 0);
  if (words.recording.takes_standard_output() && to_output > 1) {
    return fail(
        output, ExitCode::Usage,
        Error{ErrorKind::BadInput, "only one of --csv -, --svg - and --json can write to it",
              "standard output"});
  }
  if (const auto own = words.recording.check_files(); !own)
    return fail(output, ExitCode::Usage, own.error());
  const auto replay = replay_real_run(std::move(store), words.id, *seeds);
  if (!replay) {
    const ErrorKind kind = replay.error().kind;
    return fail(output,
                kind == ErrorKind::NotFound  ? ExitCode::NoSuchId
                : kind == ErrorKind::Corrupt ? ExitCode::Store
                                             : ExitCode::Usage,
                replay.error());
  }
  if (!words.recording.svg.empty()) {
    const auto written =
        write(words.recording.svg, picture_of(*replay, words.id, *width_mm), output);
    if (!written) return fail(output, ExitCode::Failed, written.error());
  }
  if (!words.recording.csv.empty()) {
    const auto written = write(words.recording.csv, table_of(*replay, words.id), output);
    if (!written) return fail(output, ExitCode::Failed, written.error());
  }
  const std::optional<double> stored = replay->rows.score.score;
  const bool same = !stored || *stored == replay->score;
  if (output.json) output.out << as_json(*replay, words.id, same);
  if (!same) {
    return fail(output, ExitCode::Failed,
                to_string(words.id) + ": the stored cycles score " + json_number(replay->score) +
                    "; the store holds " + json_number(*stored));
  }
  if (output.json) return ExitCode::Done;
  if (words.recording.takes_standard_output()) {
    print_note(output, as_text(*replay, words.id));
  } else {
    output.out << as_text(*replay, words.id);
  }
  return ExitCode::Done;
}

}  // namespace swarmsmith::cli
