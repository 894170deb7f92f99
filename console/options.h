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

/// The store that SWARMSMITH_STORE names; empty when it names none.
std::string store_of_environment();

/// What a command reads from its arguments. Names are "--budget", "-o,--output FILE" or, for a word
/// without dashes, "FILE". What follows the name says what the value is, in the help and for
/// completion: "--profile PROFILE|FILE" is a profile or a file; a word is what its name says, else
/// what follows: "ID DESIGN|RUN". The referenced values must live until the command has run.
class Options {
 public:
  explicit Options(CLI::App& app) : app_(&app) {}

  enum class Need { Optional, Required };

  /// A flag.
  void flag(const std::string& names, bool& value, const std::string& help);
  void text(const std::string& names, std::string& value, const std::string& help,
            Need need = Need::Optional);
  /// A repeatable option: one text each time.
  void texts(const std::string& names, std::vector<std::string>& values, const std::string& help);
  /// All further words.
  void words(const std::string& name, std::vector<std::string>& values, const std::string& help,
             Need need = Need::Optional);
  /// One of `choices`, which the help lists.
  void choice(const std::string& names, std::string& value, const std::vector<std::string>& choices,
              const std::string& help, Need need = Need::Optional);
  /// The same as values: "floats" is WheelsForm::Floats.
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
  /// The value stays nullopt if the option is not given. As in campaign files, underscores may
  /// group the digits: 100_000.
  void integer(const std::string& names, std::optional<std::int64_t>& value, Range range,
               const std::string& help);
  /// A number, as text(): with what it counts behind its name. The value stays as it is if the
  /// option is not given.
  struct Bounds {
    double least;
    double most;
  };
  void number(const std::string& names, double& value, Bounds bounds, const std::string& help);
  void number(const std::string& names, std::optional<double>& value, Bounds bounds,
              const std::string& help);
  /// Lines below the options, above the command's details.
  void explain(const std::string& lines);

  /// All that is declared so far, and the parser's own, such as --help.
  std::vector<DeclaredOption> declared() const;

 private:
  void describe(CLI::Option* option, const std::string& value);
  void limit(CLI::Option* option, const std::vector<std::string>& choices);
  void choose(const std::string& names, const std::vector<std::string>& choices,
              const std::string& help, const std::function<void(std::size_t)>& take);
  void read_number(const std::string& names, Bounds bounds, const std::string& help,
                   const std::function<void(double)>& take);

  CLI::App* app_;
  std::map<std::string, std::string> kinds_;                 ///< by name
  std::map<std::string, std::vector<std::string>> choices_;  ///< by name
};

}  // namespace swarmsmith
