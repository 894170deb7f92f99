#include "tracking/app/complaints.h"

#include <algorithm>

#include "tracking/app/commands.h"

namespace swarmsmith::cli {

ExitCode exit_code_of_all(const std::vector<Error>& errors) {
  const bool is_usage = std::ranges::any_of(
      errors, [](const Error& error) { return exit_code_of_tracking(error) == ExitCode::Usage; });
  return is_usage ? ExitCode::Usage : ExitCode::Failed;
}

ExitCode fail_all(Output& output, const std::vector<Error>& errors) {
  for (const Error& error : errors)
    print_error(output, error);
  return exit_code_of_all(errors);
}

}  // namespace swarmsmith::cli
