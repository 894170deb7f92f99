#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "console/declared.h"
#include "console/exit_code.h"
#include "console/output.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace swarmsmith {

/// The store in SWARMSMITH_STORE; empty if it is not set.
std::string store_of_environment();

/// Declares the options and arguments of a command. Names are "--budget", "-o,--output FILE" or,
/// for an argument, "FILE". The text after the name is the kind of the value, for the help and for
/// completion: "--profile PROFILE|FILE" is a profile or a file. For an argument, the name is the
/// kind, unless a kind follows: "ID DESIGN|RUN". The referenced values must exist until the command
/// has run.
class Options {
 public:
  explicit Options(CLI::App& app) : app_(&app) {}

  enum class Need { Optional, Required };

  void flag(const std::string& names, bool& value, const std::string& help);
  void text(const std::string& names, std::string& value, const std::string& help,
            Need need = Need::Optional);
  /// A repeatable option: one text each time.
  void texts(const std::string& names, std::vector<std::string>& values, const std::string& help);
  /// All remaining arguments.
  void words(const std::string& name, std::vector<std::string>& values, const std::string& help,
             Need need = Need::Optional);
  /// One of `choices`; the help lists them.
  void choice(const std::string& names, std::string& value, const std::vector<std::string>& choices,
              const std::string& help, Need need = Need::Optional);
  /// Like `choice` above, but translates the words to values: "floats" is WheelsForm::Floats.
  template <class Value>
  void choice(const std::string& names, Value& value,
              const std::vector<std::pair<std::string, Value>>& choices, const std::string& help) {
    std::vector<std::string> words;
    for (const auto& [word, meaning] : choices)
      words.push_back(word);
    choose(names, words, help, [&value, choices](std::size_t i) { value = choices[i].second; });
  }
  struct Range {
    std::int64_t least;
    std::int64_t most;
  };
  /// The value stays nullopt if the option is not given. As in campaign files, the digits may be
  /// grouped with underscores: 100_000.
  void integer(const std::string& names, std::optional<std::int64_t>& value, Range range,
               const std::string& help);
  /// A number; as in text(), its unit follows the name. The value does not change if the option is
  /// not given.
  struct Bounds {
    double least;
    double most;
  };
  void number(const std::string& names, double& value, Bounds bounds, const std::string& help);
  void number(const std::string& names, std::optional<double>& value, Bounds bounds,
              const std::string& help);
  /// Adds lines below the options, above the command's details.
  void explain(const std::string& lines);

  /// All options declared so far, and those of the parser itself, such as --help.
  std::vector<DeclaredOption> declared() const;

 private:
  void describe(CLI::Option* option, const std::string& value);
  void limit(CLI::Option* option, const std::vector<std::string>& choices);
  void choose(const std::string& names, const std::vector<std::string>& choices,
              const std::string& help, const std::function<void(std::size_t)>& take);
  void read_number(const std::string& names, Bounds bounds, const std::string& help,
                   const std::function<void(double)>& take);

  CLI::App* app_;
  std::map<std::string, std::string> kinds_;                 ///< by the option's name
  std::map<std::string, std::vector<std::string>> choices_;  ///< by the option's name
};

}  // namespace swarmsmith
