#include "console/declared.h"

#include <CLI/CLI.hpp>

namespace swarmsmith {
namespace {

DeclaredOption declared(const CLI::Option& option) {
  DeclaredOption found;
  found.is_word = option.get_positional();
  if (found.is_word) {
    found.names = {option.get_name(true)};
    found.kind = found.names.front();
  } else {
    for (const std::string& name : option.get_snames())
      found.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
      found.names.push_back("--" + name);
    if (option.get_items_expected_max() > 0) {
      const std::string& text = option.get_option_text();
      found.value = text.empty() ? option.get_type_name() : text;
      // "N:INT in [1 - 9]": the range after the type is cut off.
      if (found.value.find(" in [") != std::string::npos) found.value.resize(found.value.find(':'));
      found.kind = found.value;
    }
  }
  found.help = option.get_description();
  found.required = option.get_required();
  found.repeats = option.get_expected_max() > 1;
  return found;
}

void add_options(const CLI::App& app, std::vector<DeclaredOption>& options) {
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_group().empty()) options.push_back(declared(*option));
  }
  // An option group is a parser without a name.
  for (const CLI::App* group : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (group->get_name().empty()) add_options(*group, options);
  }
}

}  // namespace

std::vector<DeclaredOption> declared_options(const CLI::App& app) {
  std::vector<DeclaredOption> options;
  add_options(app, options);
  return options;
}

JsonPiece declared_json(const std::vector<DeclaredOption>& options) {
  return json_list(options, [](const DeclaredOption& option) {
    return JsonObject()
        .add("names", option.names)
        .add("word", option.is_word)
        .add("value", option.value)
        .add("help", option.help)
        .add("choices", option.choices)
        .add("required", option.required)
        .add("repeats", option.repeats);
  });
}

}  // namespace swarmsmith
