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
  IraceValue value;              ///< nothing unsets what was said before
  std::string where;             ///< "scenario.txt:3:1" or "--seed", for messages
  std::filesystem::path folder;  ///< which a relative path begins from; absolute
  bool on_command_line = false;
};

/// What a file or a command line says: at most one setting an option.
class IraceSettings {
 public:
  /// The last one wins.
  void set(IraceSetting setting);
  /// Takes over what `stronger` says.
  void override_with(const IraceSettings& stronger);

  /// By the name in scenario files or by the long switch; null if not given or unset.
  const IraceSetting* find(std::string_view title) const;
  /// Whether a flag is given, or a bool is true.
  bool is_on(std::string_view title) const;
  /// The text or path as written; nothing if not given.
  std::optional<std::string> text(std::string_view title) const;
  std::optional<std::int64_t> number(std::string_view title) const;

  const std::vector<IraceSetting>& all() const { return settings_; }

 private:
  std::vector<IraceSetting> settings_;
};

/// Why a value cannot be used here, in a sentence: refused options, unless they have their default
/// or nothing, and older names.
std::optional<std::string> irace_refusal(const IraceOption& option, const IraceValue& value);
/// What is to be known about a value that is used: options that mean nothing here, unless they have
/// their default, and those that newer versions of irace do not read.
std::optional<std::string> irace_remark(const IraceOption& option, const IraceValue& value);

/// A file or folder as an absolute path without dots, relative to the setting's folder, or to HOME
/// where it begins with `~/`; empty stays empty.
std::filesystem::path absolute_path(std::string_view path, const std::filesystem::path& folder);

}  // namespace swarmsmith
