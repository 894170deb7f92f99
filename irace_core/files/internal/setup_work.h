#pragma once

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

/// A setup on its way from options to files that were read.
struct SetupWork {
  IraceAction action = IraceAction::Run;
  SetupSurroundings around;
  IraceSettings settings;                 ///< the command line's over the scenario file's
  std::filesystem::path scenario_folder;  ///< empty without a scenario file
  IraceSetup setup;
  std::vector<Error> errors;

  /// The place where the option was set, else its name.
  std::string where(std::string_view option) const {
    const IraceSetting* setting = settings.find(option);
    return setting == nullptr ? std::string(option) : setting->where;
  }
  void complain(std::string_view option, const std::string& message) {
    errors.push_back({ErrorKind::BadInput, named(option, message), where(option)});
  }
  /// An error whose own place, if it has one, is in a file.
  void complain(std::string_view option, const Error& error) {
    errors.push_back(error.where.empty()
                         ? Error{error.kind, named(option, error.message), where(option)}
                         : error);
  }
  /// A place in a file does not say which option is meant.
  std::string named(std::string_view option, const std::string& message) const {
    const bool is_said =
        message.find(option) != std::string::npos || where(option).find(':') == std::string::npos;
    if (is_said) return message;
    const bool goes_on = message.starts_with("must ") || message.starts_with("needs ") ||
                         message.starts_with("uses ") || message.starts_with("stands ");
    return "`" + std::string(option) + (goes_on ? "` " : "`: ") + message;
  }
  void warn(std::string message) { setup.warnings.push_back(std::move(message)); }
};

/// Fills in all that an option says by itself, with paths made absolute (irace facts, 21).
void apply_options(SetupWork& work);
/// Training and test instances (irace facts, 23.3).
void read_instances(SetupWork& work);
/// Parameters with what older versions of irace kept in files of their own, and configurations to
/// begin with.
void read_parameters(SetupWork& work);
/// What irace facts, 22 asks of options together, of programs and of folders.
void check_setup(SetupWork& work);

}  // namespace swarmsmith::irace
