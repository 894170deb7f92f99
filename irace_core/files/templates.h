#pragma once

#include <string>
#include <vector>

namespace swarmsmith {

/// A template file that `irace --init` writes.
struct IraceTemplate {
  std::string name;
  std::string text;
  bool is_program = false;  ///< whether it is made executable
};

/// A scenario with every option explained, parameters, a target-runner (a shell script), instances
/// and configurations: together they run without changes and tune a small example.
std::vector<IraceTemplate> irace_templates();

}  // namespace swarmsmith
