#include "programs/output.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/shown_text.h"
#include "programs/command_line.h"
#include "programs/cost.h"
#include "programs/internal/aclib.h"
#include "programs/number.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kShownBytes = 60;

bool is_blank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// The first `most` tokens, and one more if there are more.
std::vector<std::string_view> tokens_of(std::string_view text, std::size_t most) {
  std::vector<std::string_view> tokens;
  while (tokens.size() <= most) {
    const auto* begin = std::find_if_not(text.begin(), text.end(), is_blank);
    const auto* end = std::find_if(begin, text.end(), is_blank);
    if (begin == end) break;
    tokens.emplace_back(begin, static_cast<std::size_t>(end - begin));
    text = {end, static_cast<std::size_t>(text.end() - end)};
  }
  return tokens;
}

std::string shown(std::string_view token) {
  const bool cut = token.size() > kShownBytes;
  return "`" + printable(token.substr(0, kShownBytes), 4 * kShownBytes) + (cut ? "..." : "") + "`";
}

/// Reads a number from the output, or returns an error. `what`: "cost", "time".
Expected<double> number_of(std::string_view token, const std::string& program,
                           const std::string& what) {
  const std::optional<double> number = parse_number(token);
  if (!number) {
    return bad_input("the " + what + " that the " + program +
                     " printed is not a number: " + shown(token));
  }
  if (std::isnan(*number)) {
    return bad_input("the " + what + " that the " + program + " printed is " + std::string(token) +
                     "; print Inf for a configuration that is useless");
  }
  if (std::isfinite(*number) && is_too_large(*number)) {
    return bad_input("the " + what + " that the " + program + " printed, " + std::string(token) +
                     ", is beyond 1e300; print Inf for a configuration that is useless");
  }
  return *number;
}

Expected<double> time_of(std::string_view token, const std::string& program, const Target& target) {
  const Expected<double> time = number_of(token, program, "time");
  if (!time) return time;
  return checked_time(*time, program, target);
}

std::string wanted_of_runner(const Target& target) {
  if (!target.evaluator.empty()) {
    return target.prints_time ? "one number, the time" : "nothing, or one number, the time";
  }
  return target.prints_time ? "two numbers, cost and time"
                            : "one number, the cost, or two, cost and time";
}

Unexpected wrong_count(const std::string& program, std::string_view output, bool too_many,
                       const std::string& wanted) {
  const std::string found = output.empty() ? "nothing" : too_many ? "more" : "less";
  return bad_input("the " + program + " printed " + found + " than it should: it must print " +
                   wanted);
}

Expected<Reading> check_bound(Reading reading, const Target& target, double bound) {
  if (bound <= 0 || reading.time <= bound + target.min_measurable_time) return reading;
  return bad_input("the targetRunner reports a time of " + plain_number(reading.time) +
                   ", but had to stop at " + plain_number(bound));
}

Expected<Reading> parse_numbers(std::string_view output, const Target& target) {
  static const std::string kProgram = "targetRunner";
  const bool has_cost = target.evaluator.empty();
  const std::size_t most = has_cost ? 2 : 1;
  const std::size_t least = (has_cost ? 1U : 0U) + (target.prints_time ? 1U : 0U);
  const auto tokens = tokens_of(output, most);
  if (tokens.empty() && least > 0) {
    return bad_input("the targetRunner printed nothing: it must print " + wanted_of_runner(target));
  }
  // Text that is not a number is a more useful error than a wrong number of tokens.
  for (const std::string_view token : tokens) {
    if (!parse_number(token)) {
      return bad_input("the targetRunner printed text that is not a number, " + shown(token) +
                       ": it must print " + wanted_of_runner(target) + ", and nothing else");
    }
  }
  if (tokens.size() > most || tokens.size() < least) {
    return wrong_count(kProgram, output, tokens.size() > most, wanted_of_runner(target));
  }
  Reading reading;
  if (has_cost) {
    const Expected<double> cost = number_of(tokens[0], kProgram, "cost");
    if (!cost) return Unexpected(cost.error());
    reading.cost = *cost;
  }
  if (tokens.size() == most) {
    const Expected<double> time = time_of(tokens[most - 1], kProgram, target);
    if (!time) return Unexpected(time.error());
    reading.time = *time;
  }
  return reading;
}

}  // namespace

Expected<double> checked_time(double time, const std::string& program, const Target& target) {
  if (!std::isfinite(time) || time <= 0) {
    return bad_input("the time that the " + program + " reports, " +
                     (std::isfinite(time) ? plain_number(time) : std::string("infinite")) +
                     ", must be finite and above 0");
  }
  return std::max(time, target.min_measurable_time);
}

Expected<Reading> parse_runner_output(std::string_view output, const Target& target, double bound) {
  Expected<Reading> reading =
      target.aclib ? parse_aclib(output, target) : parse_numbers(output, target);
  if (!reading) return reading;
  return check_bound(*reading, target, bound);
}

Expected<Reading> parse_evaluator_output(std::string_view output, const Target& target) {
  static const std::string kProgram = "targetEvaluator";
  const bool may_say_time = target.batch_mode != BatchMode::None;
  const std::string wanted =
      may_say_time ? "one number, the cost, or two, cost and time" : "one number, the cost";
  const std::size_t most = may_say_time ? 2 : 1;
  const auto tokens = tokens_of(output, most);
  if (tokens.empty())
    return bad_input("the targetEvaluator printed nothing: it must print " + wanted);
  for (const std::string_view token : tokens) {
    if (!parse_number(token)) {
      return bad_input("the targetEvaluator printed text that is not a number, " + shown(token) +
                       ": it must print " + wanted + ", and nothing else");
    }
  }
  if (tokens.size() > most) return wrong_count(kProgram, output, true, wanted);
  const Expected<double> cost = number_of(tokens[0], kProgram, "cost");
  if (!cost) return Unexpected(cost.error());
  Reading reading{.cost = *cost, .time = 0};
  if (tokens.size() == 2) {
    const Expected<double> time = time_of(tokens[1], kProgram, target);
    if (!time) return Unexpected(time.error());
    reading.time = *time;
  }
  return reading;
}

Expected<std::string> parse_job_id(std::string_view output) {
  constexpr std::string_view kAllowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._[]-";
  const auto tokens = tokens_of(output, 1);
  const bool fine = tokens.size() == 1 && tokens[0][0] != '-' &&
                    tokens[0].find_first_not_of(kAllowed) == std::string_view::npos;
  if (fine) return std::string(tokens[0]);
  return bad_input("in batch mode the targetRunner must print only the id of its job; it printed " +
                   (tokens.empty() ? std::string("nothing") : shown(output)));
}

std::string printable(std::string_view text, std::size_t longest) {
  std::string out = as_shown(text);
  if (out.size() <= longest) return out;
  constexpr std::string_view kCut = "...";
  std::string_view end = std::string_view(out).substr(out.size() - (longest - kCut.size()));
  while (!end.empty() && is_continuation(end.front()))
    end.remove_prefix(1);
  return std::string(kCut) + std::string(end);
}

}  // namespace swarmsmith
