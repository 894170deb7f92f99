#include <algorithm>
#include <optional>

#include "base/text/whole_file.h"
#include "irace_core/files/configurations_file.h"
#include "irace_core/files/foreign_space.h"
#include "irace_core/files/internal/setup_work.h"
#include "irace_core/files/parameter_file.h"

namespace swarmsmith::irace {
namespace {

namespace fs = std::filesystem;

/// The text of the file that an option names; nothing if there is no file, or after an error.
std::optional<IraceText> text_of(SetupWork& work, std::string_view option, const fs::path& file) {
  if (file.empty()) return std::nullopt;
  auto text = read_whole_file(file);
  if (text) return IraceText{std::move(*text), file.filename().string()};
  work.complain(option, to_string(text.error()));
  return std::nullopt;
}

/// The same for an option for which IraceSetup has no field.
std::optional<IraceText> text_of(SetupWork& work, std::string_view option) {
  const IraceSetting* setting = work.settings.find(option);
  if (setting == nullptr) return std::nullopt;
  return text_of(work, option,
                 absolute_path(std::get<std::string>(setting->value), setting->folder));
}

/// Reads the space of another tool; it is kept as irace's text, and its defaults become the first
/// configuration.
bool read_foreign_space(SetupWork& work, const IraceText& text, SpaceFormat format,
                        std::optional<int> digits) {
  const ForeignSpaceOptions options{work.settings.is_on("aclib"), digits};
  auto foreign = format == SpaceFormat::Pcs ? parse_pcs_file(text, options)
                                            : parse_config_space(text, options);
  if (!foreign) {
    work.complain("parameterFile", foreign.error());
    return false;
  }
  for (std::string& warning : foreign->warnings)
    work.warn(std::move(warning));
  work.setup.space = std::move(foreign->space);
  work.setup.parameter_text = std::move(foreign->text);
  if (foreign->initial) work.setup.initial.push_back(std::move(*foreign->initial));
  return true;
}

/// Returns false after an error.
bool read_space(SetupWork& work) {
  const std::size_t complaints = work.errors.size();
  ParameterSources sources;
  if (const auto digits = work.settings.number("digits")) {
    if (*digits < 1 || *digits > 15) work.complain("digits", "must be 1 to 15");
    sources.digits = static_cast<int>(*digits);
  }
  // irace does this too, for any value of digits.
  if (work.settings.is_on("aclib")) sources.digits = 15;
  sources.forbidden = text_of(work, "forbiddenFile");
  sources.dependency = text_of(work, "dependencyFile");
  auto parameters = text_of(work, "parameterFile", work.setup.parameter_file);
  if (work.errors.size() != complaints) return false;
  if (const SpaceFormat format = space_format_of(*parameters); format != SpaceFormat::Irace) {
    if (!sources.forbidden && !sources.dependency) {
      return read_foreign_space(work, *parameters, format,
                                work.settings.is_on("aclib") ? std::nullopt : sources.digits);
    }
    work.complain(sources.forbidden ? "forbiddenFile" : "dependencyFile",
                  "is given with parameters that are not in irace's format: leave it out, and "
                  "forbid in the parameter file");
    return false;
  }
  sources.parameters = std::move(*parameters);
  auto file = parse_parameter_file(sources);
  if (!file) {
    work.errors.push_back(file.error());
    return false;
  }
  for (std::string& warning : file->warnings)
    work.warn(std::move(warning));
  work.setup.space = std::move(file->space);
  work.setup.parameter_text = std::move(sources.parameters.text);
  if (sources.digits || sources.forbidden || sources.dependency) {
    // One text with everything, which later readers of a campaign understand.
    auto text = print_parameter_file(work.setup.space);
    if (!text) {
      work.errors.push_back(text.error());
      return false;
    }
    work.setup.parameter_text = std::move(*text);
  }
  return true;
}

/// Puts the default configuration before the configurations of a file, unless it is among them.
void begin_with(SetupWork& work, const Configuration& defaults) {
  auto& initial = work.setup.initial;
  if (std::ranges::find(initial, defaults) != initial.end()) return;
  initial.insert(initial.begin(), defaults);
  auto text = print_configurations_file(work.setup.space, initial);
  if (!text) {
    work.errors.push_back(text.error());
    return;
  }
  work.setup.configurations_text = std::move(*text);
}

}  // namespace

void read_parameters(SetupWork& work) {
  const bool has_space = read_space(work);
  const auto text = text_of(work, "configurationsFile", work.setup.configurations_file);
  if (!has_space) return;
  const std::vector<Configuration> defaults = std::move(work.setup.initial);
  work.setup.initial.clear();
  if (text) {
    auto configurations = parse_configurations_file(*text, work.setup.space);
    if (!configurations) {
      work.errors.push_back(configurations.error());
      return;
    }
    work.setup.initial = std::move(*configurations);
    work.setup.configurations_text = text->text;
  }
  if (!defaults.empty()) begin_with(work, defaults.front());
}

}  // namespace swarmsmith::irace
