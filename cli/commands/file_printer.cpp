#include "cli/commands/file_printer.h"

#include <cstddef>
#include <filesystem>

#include "base/suggestion.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"

namespace swarmsmith::cli {
namespace {

/// One name per line, or all names as JSON.
void list(const CarriedFiles& files, Output& output) {
  if (output.json) {
    output.out << JsonObject().add(files.kind + "s", files.names).text() << "\n";
    return;
  }
  for (const std::string& name : files.names)
    output.out << name << "\n";
}

ExitCode write(const CarriedFiles& files, const std::string& file, std::string_view text,
               Output& output) {
  if (std::error_code none; std::filesystem::exists(file, none)) {
    return fail(output, ExitCode::Usage,
                Error{ErrorKind::BadInput, "already exists; name another file", file});
  }
  if (auto written = write_whole_file(file, text); !written) {
    return fail(output, ExitCode::Failed, written.error());
  }
  print_note(output,
             file + " can be named in a campaign file: " + files.hint + " = \"" + file + "\"");
  return ExitCode::Done;
}

}  // namespace

ExitCode print_carried_file(const CarriedFiles& files, const std::string& word,
                            const std::string& file, Output& output) {
  if (word.empty()) {
    if (!file.empty()) {
      return fail(
          output, ExitCode::Usage,
          Error{ErrorKind::BadInput,
                "no " + files.kind + " given; name one of: " + joined(files.names), "--output"});
    }
    list(files, output);
    return ExitCode::Done;
  }
  std::string text(files.built_in(word));
  if (text.empty()) {
    auto whole = files.whole(word);
    if (!whole) {
      const std::vector<Error>& errors = whole.error();
      for (std::size_t i = 0; i + 1 < errors.size(); ++i)
        print_error(output, errors[i]);
      return fail(output, ExitCode::Usage, errors.back());
    }
    text = std::move(*whole);
  }
  if (!file.empty()) return write(files, file, text, output);
  if (output.json) {
    output.out << JsonObject().add(files.kind, word).add("text", text).text() << "\n";
  } else {
    output.out << text;
  }
  return output.out.good() ? ExitCode::Done : ExitCode::Failed;
}

}  // namespace swarmsmith::cli
