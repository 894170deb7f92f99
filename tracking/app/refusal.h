#pragma once

#include <vector>

#include "console/output.h"

namespace swarmsmith {

/// The exit code for several errors: 2 if a settings file is wrong, otherwise 1.
ExitCode exit_code_of_all(const std::vector<Error>& errors);

/// Prints all errors and returns the exit code.
ExitCode fail_all(Output& output, const std::vector<Error>& errors);

/// The reason why a command ends before it has done anything: all errors, and the exit code.
struct Refusal {
  ExitCode code = ExitCode::Failed;
  std::vector<Error> errors;
};

template <class T>
using OrRefusal = tl::expected<T, Refusal>;

/// Without `code`, the exit code follows from the errors: 2 if a settings file is wrong, otherwise
/// 1.
tl::unexpected<Refusal> refused(std::vector<Error> errors);
tl::unexpected<Refusal> refused(Error error);
tl::unexpected<Refusal> refused(ExitCode code, Error error);

/// Prints all errors of a refusal and returns its exit code.
ExitCode fail(Output& output, const Refusal& refusal);

}  // namespace swarmsmith
