#include "irace_core/files/scenario_file.h"

#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

/// A world where the second half of the input can be included, and each variable is its own name.
ScenarioSurroundings world_of(std::string_view input) {
  return {[input](const std::filesystem::path& file) -> Expected<std::string> {
            if (file.filename() == "half") return std::string(input.substr(input.size() / 2));
            return bad_input("there is no such file");
          },
          [](const std::string& name) -> std::optional<std::string> {
            return name.empty() ? std::nullopt : std::optional(name);
          }};
}

}  // namespace

/// Scenarios are refused with reasons and places, or read to values that read back from what is
/// printed of them.
void run(std::string_view input) {
  const ScenarioSurroundings world = world_of(input);
  const auto file = parse_irace_scenario(input, "/tune/scenario.txt", world);
  if (!file) return require_reasons(file.error());
  std::string printed;
  for (const IraceSetting& setting : file->settings.all()) {
    if (setting.option->kind == IraceKind::Anything) continue;  // objects of R are not kept
    printed += std::string(setting.option->name) + " = " + irace_value_text(setting.value) + "\n";
  }
  const auto again = parse_irace_scenario(printed, "/tune/scenario.txt", world);
  require(again.has_value(), "what is printed can be read");
  for (const IraceSetting& setting : again->settings.all()) {
    const IraceSetting* before = file->settings.find(setting.option->name);
    require((before == nullptr ? IraceValue{} : before->value) == setting.value,
            "what is printed reads back as the same");
  }
}

}  // namespace swarmsmith::fuzz
