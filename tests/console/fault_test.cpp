#include "console/fault.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// What is said of the exception that `act` throws.
template <class Act>
std::string said_of(const Act& act) {
  try {
    act();
  } catch (const std::exception& fault) {
    return sentence_of_fault(fault);
  }
  return "nothing was thrown";
}

const auto kIsOurs =
    AllOf(HasSubstr("internal error"), HasSubstr("report"), Not(HasSubstr("not enough memory")));

TEST(Fault, ALengthThatCannotBeIsTheProgramsOwnFault) {
  const std::string_view text = "short";
  const auto most = std::numeric_limits<std::size_t>::max();
  volatile std::size_t many = most - 8;
  EXPECT_THAT(said_of([&] { (void)std::string(text.substr(0, 2)).at(many); }), kIsOurs);
  EXPECT_THAT(said_of([&] { (void)std::string(many, 'x').size(); }), kIsOurs);
  EXPECT_THAT(said_of([&] { std::vector<std::int64_t>().reserve(many); }), kIsOurs);
  // Of `new std::int64_t[many]`, by GCC; clang 19 has memory refused.
  EXPECT_THAT(said_of([] { throw std::bad_array_new_length(); }), kIsOurs);
  EXPECT_THAT(said_of([&] { (void)std::optional<int>().value(); }), kIsOurs);
}

TEST(Fault, RefusedMemoryIsToldWithHowMuchThereWas) {
  const std::bad_alloc refused;
  const std::string said = sentence_of_fault(refused);
  EXPECT_THAT(said, AllOf(HasSubstr("this process has "), HasSubstr(" MB are left for it")));
  EXPECT_THAT(said, HasSubstr("memory"));
}

TEST(Fault, LittleMemoryIsNotEnough) {
#ifdef SWARMSMITH_SANITIZED
  GTEST_SKIP() << "a sanitizer maps more than this";
#endif
  // In a process of its own, which may map a little more than it has.
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    rlimit limit{};
    limit.rlim_cur = limit.rlim_max = 256U << 20U;
    setrlimit(RLIMIT_AS, &limit);
    const std::string said = sentence_of_fault(std::bad_alloc());
    _exit(said.find("not enough memory") != std::string::npos ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

TEST(Fault, WhatTheEnvironmentSaysIsToldAsItIs) {
  EXPECT_EQ(sentence_of_fault(std::runtime_error("the disk is full")), "the disk is full");
}

}  // namespace
}  // namespace swarmsmith
