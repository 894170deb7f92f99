#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/configuration.h"
#include "irace_core/files/irace_text.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith {

/// The format of a description of parameters.
enum class SpaceFormat {
  Irace,
  Pcs,         ///< the older and the newer format of AClib and SMAC
  ConfigSpace  ///< the JSON that ConfigSpace writes
};

/// Determines the format from the file's extension and the first line that is not empty or a
/// comment.
SpaceFormat space_format_of(const IraceText& source);

/// A parameter space of another tool, converted for irace.
struct ForeignSpace {
  ParameterSpace space;
  std::string text;                      ///< irace's parameter file for the space
  std::optional<Configuration> initial;  ///< the default values, if every parameter has one
  std::vector<std::string> warnings;     ///< one sentence each, with its place
};

struct ForeignSpaceOptions {
  bool aclib = false;  ///< whether switches have the form of AClib's calls: without a minus
  /// Decimals of reals; if not set, as many as bounds and defaults need.
  std::optional<int> digits;
};

/// Reads a PCS file. In names, characters that irace does not allow become '_'; the switch keeps
/// the original name: `-name `, as SMAC calls its targets. `where` of an error is file:line:column;
/// formulas and everything else that irace cannot express are errors.
Expected<ForeignSpace> parse_pcs_file(const IraceText& source, const ForeignSpaceOptions& options);

/// Reads ConfigSpace's JSON; switches are `--name `. `where` of an error is the file with the path
/// inside it, such as `space.json: conditions[2]`. Distributions other than uniform ones are
/// errors; weights are ignored, with a warning.
Expected<ForeignSpace> parse_config_space(const IraceText& source,
                                          const ForeignSpaceOptions& options);

}  // namespace swarmsmith
