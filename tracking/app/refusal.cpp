#include "tracking/app/refusal.h"

#include <algorithm>

#include "tracking/app/commands.h"

namespace swarmsmith::cli {

tl::unexpected<Refusal> refused(std::vector<Error> errors) {
  const bool is_usage = std::ranges::any_of(
      errors, [](const Error& error) { return exit_code_of_tracking(error) == ExitCode::Usage; });
  return tl::unexpected(Refusal{is_usage ? ExitCode::Usage : ExitCode::Failed, std::move(errors)});
}

tl::unexpected<Refusal> refused(Error error) {
  return refused(std::vector<Error>{std::move(error)});
}

tl::unexpected<Refusal> refused(ExitCode code, Error error) {
  return tl::unexpected(Refusal{code, {std::move(error)}});
}

ExitCode fail(Output& output, const Refusal& refusal) {
  for (const Error& error : refusal.errors)
    print_error(output, error);
  return refusal.code;
}

}  // namespace swarmsmith::cli
