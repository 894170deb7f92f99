#pragma once

/// Stops the process when `condition` is false: the program's own logic is wrong, and a race that
/// continued would record wrong results. It is active in every kind of build; the campaign resumes
/// from its store. `what` is the sentence that must be true.
#define SWARMSMITH_ASSERT(condition, what)                                          \
  do {                                                                              \
    if (!(condition)) [[unlikely]]                                                  \
      ::swarmsmith::detail::assertion_failed(#condition, what, __FILE__, __LINE__); \
  } while (false)

namespace swarmsmith::detail {
[[noreturn]] void assertion_failed(const char* condition, const char* what, const char* file,
                                   int line);
}  // namespace swarmsmith::detail
