#include "irace_core/files/command_line.h"

#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {

/// Lines of the input are the words of a command line: they are refused with reasons, or read.
void run(std::string_view input) {
  std::vector<std::string> words(1);
  for (const char c : input) {
    if (c == '\n') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  const auto line = read_irace_command_line(words, "/here");
  if (!line) {
    require(!line.error().empty(), "a refusal has a reason");
    for (const Error& error : line.error())
      require(!error.message.empty(), "an error has a message");
    return;
  }
  require(line->action != IraceAction::OnlyTest || line->only_test.is_absolute(),
          "--only-test has its file");
  for (const IraceSetting& setting : line->settings.all())
    require(!irace_refusal(*setting.option, setting.value), "what is refused is not kept");
}

}  // namespace swarmsmith::fuzz
