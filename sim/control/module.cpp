#include "sim/control/module.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "base/assert.h"
#include "sim/control/internal/module_kinds.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kCount = kKinds<Behaviour> + kKinds<Condition>;
/// External modules come after the enumerators: first behaviours, then conditions.
constexpr int kFirstExternal = 1000;
static_assert(kCount < kFirstExternal);

/// Applies `text` to the struct of each module, in the order of the enumerators.
template <class Text>
std::array<std::string_view, kCount> texts_of(const Text& text) {
  std::array<std::string_view, kCount> texts;
  for_each_module<Behaviour>([&](std::size_t index, const auto& kind) {
    texts[kFirstModule<Behaviour> + index] = text(kind);
  });
  for_each_module<Condition>([&](std::size_t index, const auto& kind) {
    texts[kFirstModule<Condition> + index] = text(kind);
  });
  return texts;
}

}  // namespace

std::span<const Module> all_modules() {
  static const std::array<Module, kCount> kAll = [] {
    std::array<Module, kCount> all{};
    for (std::size_t i = 0; i < kCount; ++i)
      all[i] = static_cast<Module>(i);
    return all;
  }();
  return kAll;
}

Module external_behaviour(int number) {
  SWARMSMITH_ASSERT(0 <= number && number < kExternalNumbers, "the number of an external module");
  return static_cast<Module>(kFirstExternal + number);
}

Module external_condition(int number) {
  SWARMSMITH_ASSERT(0 <= number && number < kExternalNumbers, "the number of an external module");
  return static_cast<Module>(kFirstExternal + kExternalNumbers + number);
}

bool is_external(Module module) {
  return static_cast<int>(module) >= kFirstExternal;
}

std::string_view id_of(Module module) {
  if (is_external(module)) return ExternalBehaviour::kId;
  static const auto kIds = texts_of([](const auto& kind) { return kind.kId; });
  return kIds[static_cast<std::size_t>(module)];
}

std::optional<Module> module_from_id(std::string_view id) {
  const auto found = std::ranges::find(all_modules(), id, id_of);
  return found == all_modules().end() ? std::nullopt : std::optional(*found);
}

bool is_behaviour(Module module) {
  if (is_external(module)) return static_cast<int>(module) < kFirstExternal + kExternalNumbers;
  return static_cast<std::size_t>(module) < kFirstModule<Condition>;
}

std::string_view label_of(Module module) {
  if (is_external(module)) return ExternalBehaviour::kId;
  static const auto kLabels = texts_of([](const auto& kind) { return kind.kLabel; });
  return kLabels[static_cast<std::size_t>(module)];
}

}  // namespace swarmsmith
