#include "coordinator/cli/irace/irace_init.h"

#include <filesystem>
#include <fstream>

#include "irace_core/files/templates.h"

namespace swarmsmith::cli {

namespace fs = std::filesystem;

ExitCode write_templates(Output& output) {
  for (const IraceTemplate& file : irace_templates()) {
    const fs::path path = file.name;
    if (std::error_code none; fs::exists(path, none)) {
      print_note(output, file.name + " is there already, and stays as it is");
      continue;
    }
    if (path.has_parent_path()) {
      std::error_code trouble;
      fs::create_directories(path.parent_path(), trouble);
    }
    std::ofstream stream(path, std::ios::binary);
    stream << file.text;
    stream.close();
    if (!stream) return fail(output, ExitCode::Failed, cannot_write(file.name));
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
