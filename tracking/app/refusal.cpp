#include "tracking/app/refusal.h"

#include <algorithm>

#include "tracking/app/commands.h"

namespace swarmsmith {

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

tl::unexpected<Refusal> refused(std::vector<Error> errors) {
  const ExitCode code = exit_code_of_all(errors);
  return tl::unexpected(Refusal{code, std::move(errors)});
}

tl::unexpected<Refusal> refused(Error error) {
  return refused(std::vector<Error>{std::move(error)});
}

tl::unexpected<Refusal> refused(ExitCode code, Error error) {
  return tl::unexpected(Refusal{code, {std::move(error)}});
}

ExitCode fail(Output& output, const Refusal& refusal) {
  fail_all(output, refusal.errors);
  return refusal.code;
}

}  // namespace swarmsmith
