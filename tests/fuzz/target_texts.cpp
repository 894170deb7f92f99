#include <cmath>
#include <string>

#include "programs/output.h"
#include "programs/words.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

void check_output(std::string_view text, const Target& target) {
  constexpr double kBound = 1e6;
  const auto reading = parse_runner_output(text, target, kBound);
  if (!reading) return require(!reading.error().message.empty(), "a refusal has a sentence");
  require(!std::isnan(reading->cost), "a cost is a number");
  const bool said = reading->time >= target.min_measurable_time && reading->time <= kBound + 1;
  require(reading->time == 0 || said, "a time is above 0 and within its bound");
}

void check_words(std::string_view text) {
  const auto split = split_words(text);
  if (!split || split->needs_shell) return;
  std::string again;
  for (const std::string& word : split->words)
    again += shell_quoted(word) + " ";
  require(split_words(again)->words == split->words, "quoted words read back as the same");
}

}  // namespace

/// What programs print, and command lines as they come from a user's files.
void run(std::string_view input) {
  Target plain;
  Target timed;
  timed.prints_time = true;
  Target judged;
  judged.evaluator = "/e";
  Target aclib;
  aclib.aclib = true;
  for (const Target* target : {&plain, &timed, &judged, &aclib})
    check_output(input, *target);
  if (const auto cost = parse_evaluator_output(input, judged)) {
    require(!std::isnan(cost->cost), "a cost is a number");
  }
  if (const auto job = parse_job_id(input)) require(job->front() != '-', "a job is not an option");
  constexpr std::size_t kLongest = 40;
  const std::string shown = printable(input, kLongest);
  require(shown.size() <= kLongest, "what is shown has its length");
  require(printable(shown, kLongest) == shown, "what is shown can be shown");
  check_words(input);
}

}  // namespace swarmsmith::fuzz
