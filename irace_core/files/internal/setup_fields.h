#pragma once

#include <span>
#include <string_view>

#include "irace_core/files/irace_setup.h"
#include "irace_core/files/options.h"

namespace swarmsmith::irace {

/// Access to an option's value in a setup. Paths are unchanged texts here.
struct SetupField {
  std::string_view name;  ///< the option's name in scenario files
  IraceValue (*get)(const IraceSetup& setup);
  /// The value must be of the option's kind. Without a value, optional fields become empty and all
  /// others stay unchanged.
  void (*set)(IraceSetup& setup, const IraceValue& value);
};

/// The fields of all options that IraceSetup holds as values. Files and folders of instances are
/// not among them, since they are read, nor are options that are refused or have no effect.
std::span<const SetupField> setup_fields();

}  // namespace swarmsmith::irace
