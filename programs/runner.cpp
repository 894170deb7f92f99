#include "programs/runner.h"

#include <cmath>
#include <cstring>
#include <utility>

#include "base/plain_text.h"
#include "programs/batch.h"
#include "programs/words.h"

namespace swarmsmith {
namespace {

bool is_simple(std::string_view word) {
  const Expected<Words> split = split_words(word);
  return split && !split->needs_shell && split->words.size() == 1 && split->words[0] == word;
}

/// A program's path as a user would type it.
std::string typed(const std::string& program) {
  return is_simple(program) ? program : shell_quoted(program);
}

std::string name_of_signal(int number) {
  const char* name = sigabbrev_np(number);
  return name == nullptr ? std::to_string(number) : "SIG" + std::string(name);
}

std::string section(const char* title, const std::string& text) {
  const bool closed = text.ends_with('\n');
  return std::string("\n") + title + "\n" + text + (closed ? "" : "\n");
}

}  // namespace

TargetRunner::TargetRunner(Target target, RunnerOptions options, const Interrupt& interrupt)
    : target_(std::move(target)), options_(std::move(options)), interrupt_(&interrupt) {}

TargetFailure TargetRunner::failure(const Command& command, const ProcessEnd* end,
                                    std::string reason) const {
  TargetFailure failure;
  failure.reason = std::move(reason);
  failure.details.command = printable(command.text, options_.longest_text);
  if (end == nullptr) return failure;
  const auto text = [&](const Captured& captured) {
    std::string shown = printable(captured.text, options_.longest_text);
    const bool marked = shown.starts_with("...") || captured.complete();
    return marked ? shown : printable("..." + shown, options_.longest_text);
  };
  failure.details.output = text(end->output);
  failure.details.errors = text(end->errors);
  failure.timed_out = end->why == ProcessEnd::Why::Limit;
  failure.from_outside = end->why == ProcessEnd::Why::Itself && end->signal != 0;
  return failure;
}

tl::expected<TargetRunner::Command, TargetFailure> TargetRunner::command(
    const std::string& program, const std::string& arguments) const {
  Command command;
  command.text = typed(program) + " " + arguments;
  command.process.folder = target_.folder;
  command.process.term_grace = options_.term_grace;
  command.process.limit = std::chrono::seconds(target_.timeout_s);
  if (options_.file_of) {
    Expected<std::string> file = options_.file_of(program);
    if (!file) return tl::unexpected(failure(command, nullptr, to_string(file.error())));
    command.process.file = std::move(*file);
  }
  Expected<Words> split = split_words(arguments);
  if (!split) {
    return tl::unexpected(failure(command, nullptr,
                                  "the command line cannot be parsed: " + split.error().message +
                                      " (" + split.error().where + " of the arguments)"));
  }
  if (!split->needs_shell) {
    command.process.words = std::move(split->words);
    command.process.words.insert(command.process.words.begin(), program);
  } else if (options_.shell) {
    command.process.file.clear();  // a shell may run any program, so the file is not fixed
    command.process.words = {"/bin/sh", "-c", shell_quoted(program) + " " + arguments};
  } else {
    return tl::unexpected(failure(
        command, nullptr,
        "its command line has the character " + printable({&*split->needs_shell, 1}, 8) +
            ", which only a shell understands, and this worker may not run one: put it in quotes, "
            "or start the worker with --allow-shell"));
  }
  return command;
}

tl::expected<ProcessEnd, TargetFailure> TargetRunner::call(const Command& command,
                                                           const std::string& role) const {
  Expected<ProcessEnd> end = run_process(command.process, *interrupt_);
  if (!end)
    return tl::unexpected(
        failure(command, nullptr, "the " + role + " did not run: " + end.error().message));
  switch (end->why) {
    case ProcessEnd::Why::Interrupted:
      return tl::unexpected(failure(command, &*end, "the " + role + " was interrupted"));
    case ProcessEnd::Why::Limit:
      return tl::unexpected(failure(command, &*end,
                                    "the " + role + " did not end within " +
                                        counted(target_.timeout_s, "second") +
                                        " (targetRunnerTimeout), and was "
                                        "killed"));
    case ProcessEnd::Why::Itself:
      break;
  }
  if (end->signal != 0) {
    return tl::unexpected(
        failure(command, &*end, "the " + role + " was killed by " + name_of_signal(end->signal)));
  }
  if (end->exit_code != 0) {
    return tl::unexpected(failure(command, &*end,
                                  "the " + role + " ended with exit status " +
                                      std::to_string(end->exit_code) + ", which is not 0"));
  }
  return std::move(*end);
}

tl::expected<TargetResult, TargetFailure> TargetRunner::run_once(const Command& command,
                                                                 double bound) const {
  const auto end = call(command, "targetRunner");
  if (!end) return tl::unexpected(end.error());
  if (target_.batch_mode != BatchMode::None) {
    const Expected<std::string> job = parse_job_id(end->output.text);
    if (!job) return tl::unexpected(failure(command, &*end, job.error().message));
    const Expected<void> done =
        wait_for_job(target_.batch_mode, *job, options_.batch_poll, *interrupt_);
    if (!done) return tl::unexpected(failure(command, &*end, done.error().message));
    return TargetResult{};
  }
  if (!target_.aclib && !end->output.complete()) {
    return tl::unexpected(failure(command, &*end,
                                  "the targetRunner printed " + std::to_string(end->output.size) +
                                      " bytes to standard output; expected one or two numbers"));
  }
  const Expected<Reading> reading = parse_runner_output(end->output.text, target_, bound);
  if (!reading) return tl::unexpected(failure(command, &*end, reading.error().message));
  return TargetResult{*reading, std::isinf(reading->cost)};
}

/// With a launcher, the file is looked up for the runner's name, too.
tl::expected<TargetRunner::Command, TargetFailure> TargetRunner::runner_command(
    const RunnerCall& call) const {
  if (target_.launcher.empty()) return command(target_.runner, arguments_of(target_, call));
  if (!options_.file_of) return command(target_.launcher, arguments_of(target_, call));
  Target target = target_;
  Expected<std::string> file = options_.file_of(target_.runner);
  if (!file) {
    return tl::unexpected(
        failure({.process = {}, .text = typed(target_.runner)}, nullptr, to_string(file.error())));
  }
  target.runner = std::move(*file);
  return command(target_.launcher, arguments_of(target, call));
}

tl::expected<TargetResult, TargetFailure> TargetRunner::run(const RunnerCall& call) const {
  for (std::int64_t attempt = 1;; ++attempt) {
    const auto made = runner_command(call);
    if (!made) return tl::unexpected(made.error());
    auto result = run_once(*made, call.bound);
    if (result || interrupt_->triggered()) return result;
    if (attempt <= target_.retries) continue;
    if (result.error().timed_out && target_.timeout_is_rejection) return TargetResult{{}, true};
    if (attempt > 1)
      result.error().reason += " (the last of " + std::to_string(attempt) + " tries)";
    return result;
  }
}

tl::expected<TargetResult, TargetFailure> TargetRunner::evaluate(const EvaluatorCall& call) const {
  const auto made = command(target_.evaluator, arguments_of(call));
  if (!made) return tl::unexpected(made.error());
  const auto end = this->call(*made, "targetEvaluator");
  if (!end) return tl::unexpected(end.error());
  const Expected<Reading> reading = parse_evaluator_output(end->output.text, target_);
  if (!reading) return tl::unexpected(failure(*made, &*end, reading.error().message));
  return TargetResult{*reading, std::isinf(reading->cost)};
}

std::string message_of(const std::string& reason, const FailureDetails& details) {
  std::string text = reason;
  if (details.command.empty()) return text;
  text += section("The call was:", details.command);
  text += details.output.empty() ? std::string("It printed nothing to standard output.\n")
                                 : section("Its output was:", details.output).substr(1);
  if (!details.errors.empty())
    text += section("It wrote to standard error:", details.errors).substr(1);
  return text +
         "This is a fault of the program or of how it is called: run the call by hand in the "
         "scenario's execDir, and see what it prints.\n";
}

}  // namespace swarmsmith
