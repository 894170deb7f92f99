#pragma once

#include <vector>

#include "console/output.h"

namespace swarmsmith {

/// What to exit with when all this is wrong: 2 when a file of settings is, else 1.
ExitCode exit_code_of_all(const std::vector<Error>& errors);

/// Prints them all and says what to exit with.
ExitCode fail_all(Output& output, const std::vector<Error>& errors);

/// Why a command ends before it has done anything: everything that is wrong, and what to exit with.
struct Refusal {
  ExitCode code = ExitCode::Failed;
  std::vector<Error> errors;
};

template <class T>
using OrRefusal = tl::expected<T, Refusal>;

/// With the exit code that follows from the errors: 2 when a file of settings is wrong, else 1.
tl::unexpected<Refusal> refused(std::vector<Error> errors);
tl::unexpected<Refusal> refused(Error error);
tl::unexpected<Refusal> refused(ExitCode code, Error error);

/// Prints all of it.
ExitCode fail(Output& output, const Refusal& refusal);

}  // namespace swarmsmith
