#pragma once

#include <cctype>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/irace_setup.h"
#include "irace_core/files/settings.h"
#include "irace_core/files/setup.h"

namespace swarmsmith::irace {

/// A setup while it is made from options and files.
struct SetupWork {
  IraceAction action = IraceAction::Run;
  SetupSurroundings around;
  /// The settings of the scenario file, overridden by the settings of the command line.
  IraceSettings settings;
  std::filesystem::path scenario_folder;  ///< empty without a scenario file
  IraceSetup setup;
  std::vector<Error> errors;

  /// The place where the option was set, otherwise its name.
  std::string where(std::string_view option) const {
    const IraceSetting* setting = settings.find(option);
    return setting == nullptr ? std::string(option) : setting->where;
  }
  void complain(std::string_view option, const std::string& message) {
    errors.push_back({ErrorKind::BadInput, named(option, message), where(option)});
  }
  /// Adds an error at its own place, or, if it has none, at the place of the option.
  void complain(std::string_view option, const Error& error) {
    errors.push_back(error.where.empty()
                         ? Error{error.kind, named(option, error.message), where(option)}
                         : error);
  }
  /// "mu" is a word of "the `mu` of irace", and not of "must be".
  static bool has_word(std::string_view message, std::string_view word) {
    const auto continues = [&](std::size_t at) {
      return at < message.size() && std::isalnum(static_cast<unsigned char>(message[at])) != 0;
    };
    for (std::size_t at = message.find(word); at != std::string_view::npos;
         at = message.find(word, at + 1)) {
      if ((at == 0 || !continues(at - 1)) && !continues(at + word.size())) return true;
    }
    return false;
  }
  /// Adds the option's name to a message if neither the message nor the place contains it.
  std::string named(std::string_view option, const std::string& message) const {
    if (has_word(message, option) || where(option).find(':') == std::string::npos) return message;
    const bool goes_on = message.starts_with("must ") || message.starts_with("needs ") ||
                         message.starts_with("uses ") || message.starts_with("stands ");
    return "`" + std::string(option) + (goes_on ? "` " : "`: ") + message;
  }
  void warn(std::string message) { setup.warnings.push_back(std::move(message)); }
};

/// Sets the values that depend on a single option, with paths made absolute (irace facts, 21).
void apply_options(SetupWork& work);
/// Reads training and test instances (irace facts, 23.3).
void read_instances(SetupWork& work);
/// Reads parameters, with the parts that older versions of irace have in separate files, and
/// initial configurations.
void read_parameters(SetupWork& work);
/// Checks the rules of irace facts, 22 for combinations of options, for programs and for folders.
void check_setup(SetupWork& work);

}  // namespace swarmsmith::irace
