#include "tracking/app/refusal.h"

#include "tracking/app/complaints.h"

namespace swarmsmith::cli {

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

}  // namespace swarmsmith::cli
