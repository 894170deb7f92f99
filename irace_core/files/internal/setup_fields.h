#pragma once

#include <span>
#include <string_view>

#include "irace_core/files/irace_setup.h"
#include "irace_core/files/options.h"

namespace swarmsmith::irace {

/// Where an option's value lies in a setup. Paths are texts here, as they are.
struct SetupField {
  std::string_view name;  ///< of the option in scenario files
  IraceValue (*get)(const IraceSetup& setup);
  /// The value must be of the option's kind; nothing sets what may be absent to nothing, and
  /// leaves the rest as it is.
  void (*set)(IraceSetup& setup, const IraceValue& value);
};

/// For every option that IraceSetup holds as a value: not for files and folders of instances, which
/// are read, nor for what is refused or means nothing.
std::span<const SetupField> setup_fields();

}  // namespace swarmsmith::irace
