#pragma once

#include <string>
#include <vector>

namespace swarmsmith {

/// A file to begin with, as `irace --init` writes it.
struct IraceTemplate {
  std::string name;
  std::string text;
  bool is_program = false;  ///< to be made executable
};

/// A scenario with every option explained, parameters, a target-runner (a shell script), instances
/// and configurations: together they run as they are and tune a small example.
std::vector<IraceTemplate> irace_templates();

}  // namespace swarmsmith
