#include "cli/commands/irace_converter.h"

#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "base/process/child_process.h"
#include "base/text/whole_file.h"
#include "console/counter.h"
#include "coordinator/results/irace_log.h"
#include "embedded/kIraceLogScript.h"
#include "embedded/kIraceRdataScript.h"

namespace swarmsmith::cli {
namespace {

namespace fs = std::filesystem;

/// A folder that is deleted with its contents by the destructor.
class ScratchFolder {
 public:
  static Expected<ScratchFolder> make() {
    std::error_code trouble;
    std::string name = (fs::temp_directory_path(trouble) / "swarmsmith-log-XXXXXX").string();
    if (trouble || ::mkdtemp(name.data()) == nullptr) {
      return unexpected(ErrorKind::Unavailable, "no temporary folder can be made; set TMPDIR",
                        name);
    }
    return ScratchFolder(std::move(name));
  }
  ScratchFolder(ScratchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  ScratchFolder& operator=(ScratchFolder&&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  explicit ScratchFolder(fs::path path) : path_(std::move(path)) {}
  fs::path path_;
};

constexpr std::size_t kLargestLog = std::size_t{4} << 30U;  // bytes

/// One of our R scripts, with two files or folders as arguments.
struct Script {
  std::string name;
  std::string_view text;
  fs::path from;
  fs::path to;
  std::string verb;     ///< for the counter: "converted"
  std::string without;  ///< advice if there is no R
};

/// Runs R until it ends. Returns its reason for refusing, or an empty text if it succeeded.
Expected<std::string> run_script(const Script& script, const fs::path& folder, const fs::path& log,
                                 Output& output) {
  const fs::path file = folder / script.name;
  if (auto written = write_whole_file(file.string(), script.text); !written)
    return Unexpected(written.error());
  ChildProcess process;
  // Texts are UTF-8 in any locale of the user.
  const auto started = process.start(
      {"Rscript", "--vanilla", file.string(), script.from.string(), script.to.string()},
      ChildProcess::Streams::Held, {"LC_ALL=C.UTF-8"});
  if (!started) {
    return unexpected(ErrorKind::Unavailable,
                      "logs of irace are files of R, and Rscript " + started.error().message +
                          "; install r-base-core, or " + script.without,
                      log.string());
  }
  Counter counter(output, script.verb, "logs");
  while (true) {
    if (const auto status = process.ended()) {
      if (WIFEXITED(*status) && WEXITSTATUS(*status) == 0) return "";
      const std::string& reason = process.last_line();
      return reason.empty() ? "it gives no reason" : reason;
    }
    process.last_line();  // reads all errors, because R would wait for a reader
    counter.tell(0, 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace

std::map<std::string, std::string> read_log_folder(const fs::path& folder) {
  std::map<std::string, std::string> texts;
  for (const std::string& name : irace_log_files()) {
    if (auto text = read_file(folder / name, "table", kLargestLog))
      texts.emplace(name, std::move(*text));
  }
  return texts;
}

Expected<std::map<std::string, std::string>> convert_irace_log(const fs::path& log,
                                                               Output& output) {
  const auto folder = ScratchFolder::make();
  if (!folder) return Unexpected(folder.error());
  const auto refused =
      run_script({.name = "irace_log.R",
                  .text = kIraceLogScript,
                  .from = log,
                  .to = folder->path(),
                  .verb = "converted",
                  .without = "make the tables where R is (docs/command-line.md, import)"},
                 folder->path(), log, output);
  if (!refused) return Unexpected(refused.error());
  if (refused->empty()) return read_log_folder(folder->path());
  return bad_input("R could not read the log: " + *refused, log.string());
}

Expected<std::string> make_irace_log(const std::map<std::string, std::string>& tables,
                                     const fs::path& log, Output& output) {
  const auto folder = ScratchFolder::make();
  if (!folder) return Unexpected(folder.error());
  for (const auto& [name, text] : tables) {
    const auto written = write_whole_file((folder->path() / name).string(), text);
    if (!written) return Unexpected(written.error());
  }
  const fs::path made = folder->path() / "irace.Rdata";
  const auto refused =
      run_script({.name = "irace_rdata.R",
                  .text = kIraceRdataScript,
                  .from = folder->path(),
                  .to = made,
                  .verb = "written",
                  .without = "write its tables with -o FOLDER/ and make it of them where R is "
                             "(docs/command-line.md, export)"},
                 folder->path(), log, output);
  if (!refused) return Unexpected(refused.error());
  if (auto bytes = read_file(made, "log", kLargestLog); refused->empty() && bytes) return *bytes;
  return unexpected(ErrorKind::Conflict, "R could not write the log: " + *refused, log.string());
}

}  // namespace swarmsmith::cli
