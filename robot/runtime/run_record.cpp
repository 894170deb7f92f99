#include "robot/runtime/run_record.h"

namespace swarmsmith {
namespace {

constexpr std::array<std::string_view, 2> kActs = {"step", "hold"};
constexpr std::array<std::string_view, 3> kVerdicts = {"VALID", "DEGRADED", "INVALID"};

/// The enumerator whose name it is.
template <class Enum, std::size_t N>
std::optional<Enum> named(std::string_view name, const std::array<std::string_view, N>& names) {
  for (std::size_t i = 0; i < N; ++i) {
    if (names[i] == name) return static_cast<Enum>(i);
  }
  return std::nullopt;
}

}  // namespace

std::string_view name_of(Act act) {
  return kActs[static_cast<std::size_t>(act)];
}

std::optional<Act> act_from(std::string_view name) {
  return named<Act>(name, kActs);
}

std::string_view name_of(RunVerdict verdict) {
  return kVerdicts[static_cast<std::size_t>(verdict)];
}

std::optional<RunVerdict> run_verdict_from(std::string_view name) {
  return named<RunVerdict>(name, kVerdicts);
}

}  // namespace swarmsmith
