#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "base/plain_text.h"
#include "base/text/json.h"
#include "robot/app/commands.h"
#include "robot/log/log_file.h"
#include "robot/runtime/replay.h"

namespace swarmsmith {
namespace {

/// Exits with 0 if the commands are the same, 1 if they differ, 2 if the log cannot be read.
ExitCode replay(const std::string& file, Output& output) {
  const auto record = read_robot_log(file);
  if (!record) {
    for (const Error& error : record.error())
      print_error(output, error);
    return ExitCode::Usage;
  }
  const auto replayed = replay_log(*record);
  if (!replayed) {
    Error error = replayed.error();
    error.where = file + (error.where.empty() ? "" : ": " + error.where);
    return fail(output, ExitCode::Usage, error);
  }
  const auto& difference = replayed->difference;
  const auto& end = record->head.end;
  if (output.json) {
    JsonObject json;
    json.add("file", file).add("run", record->head.run).add("robot", record->head.robot);
    json.add("stepped", replayed->stepped).add("same", !difference.has_value());
    if (difference) json.add("cycle", difference->cycle).add("difference", difference->what);
    json.add("verdict", end ? std::string(name_of(end->verdict)) : "INVALID");
    output.out << json.text() << "\n";
  } else if (difference) {
    output.out << fmt::format("{}: cycle {}: {}\n", file, difference->cycle, difference->what);
  } else {
    output.out << fmt::format(
        "{}: {}, all commands as the controller gives them; {}\n", file,
        counted(replayed->stepped, "cycle"),
        end ? name_of(end->verdict) : "INVALID: the node did not end the run");
  }
  return difference ? ExitCode::Failed : ExitCode::Done;
}

ExitCode replay_all(const std::vector<std::string>& files, Output& output) {
  ExitCode worst = ExitCode::Done;
  for (const std::string& file : files)
    worst = std::max(worst, replay(file, output));
  return worst;
}

}  // namespace

CommandRun declare_robot_replay(Options& options) {
  auto files = std::make_shared<std::vector<std::string>>();
  options.words("LOG FILE", *files, "Logs: run07.rvr1.log.csv or run07.rvr1.toml",
                Options::Need::Required);
  return [files](Output& output) { return replay_all(*files, output); };
}

}  // namespace swarmsmith
