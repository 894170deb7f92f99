#include <optional>

#include "irace_core/files/configurations_file.h"
#include "irace_core/files/internal/setup_work.h"
#include "irace_core/files/parameter_file.h"
#include "irace_core/files/whole_file.h"

namespace swarmsmith::irace {
namespace {

namespace fs = std::filesystem;

/// The text of the file that an option names; nothing after a complaint, too.
std::optional<IraceText> text_of(SetupWork& work, std::string_view option, const fs::path& file) {
  if (file.empty()) return std::nullopt;
  auto text = read_whole_file(file);
  if (text) return IraceText{std::move(*text), file.filename().string()};
  work.complain(option, to_string(text.error()));
  return std::nullopt;
}

/// The same for an option that IraceSetup has no place for.
std::optional<IraceText> text_of(SetupWork& work, std::string_view option) {
  const IraceSetting* setting = work.settings.find(option);
  if (setting == nullptr) return std::nullopt;
  return text_of(work, option,
                 absolute_path(std::get<std::string>(setting->value), setting->folder));
}

/// False after a complaint.
bool read_space(SetupWork& work) {
  const std::size_t complaints = work.errors.size();
  ParameterSources sources;
  if (const auto digits = work.settings.number("digits")) {
    if (*digits < 1 || *digits > 15) work.complain("digits", "must be 1 to 15");
    sources.digits = static_cast<int>(*digits);
  }
  // As irace does, whatever digits says.
  if (work.settings.is_on("aclib")) sources.digits = 15;
  sources.forbidden = text_of(work, "forbiddenFile");
  sources.dependency = text_of(work, "dependencyFile");
  auto parameters = text_of(work, "parameterFile", work.setup.parameter_file);
  if (work.errors.size() != complaints) return false;
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
    // One text that says all, which later readers of a campaign understand.
    auto text = print_parameter_file(work.setup.space);
    if (!text) {
      work.errors.push_back(text.error());
      return false;
    }
    work.setup.parameter_text = std::move(*text);
  }
  return true;
}

}  // namespace

void read_parameters(SetupWork& work) {
  const bool has_space = read_space(work);
  const auto text = text_of(work, "configurationsFile", work.setup.configurations_file);
  if (!has_space || !text) return;
  auto configurations = parse_configurations_file(*text, work.setup.space);
  if (!configurations) {
    work.errors.push_back(configurations.error());
    return;
  }
  work.setup.initial = std::move(*configurations);
  work.setup.configurations_text = text->text;
}

}  // namespace swarmsmith::irace
