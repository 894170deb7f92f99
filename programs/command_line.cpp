#include "programs/command_line.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "programs/words.h"

namespace swarmsmith {
namespace {

using Replacement = std::pair<std::string_view, std::string>;

std::string replaced(std::string_view text, const std::vector<Replacement>& replacements) {
  std::string out;
  while (!text.empty()) {
    const Replacement* found = nullptr;
    if (text.front() == '{') {
      for (const Replacement& one : replacements) {
        if (text.starts_with(one.first)) found = &one;
      }
    }
    if (found == nullptr) {
      out += text.front();
      text.remove_prefix(1);
    } else {
      out += found->second;
      text.remove_prefix(found->first.size());
    }
  }
  return out;
}

std::string bound_of(const RunnerCall& call) {
  return call.bound > 0 ? plain_number(call.bound) : "";
}

std::string aclib_arguments(const RunnerCall& call) {
  const std::string bound = bound_of(call);
  return (bound.empty() ? "" : "--cutoff " + bound + " ") + "--instance " + call.instance +
         " --seed " + std::to_string(call.seed) + " --config " + call.switches;
}

bool has_word(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

}  // namespace

std::vector<std::string> faults_of_command_line(std::string_view command_line, bool capping) {
  std::vector<std::string> faults;
  const auto want = [&](std::string_view name, const char* why) {
    if (has_word(command_line, name)) return;
    faults.push_back("the command line of the targetRunner must contain " + std::string(name) +
                     why);
  };
  want("{seed}", ", so that all configurations are tried under the same conditions");
  want("{instance}", ", so that the program knows what to run on");
  want("{targetRunnerArgs}", ", where the configuration's switches and values go");
  if (capping) want("{bound}", " with capping, so that the program knows when to give up");
  return faults;
}

std::string arguments_of(const Target& target, const RunnerCall& call) {
  const std::string runner = shell_quoted(target.runner);
  std::string arguments = target.aclib
                              ? aclib_arguments(call)
                              : replaced(target.command_line,
                                         {{"{configurationID}", std::to_string(call.configuration)},
                                          {"{instanceID}", call.instance_id},
                                          {"{seed}", std::to_string(call.seed)},
                                          {"{instance}", call.instance},
                                          {"{bound}", bound_of(call)},
                                          {"{targetRunnerArgs}", call.switches},
                                          {"{targetRunner}", runner}});
  const bool has_place = !target.aclib && has_word(target.command_line, "{targetRunner}");
  if (!target.launcher.empty() && !has_place) arguments.insert(0, runner + " ");
  return arguments;
}

std::string arguments_of(const EvaluatorCall& call) {
  std::string out = std::to_string(call.configuration) + " " + call.instance_id + " " +
                    std::to_string(call.seed) + " " + call.instance + " " +
                    std::to_string(call.alive.size());
  for (const std::int64_t id : call.alive)
    out += " " + std::to_string(id);
  return out;
}

std::string plain_number(double value) {
  // Rounds to 15 digits first; then the shortest text of the rounded number has at most 15 digits.
  std::array<char, 40> digits{};
  const int length = std::snprintf(digits.data(), digits.size(), "%.15g", value);
  double rounded = value;
  std::from_chars(digits.data(), digits.data() + length, rounded);
  std::array<char, 400> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), rounded, std::chars_format::fixed);
  return {text.data(), end.ptr};
}

}  // namespace swarmsmith
