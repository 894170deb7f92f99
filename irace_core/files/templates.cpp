#include "irace_core/files/templates.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "irace_core/files/number_text.h"
#include "irace_core/files/options.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kParameters = R"(# What is tuned, one parameter per line:
#
#   name  "switch"  type  (domain)  | condition
#
# switch     stands before the value on the target's command line, as it is: end it with a blank or
#            with = if the target wants that
# type       c  one of some values without an order   (a, b, "with, comma")
#            o  one of some values in an order        (low, middle, high)
#            i  a whole number                        (1, 100)
#            r  a number                              (0, 1), with as many decimals as `digits` says
#            i,log and r,log: as likely from 1 to 10 as from 10 to 100; the domain is positive
# condition  of R: the parameter exists only where it holds; most need none
#
# The bounds of a number may depend on other numbers: (0, max(0, states - 2)).

algorithm  "--algorithm "  c      (climb, swap)
strength   "--strength "   r      (0, 5)
swaps      "--swaps "      i,log  (1, 1000)  | algorithm == "swap"
restart    "--restart "    o      (never, rarely, often)

# Combinations that must not be tried, one per line:
[forbidden]
algorithm == "climb" & restart == "never"

[global]
digits = 2
)";

constexpr std::string_view kTargetRunner = R"(#!/bin/sh
# Runs your program once, and prints its cost: a number, the smaller the better.
#
#   target-runner ID INSTANCE_ID SEED INSTANCE SWITCHES...
#
# ID           number of the configuration
# INSTANCE_ID  number of the instance in its list
# SEED         seed for random numbers; the same for all configurations on an instance
# INSTANCE     the line of the list of instances; with blanks in it, it is several words here
# SWITCHES     the configuration: switches and values of parameters.txt
#
# With boundMax in the scenario the bound stands before SWITCHES; with maxTime the time of the run
# must follow the cost. Any other output is an error (on standard error it is for people; but
# R's irace reads that, too), and so is an exit status other than 0. `Inf` as a cost means: never
# try this configuration again.
set -eu
seed=$3
instance=$4
shift 4

# Run your own program here, for instance:
#
#   cost=$(solver --instance "$instance" --seed "$seed" "$@" 2>/dev/null | tail -n 1)
#   echo "$cost"
#
# Instead, this example computes a formula with a little noise.
algorithm='' strength=0 swaps=0 restart=''
while [ $# -gt 0 ]; do
  case $1 in
    --algorithm) algorithm=$2 ;;
    --strength) strength=$2 ;;
    --swaps) swaps=$2 ;;
    --restart) restart=$2 ;;
    *)
      echo "unknown switch $1"
      exit 1
      ;;
  esac
  shift 2
done

awk -v seed="$seed" -v size="$instance" -v algorithm="$algorithm" -v strength="$strength" \
  -v swaps="$swaps" -v restart="$restart" 'BEGIN {
    srand(seed)
    cost = (strength - 3.2) ^ 2 + (restart == "rarely" ? 0 : 1)
    if (algorithm == "climb") cost += 2
    else cost += (log(swaps) - log(40)) ^ 2 / 4
    printf "%.6f\n", size * (cost + rand())
  }'
)";

constexpr std::string_view kInstances =
    R"(# What each configuration is tried on, one instance per line. The whole line goes to the target-runner;
# with trainInstancesDir in the scenario, that folder is put before it.
10
20
30
50
80
)";

constexpr std::string_view kConfigurations =
    R"(# Configurations to start with, for instance the defaults: the names of the parameters, then one
# configuration per line. NA stands for a parameter whose condition does not hold.
algorithm  strength  swaps  restart
climb      1.00      NA     often
swap       2.50      100    rarely
)";

/// Options that the scenario of the example sets.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kSet = {{
    {"parameterFile", "\"./parameters.txt\""},
    {"configurationsFile", "\"./configurations.txt\""},
    {"trainInstancesFile", "\"./instances-list.txt\""},
    {"targetRunner", "\"./target-runner\""},
    {"maxExperiments", "300"},
}};

std::string wrapped_comment(const std::string& text) {
  constexpr std::size_t kCommentWidth = 78;
  std::string result;
  std::string line = "#";
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (line.size() + 1 + end - begin > kCommentWidth && line.size() > 1) {
      result += line + "\n";
      line = "#";
    }
    line += " " + text.substr(begin, end - begin);
    begin = end + 1;
  }
  return result + line + "\n";
}

/// The default in the form of a scenario file.
std::string default_text(const IraceOption& option) {
  if (option.initial == "NA") return "NA";
  const auto value = irace_value_of(option, option.initial);
  return value && !option.initial.empty() ? irace_value_text(*value) : "\"\"";
}

std::string explained(const IraceOption& option) {
  std::string text(option.help);
  if (option.kind == IraceKind::Choice) {
    text += ":";
    for (const std::string& word : irace_words(option))
      text += " " + word;
  }
  if (!option.remark.empty()) text += " (" + std::string(option.remark) + ")";
  return wrapped_comment(text);
}

std::string scenario() {
  std::string text =
      "# Options of `swarmsmith irace`, which reads this file by default when it is called\n# in "
      "this folder. A line that begins with # is a comment: remove the # to set an option.\n# "
      "Paths are relative to this file's folder.\n";
  for (const IraceOption& option : irace_options()) {
    const bool is_listed = option.meaning == IraceMeaning::Supported && !option.name.empty() &&
                           option.name != "scenarioFile" && option.kind != IraceKind::Texts;
    if (!is_listed) continue;
    std::string line = "# " + std::string(option.name) + " = " + default_text(option);
    for (const auto& [name, value] : kSet) {
      if (name == option.name) line = std::string(name) + " = " + std::string(value);
    }
    text += "\n" + explained(option) + line + "\n";
  }
  return text;
}

}  // namespace

std::vector<IraceTemplate> irace_templates() {
  return {
      {"scenario.txt", scenario()},
      {"parameters.txt", std::string(kParameters)},
      {"target-runner", std::string(kTargetRunner), true},
      {"instances-list.txt", std::string(kInstances)},
      {"configurations.txt", std::string(kConfigurations)},
  };
}

}  // namespace swarmsmith
