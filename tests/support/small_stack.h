#pragma once

#include <gtest/gtest.h>
#include <pthread.h>
#include <cstddef>
#include <functional>

namespace swarmsmith {

/// Runs it in a thread with a stack of 1 MiB (sanitizers need more for each call): who calls
/// himself for each letter of a long text ends the process there.
inline void with_small_stack(std::function<void()> what) {
#ifdef SWARMSMITH_SANITIZED
  constexpr std::size_t kBytes = 8U << 20U;
#else
  constexpr std::size_t kBytes = 1U << 20U;
#endif
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, kBytes), 0);
  pthread_t thread{};
  const auto run = [](void* argument) -> void* {
    (*static_cast<std::function<void()>*>(argument))();
    return nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &attributes, run, &what), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
}

}  // namespace swarmsmith
