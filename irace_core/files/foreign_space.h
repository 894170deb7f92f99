#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/configuration.h"
#include "irace_core/files/irace_text.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith {

/// Whose description of parameters a file is.
enum class SpaceFormat {
  Irace,
  Pcs,         ///< AClib's and SMAC's, the older one and the newer one
  ConfigSpace  ///< the JSON that ConfigSpace writes
};

/// By the file's ending and its first line that says something.
SpaceFormat space_format_of(const IraceText& source);

/// A parameter space of another tool in irace's terms.
struct ForeignSpace {
  ParameterSpace space;
  std::string text;                      ///< irace's parameter file of the space
  std::optional<Configuration> initial;  ///< of the defaults, where every parameter has one
  std::vector<std::string> warnings;     ///< a sentence each, with its place
};

struct ForeignSpaceOptions {
  bool aclib = false;         ///< switches as aclib's calls want them: without a minus
  std::optional<int> digits;  ///< decimals of reals; else as many as bounds and defaults need
};

/// Reads a PCS file. Names get '_' for what irace's names cannot hold; the switch keeps the old
/// name: `-name `, as SMAC calls its targets. Errors: `where` is file:line:column; formulas and
/// what else irace cannot say is refused.
Expected<ForeignSpace> parse_pcs_file(const IraceText& source, const ForeignSpaceOptions& options);

/// Reads ConfigSpace's JSON; switches are `--name `. Errors: `where` is the file with the path
/// within, as `space.json: conditions[2]`. Distributions other than uniform ones are refused;
/// weights are left out, with a warning.
Expected<ForeignSpace> parse_config_space(const IraceText& source,
                                          const ForeignSpaceOptions& options);

}  // namespace swarmsmith
