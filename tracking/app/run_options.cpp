#include "tracking/app/run_options.h"

#include "base/id.h"
#include "base/text/whole_file.h"
#include "sim/files/mission_file.h"
#include "sim/mission/instance_csv.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

/// Without the options, the log says when the run begins.
void check_start(const RunLog& log, std::vector<Error>& errors) {
  if (!log.start.time_s && log.start.sync == RunStart::Sync::None && errors.empty()) {
    errors.push_back(wrong_option(
        "the start of the run is unknown; give it in the run log (`start` or `sync`) or by "
        "--start, --sync-hidden or --sync-shown; the first frame is not the start",
        "--start"));
  }
}

/// Reads `--design d3` or 3, `--candidate c812` or 812.
void take_control(const ScoreArguments& arguments, RunLog& log, std::vector<Error>& errors) {
  const auto lettered = [](const std::string& word, char letter) {
    const bool is_number = word.find_first_not_of("0123456789") == std::string::npos;
    return is_number ? letter + word : word;
  };
  if (!arguments.design.empty() && !arguments.candidate.empty()) {
    errors.push_back(wrong_option(
        "a candidate belongs to a design; give --design or --candidate, not both", "--candidate"));
  }
  if (!arguments.design.empty()) {
    log.design = lettered(arguments.design, 'd');
    log.candidate.clear();
    if (!id_from_text<DesignTag>(log.design)) {
      errors.push_back(
          wrong_option("\"" + arguments.design + "\" is not a design such as d3", "--design"));
    }
  }
  if (!arguments.candidate.empty()) {
    log.candidate = lettered(arguments.candidate, 'c');
    log.design.clear();
    if (!id_from_text<CandidateTag>(log.candidate)) {
      errors.push_back(wrong_option(
          "\"" + arguments.candidate + "\" is not a candidate such as c812", "--candidate"));
    }
  }
}

void take_patches(const ScoreArguments& arguments, RunLog& log, std::vector<Error>& errors) {
  if (arguments.patches.empty()) return;
  log.layout = {};
  if (arguments.patches == "measured") {
    log.layout.source = RunLayout::Source::Measured;
    return;
  }
  const auto text = read_file(arguments.patches, "patch");
  if (!text) return errors.push_back(text.error());
  const auto by_seed = parse_patches_csv(*text);
  if (!by_seed) {
    Error error = by_seed.error();
    error.where = arguments.patches + ":" + error.where;
    return errors.push_back(std::move(error));
  }
  if (by_seed->size() != 1) {
    return errors.push_back(wrong_option("expected the patches of one run; the file has those of " +
                                             std::to_string(by_seed->size()) + " seeds",
                                         arguments.patches));
  }
  log.layout.source = RunLayout::Source::Log;
  log.layout.patches = by_seed->begin()->second;
}

}  // namespace

Error wrong_option(const std::string& text, const std::string& option) {
  return error_of(IssueCode::Config, text, option);
}

std::vector<Error> take_start(const StartArguments& arguments, RunLog& log) {
  std::vector<Error> errors;
  const int given = (arguments.start.empty() ? 0 : 1) + (arguments.sync_hidden ? 1 : 0) +
                    (arguments.sync_shown ? 1 : 0);
  if (given > 1) {
    errors.push_back(
        wrong_option("use only one of --start, --sync-hidden and --sync-shown", "--start"));
  }
  if (given > 0) log.start = {};
  if (!arguments.start.empty()) {
    log.start.time_s = parse_seconds(arguments.start);
    if (!log.start.time_s) log.start.time_s = parse_seconds(arguments.start + " s");
    if (!log.start.time_s || !(*log.start.time_s > -1e12 && *log.start.time_s < 1e12)) {
      errors.push_back(
          wrong_option("`--start` must be a time, such as 12.4 or \"12.4 s\"; this is "
                       "\"" +
                           arguments.start + "\"",
                       "--start"));
    }
  }
  if (arguments.sync_hidden) {
    log.start.sync_tag = static_cast<int>(*arguments.sync_hidden);
    log.start.sync = RunStart::Sync::Hidden;
  }
  if (arguments.sync_shown) {
    log.start.sync_tag = static_cast<int>(*arguments.sync_shown);
    log.start.sync = RunStart::Sync::Shown;
  }
  return errors;
}

std::vector<Error> take_options(const ScoreArguments& arguments, RunLog& log) {
  std::vector<Error> errors = take_start(arguments.begin, log);
  check_start(log, errors);
  take_control(arguments, log, errors);
  take_patches(arguments, log, errors);
  if (!arguments.mission.empty()) {
    auto mission = find_mission(arguments.mission, "");
    if (mission) {
      log.mission = std::move(mission->mission);
    } else {
      for (Error& error : mission.error())
        errors.push_back(error_of(IssueCode::Config, std::move(error.message),
                                  error.where.empty() ? "--mission" : std::move(error.where)));
    }
  }
  if (!arguments.name.empty()) {
    log.name = arguments.name;
    if (!is_name(log.name)) {
      errors.push_back(
          wrong_option("a name must consist of letters, digits, `_`, `-` and `.`", "--name"));
    }
  }
  if (!arguments.recorded.empty()) {
    const auto dated = parse_run_log("format = 1\nrecorded = " + arguments.recorded + "\n", "");
    if (dated && dated->recorded == arguments.recorded) {
      log.recorded = dated->recorded;
    } else {
      errors.push_back(wrong_option(
          "`--recorded` must be a date, such as 2026-11-21; this is \"" + arguments.recorded + "\"",
          "--recorded"));
    }
  }
  return errors;
}

}  // namespace swarmsmith
