#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "irace_core/files/options.h"

namespace swarmsmith {

/// A value given to an option.
struct IraceSetting {
  const IraceOption* option = nullptr;
  IraceValue value;              ///< nothing unsets an earlier value
  std::string where;             ///< "scenario.txt:3:1" or "--seed", for messages
  std::filesystem::path folder;  ///< start of a relative path; absolute
  bool on_command_line = false;
};

/// The settings of a file or a command line: at most one per option.
class IraceSettings {
 public:
  /// Sets an option; the last setting wins.
  void set(IraceSetting setting);
  /// Takes over the settings of `stronger`.
  void override_with(const IraceSettings& stronger);

  /// The setting with this name in scenario files or long switch; null if not given or unset.
  const IraceSetting* find(std::string_view title) const;
  /// Whether a flag is given, or a bool option is true.
  bool is_on(std::string_view title) const;
  /// The text or path as written; nothing if not given.
  std::optional<std::string> text(std::string_view title) const;
  std::optional<std::int64_t> number(std::string_view title) const;

  const std::vector<IraceSetting>& all() const { return settings_; }

 private:
  std::vector<IraceSetting> settings_;
};

/// The reason, in one sentence, why a value cannot be used here: a refused option, unless it has
/// its default value or none, or an older name.
std::optional<std::string> irace_refusal(const IraceOption& option, const IraceValue& value);
/// A note about a value that is used: an option without effect here, unless it has its default, or
/// one that newer versions of irace do not read.
std::optional<std::string> irace_remark(const IraceOption& option, const IraceValue& value);

/// A file or folder as an absolute path without dots, relative to `folder`, or to HOME if it begins
/// with `~/`; an empty path stays empty.
std::filesystem::path absolute_path(std::string_view path, const std::filesystem::path& folder);

}  // namespace swarmsmith
