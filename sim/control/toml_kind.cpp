#include "sim/control/toml_kind.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <variant>

#include "base/assert.h"

namespace swarmsmith {
namespace {

struct KindFacts {
  TomlKind kind;
  std::string_view words;
  std::array<std::string_view, 9>
      own_keys;  ///< no other kind has them; `table.key` for a subtable's
};

constexpr std::array<KindFacts, 5> kTomlKinds = {{
    {TomlKind::Campaign,
     "a campaign file; `run` runs it",
     {"campaign", "method", "race", "mission", "simulator", "tests", "workers"}},
    {TomlKind::Mission,
     "a mission file; `evaluate MACHINE --mission FILE` takes it",
     {"preset", "duration", "robots", "robot", "score", "arena", "instances"}},
    {TomlKind::Flavour,
     "a flavour; `evaluate MACHINE --flavour FILE` takes it",
     {"behaviours", "conditions", "obstacles", "exploration", "steering", "states", "transitions",
      "floor"}},
    {TomlKind::Robot,
     "a robot file; `assess --robot FILE` takes it, and a mission names it (robot = \"FILE\")",
     {"body", "drive", "ground", "neighbours.range", "neighbours.less", "proximity.rays",
      "light.angles", "light.out"}},
    {TomlKind::Profile,
     "a profile; `evaluate MACHINE --profile FILE` takes it",
     {"timing", "treads", "lidar", "ground_color", "tracking", "contacts", "proximity.range",
      "proximity.half_width", "neighbours.miss_rate"}},
}};

const KindFacts& facts_of(TomlKind kind) {
  const auto* facts = std::ranges::find(kTomlKinds, kind, &KindFacts::kind);
  SWARMSMITH_ASSERT(facts != kTomlKinds.end(), "each kind has its line");
  return *facts;
}

const Node* find_key(const Node& node, std::string_view key) {
  const auto* table = std::get_if<Table>(&node.value);
  if (table == nullptr) return nullptr;
  const auto entry = std::ranges::find(table->entries, key, &Table::Entry::key);
  return entry == table->entries.end() ? nullptr : &entry->node;
}

bool has_own_key(const Node& root, const KindFacts& facts) {
  return std::ranges::any_of(facts.own_keys, [&](std::string_view key) {
    const std::size_t dot = key.find('.');
    const Node* found = key.empty() ? nullptr : find_key(root, key.substr(0, dot));
    if (found == nullptr || dot == std::string_view::npos) return found != nullptr;
    return find_key(*found, key.substr(dot + 1)) != nullptr;
  });
}

}  // namespace

std::optional<TomlKind> toml_kind_of(const Node& root) {
  for (const KindFacts& facts : kTomlKinds)
    if (has_own_key(root, facts)) return facts.kind;
  return std::nullopt;
}

std::string_view words_of(TomlKind kind) {
  return facts_of(kind).words;
}

std::vector<Error> complaints_about(const Node& root, TomlKind wanted, const std::string& file,
                                    Complaints& complaints) {
  const auto kind = toml_kind_of(root);
  if (!kind || has_own_key(root, facts_of(wanted))) return complaints.take();
  return {{ErrorKind::BadInput, "this is " + std::string(words_of(*kind)), file}};
}

}  // namespace swarmsmith
