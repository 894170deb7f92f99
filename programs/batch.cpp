#include "programs/batch.h"

#include <array>
#include <cctype>
#include <sstream>

#include "base/assert.h"
#include "programs/output.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

/// Enough for a controller that restarts, which takes minutes.
constexpr int kMostSilences = 150;
constexpr milliseconds kAnswerLimit = std::chrono::seconds(60);
constexpr milliseconds kEndLimit = std::chrono::seconds(5);

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;)
    words.push_back(word);
  return words;
}

/// qstat of Grid Engine exits with 0 as long as it knows the job.
JobState judge_sge(const ProcessEnd& answer) {
  if (answer.exit_code == 0) return JobState::Waits;
  const bool gone = has(answer.errors.text, "do not exist") || has(answer.errors.text, "unknown");
  return gone || answer.errors.text.empty() ? JobState::Ended : JobState::Unknown;
}

/// qstat of PBS and Torque prints a table; the fifth column is the state, C or F if the job is
/// over. Exit codes 153 (unknown job) and 35 (finished) come from PBS itself.
JobState judge_pbs(const ProcessEnd& answer) {
  constexpr int kUnknownJob = 153;
  constexpr int kFinished = 35;
  if (answer.exit_code == kUnknownJob || answer.exit_code == kFinished) return JobState::Ended;
  if (answer.exit_code != 0) {
    const bool gone = has(answer.errors.text, "Unknown Job") || answer.errors.text.empty();
    return gone ? JobState::Ended : JobState::Unknown;
  }
  std::istringstream lines(answer.output.text);
  std::vector<std::string> last;
  for (std::string line; std::getline(lines, line);) {
    if (const auto words = words_of(line); words.size() >= 6) last = words;
  }
  if (last.empty()) return JobState::Ended;
  const std::string& state = last[last.size() - 2];
  return state == "C" || state == "F" || state == "X" ? JobState::Ended : JobState::Waits;
}

/// squeue prints one word, the state, for jobs that wait, run or complete, and nothing for finished
/// ones.
JobState judge_slurm(const ProcessEnd& answer) {
  if (answer.exit_code != 0) {
    const bool gone = has(answer.errors.text, "Invalid job id") || answer.errors.text.empty();
    return gone ? JobState::Ended : JobState::Unknown;
  }
  constexpr std::array kAlive = {"PENDING",      "RUNNING",       "SUSPENDED", "CONFIGURING",
                                 "COMPLETING",   "REQUEUED",      "RESIZING",  "STOPPED",
                                 "REQUEUE_HOLD", "SIGNALING",     "STAGE_OUT", "SPECIAL_EXIT",
                                 "REQUEUE_FED",  "RESV_DEL_HOLD", "STAGING"};
  for (const std::string& word : words_of(answer.output.text)) {
    for (const std::string_view alive : kAlive) {
      if (word == alive) return JobState::Waits;
    }
  }
  return JobState::Ended;
}

/// condor_q prints JobStatus as a number: 3 is removed, 4 is completed; nothing if the job is not
/// in the queue.
JobState judge_condor(const ProcessEnd& answer) {
  if (answer.exit_code != 0) {
    return answer.errors.text.empty() ? JobState::Ended : JobState::Unknown;
  }
  for (const std::string& word : words_of(answer.output.text)) {
    if (word != "3" && word != "4") return JobState::Waits;
  }
  return JobState::Ended;
}

struct System {
  BatchMode mode;
  BatchCommands commands;
  JobState (*judge)(const ProcessEnd& answer);
};

const System& system_of(BatchMode mode) {
  static const std::array<System, 5> kSystems{{
      {BatchMode::Sge, {{"qstat", "-j"}, {"qdel"}}, judge_sge},
      {BatchMode::Pbs, {{"qstat"}, {"qdel"}}, judge_pbs},
      {BatchMode::Torque, {{"qstat"}, {"qdel"}}, judge_pbs},
      {BatchMode::Slurm, {{"squeue", "-h", "-o", "%T", "-j"}, {"scancel"}}, judge_slurm},
      {BatchMode::HtCondor,
       {{"condor_q", "-format", "%d\n", "JobStatus"}, {"condor_rm"}},
       judge_condor},
  }};
  for (const System& system : kSystems) {
    if (system.mode == mode) return system;
  }
  SWARMSMITH_ASSERT(false, "a batch system is asked only in batch mode");
  return kSystems[0];
}

std::vector<std::string> with_job(std::vector<std::string> words, const std::string& job) {
  words.push_back(job);
  return words;
}

}  // namespace

const BatchCommands& commands_of(BatchMode mode) {
  return system_of(mode).commands;
}

JobState state_of_job(BatchMode mode, const ProcessEnd& answer) {
  if (answer.why != ProcessEnd::Why::Itself || answer.signal != 0) return JobState::Unknown;
  return system_of(mode).judge(answer);
}

Expected<void> wait_for_job(BatchMode mode, const std::string& job, milliseconds poll,
                            const Interrupt& interrupt) {
  const BatchCommands& commands = commands_of(mode);
  int silences = 0;
  while (!interrupt.wait_ms(static_cast<int>(poll.count()))) {
    const ProcessCall ask{.words = with_job(commands.ask, job), .limit = kAnswerLimit};
    const Expected<ProcessEnd> answer = run_process(ask, interrupt);
    if (!answer) return Unexpected(answer.error());
    const JobState state = state_of_job(mode, *answer);
    if (state == JobState::Ended) return {};
    silences = state == JobState::Unknown ? silences + 1 : 0;
    if (silences < kMostSilences) continue;
    return unexpected(ErrorKind::Unavailable, commands.ask[0] +
                                                  " does not report the state of job " + job +
                                                  ": " + printable(answer->errors.text, 500));
  }
  // The caller does not wait for the job any more. This last call is not interrupted.
  const Interrupt none;
  const Expected<ProcessEnd> ended =
      run_process({.words = with_job(commands.end, job), .limit = kEndLimit}, none);
  return unexpected(ErrorKind::Unavailable,
                    "interrupted; job " + job + (ended ? " was cancelled" : " may still run"));
}

}  // namespace swarmsmith
