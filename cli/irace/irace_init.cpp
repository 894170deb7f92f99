#include "cli/irace/irace_actions.h"

#include <filesystem>

#include "base/text/whole_file.h"
#include "irace_core/files/templates.h"

namespace swarmsmith::cli {

namespace fs = std::filesystem;

ExitCode write_templates(Output& output) {
  for (const IraceTemplate& file : irace_templates()) {
    const fs::path path = file.name;
    if (std::error_code none; fs::exists(path, none)) {
      print_note(output, file.name + " exists already and stays unchanged");
      continue;
    }
    if (path.has_parent_path()) {
      std::error_code trouble;
      fs::create_directories(path.parent_path(), trouble);
    }
    if (auto written = write_whole_file(file.name, file.text); !written) {
      return fail(output, ExitCode::Failed, written.error());
    }
    if (file.is_program) {
      fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                      fs::perm_options::add);
    }
    print_note(output, "wrote " + file.name);
  }
  print_note(output, "Try them: swarmsmith irace --check, then swarmsmith irace");
  return ExitCode::Done;
}

}  // namespace swarmsmith::cli
