#include <fmt/format.h>

#include <functional>
#include <memory>
#include <optional>

#include "base/plain_text.h"
#include "base/text/json.h"
#include "cli/arguments/store_argument.h"
#include "cli/commands/commands.h"
#include "cli/commands/compared_runs.h"
#include "cli/commands/real_replay_command.h"
#include "cli/output/progress_text.h"
#include "cli/replay/recording.h"
#include "cli/replay/stored_runs.h"

namespace swarmsmith::cli {
namespace {

struct ReplayArguments {
  std::string id;
  StoreArgument store;
  std::optional<std::int64_t> seed;
  std::optional<std::int64_t> sample;
  std::optional<std::int64_t> beside;
  std::string seeds;
  RecordingArguments recording;

  /// The real run that the arguments name, if any.
  std::optional<RealRunId> real_run() const {
    const auto thing = parse_thing_id(id);
    if (!thing || thing->letter != 'r') return std::nullopt;
    return RealRunId{std::stoll(thing->digits)};
  }
};

std::string hexadecimal(std::uint64_t digest) {
  return fmt::format("{:016x}", digest);
}

std::string as_json(const StoredRun& run, const Measured& result) {
  JsonObject object;
  object.add("id", run.id.empty() ? std::nullopt : std::optional(run.id))
      .add("candidate", run.candidate)
      .add("seed", run.seed)
      .add("score", result.score);
  std::optional<double> score;
  std::optional<bool> same;
  std::optional<std::string> digest;
  if (run.outcome) {
    score = run.outcome->score;
    same = same_bits(*run.outcome, result);
    digest = hexadecimal(run.outcome->state_digest);
  }
  return object.add("stored_score", score)
             .add("same_bits", same)
             .add("digest", hexadecimal(result.state_digest))
             .add("stored_digest", digest)
             .add("engine", engine_version_of(run.mission, run.profile))
             .add("stored_engine", run.engine_version)
             .text() +
         "\n";
}

/// The line with the result of the comparison.
std::string as_line(const StoredRun& run, const Measured& result) {
  const std::string values = values_text(result.score, result.state_digest);
  if (run.outcome) return name_of(run) + ": same bits as stored: " + values;
  return name_of(run) + ": " + values +
         (run.rejected ? "; the store holds no score to compare with: it was rejected"
                       : "; the store holds no such evaluation to compare with");
}

/// The text about the run in a picture, besides the mission and the times.
std::vector<std::string> details_of(const StoredRun& run, const Measured& result) {
  return {run.candidate, "seed " + std::to_string(run.seed), "score " + score_text(result.score)};
}

ExitCode replay_one(const StoredRun& run, const ReplayArguments& arguments, Output& output) {
  auto recording = Recording::start(arguments.recording, run.mission, run.controller, output);
  if (!recording) return fail(output, exit_code_of_recording(recording.error()), recording.error());
  const Measured result = simulate(run.setup(), recording->recorder());
  const auto written = recording->finish(details_of(run, result), run.instance);
  if (!written) return fail(output, ExitCode::Failed, written.error());
  const bool differs = run.outcome && !same_bits(*run.outcome, result);
  if (output.json) {
    output.out << as_json(run, result);
  } else if (!differs && arguments.recording.takes_standard_output()) {
    print_note(output, as_line(run, result));
  } else if (!differs) {
    output.out << as_line(run, result) << "\n";
  }
  if (!differs) return ExitCode::Done;
  return fail(output, ExitCode::Failed, difference_text(run, result));
}

/// The run that the arguments name.
Expected<StoredRun> find_run(StoredRuns& runs, const ReplayArguments& arguments) {
  const auto id = parse_thing_id(arguments.id);
  if (!id || id->letter == 'd') {
    return bad_input("\"" + arguments.id +
                         "\" is not an evaluation (e81200007, see `ls evaluations`), a candidate "
                         "with a seed (c812 --seed 7), or a real run (r7)",
                     "ID");
  }
  if (id->letter == 'e') {
    if (arguments.seed) return bad_input("an evaluation has its own seed", "--seed");
    return runs.evaluation(*id);
  }
  if (!arguments.seed) return bad_input("no seed given; add one, such as --seed 7", arguments.id);
  return runs.candidate(*id, *arguments.seed);
}

/// Prints every difference as a separate error; the answer contains the number of differences.
ExitCode replay_sample(StoredRuns& runs, std::int64_t count, Output& output) {
  if (!runs.has_machines()) return fail(output, ExitCode::Usage, programs_scored("--sample"));
  const auto ids = runs.sample(count);
  if (!ids) return fail(output, ExitCode::Store, ids.error());
  Counter counter(output, "replayed", "evaluations");
  const auto different = compare_again(runs, *ids, counter);
  if (!different) return fail(output, ExitCode::Failed, different.error());
  for (const Difference& difference : *different)
    print_error(output, {ErrorKind::Conflict, difference.sentence, ""});
  const std::size_t same = ids->size() - different->size();
  if (output.json) {
    output.out << JsonObject()
                      .add("replayed", ids->size())
                      .add("same_bits", same)
                      .add("different", json_list(*different, std::mem_fn(&Difference::id)))
                      .text()
               << "\n";
  } else {
    output.out << counted(ids->size(), "evaluation") << " replayed, " << same
               << " with the same bits as stored\n";
  }
  return different->empty() ? ExitCode::Done : ExitCode::Failed;
}

/// Finds arguments that make no sense together, before any store is opened.
std::optional<Error> complaint_about(const ReplayArguments& arguments) {
  const bool has_company = arguments.beside || !arguments.seeds.empty();
  if (has_company && !arguments.real_run()) {
    return Error{ErrorKind::BadInput, "applies to a real run, such as r7",
                 arguments.beside ? "--beside" : "--seeds"};
  }
  if (arguments.real_run() && arguments.seed) {
    return Error{ErrorKind::BadInput,
                 "a real run has no seed; --seeds names those of simulations beside it", "--seed"};
  }
  if (!arguments.sample) {
    if (!arguments.id.empty()) return std::nullopt;
    return Error{ErrorKind::BadInput, "is required: an evaluation such as e81200007", "ID"};
  }
  if (arguments.recording.any() || arguments.seed) {
    return Error{ErrorKind::BadInput,
                 "replays many evaluations; --csv, --svg and --seed apply to one", "--sample"};
  }
  return std::nullopt;
}

ExitCode run_replay(ReplayArguments arguments, Output& output) {
  // With --sample there is no id, so the first argument is the store.
  if (arguments.sample && arguments.store.word.empty())
    std::swap(arguments.id, arguments.store.word);
  auto complaint = complaint_about(arguments);
  if (!complaint && arguments.sample && !arguments.id.empty()) {
    complaint = Error{ErrorKind::BadInput, "takes no ID", "--sample"};
  }
  if (complaint) return fail(output, ExitCode::Usage, *complaint);
  auto store = arguments.store.open();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  if (const auto real = arguments.real_run(); real && !arguments.sample) {
    return replay_real(std::move(*store),
                       {.id = *real,
                        .beside = arguments.beside,
                        .seeds = arguments.seeds,
                        .recording = arguments.recording},
                       output);
  }
  auto runs = StoredRuns::open(std::move(*store));
  if (!runs) return fail(output, ExitCode::Store, runs.error());
  if (arguments.sample) return replay_sample(*runs, *arguments.sample, output);
  const auto found = find_run(*runs, arguments);
  if (!found) {
    const bool missing = found.error().kind == ErrorKind::NotFound;
    return fail(output, missing ? ExitCode::NoSuchId : ExitCode::Usage, found.error());
  }
  return replay_one(*found, arguments, output);
}

}  // namespace

CommandRun declare_replay(Options& options) {
  constexpr std::int64_t kLargest = 2'147'483'647;
  auto arguments = std::make_shared<ReplayArguments>();
  options.text("ID CANDIDATE|RUN", arguments->id,
               "An evaluation (e81200007), a candidate (c812) with --seed, or a real run (r7)");
  arguments->store.declare(options);
  options.integer("--seed", arguments->seed, {1, kLargest}, "Seed of a candidate's run");
  options.integer("--sample", arguments->sample, {1, kLargest},
                  "Replay N stored evaluations, evenly spaced, instead of one");
  options.integer("--beside", arguments->beside, {1, 1000},
                  "Simulate a real run's machine N times beside it");
  options.text("--seeds SEEDS", arguments->seeds,
               "Seeds of the simulations beside a real run: 1-4,9");
  arguments->recording.declare(options);
  return [arguments](Output& output) { return run_replay(*arguments, output); };
}

}  // namespace swarmsmith::cli
