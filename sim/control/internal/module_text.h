#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "sim/control/flavour.h"
#include "sim/control/internal/fields.h"

namespace swarmsmith {

/// Modules in the texts of machines and trees.

/// The module in `table` whose number is the value of the field.
Expected<const ModuleSpec*> read_module(const Field& field, const std::vector<ModuleSpec>& table,
                                        const Flavour& flavour);

/// Takes the module's parameters out of the block, in the order of the flavour's table.
Expected<std::vector<double>> read_parameters(const ModuleSpec& spec, Block& block,
                                              const Flavour& flavour);

/// The shortest text that reads back to the same value, whatever the locale.
std::string shortest(double value);

/// Appends `--stemsuffix value`.
void append_switch(std::string& text, std::string_view stem, std::string_view suffix,
                   std::string_view value);

/// Appends the switches of a module's parameters.
void append_parameters(std::string& text, const ModuleSpec& spec, const std::vector<double>& values,
                       const std::string& suffix, const Flavour& flavour);

/// The error in using these parameters for a module of this flavour, if there is one.
std::optional<std::string> complaint_about_module(Module module, const std::vector<double>& values,
                                                  const Flavour& flavour);

}  // namespace swarmsmith
