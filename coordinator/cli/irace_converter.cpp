#include "coordinator/cli/irace_converter.h"

#include <stdlib.h>
#include <sys/wait.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <system_error>
#include <thread>
#include <utility>

#include "console/counter.h"
#include "coordinator/launchers/child_process.h"
#include "coordinator/results/irace_log.h"
#include "embedded/kIraceLogScript.h"

namespace swarmsmith::cli {
namespace {

namespace fs = std::filesystem;

/// A folder that goes away again, with what is in it.
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

/// Waits for R; its status as of waitpid, and the last line of its errors.
Expected<std::pair<int, std::string>> run_script(const fs::path& script, const fs::path& log,
                                                 const fs::path& folder, Output& output) {
  ChildProcess process;
  const auto started =
      process.start({"Rscript", "--vanilla", script.string(), log.string(), folder.string()},
                    ChildProcess::Streams::Held);
  if (!started) {
    return unexpected(
        ErrorKind::Unavailable,
        "logs of irace are read through R, and Rscript " + started.error().message +
            "; install r-base-core, or make the tables where R is (docs/command-line.md, import)",
        log.string());
  }
  Counter counter(output, "converted", "logs");
  while (true) {
    if (const auto status = process.ended()) return std::pair{*status, process.last_line()};
    process.last_line();  // R would wait for a reader of its errors
    counter.tell(0, 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace

std::map<std::string, std::string> read_log_folder(const fs::path& folder) {
  std::map<std::string, std::string> texts;
  for (const std::string& name : irace_log_files()) {
    std::ifstream stream(folder / name, std::ios::binary);
    if (!stream) continue;
    std::ostringstream text;
    text << stream.rdbuf();
    texts.emplace(name, text.str());
  }
  return texts;
}

Expected<std::map<std::string, std::string>> convert_irace_log(const fs::path& log,
                                                               Output& output) {
  const auto folder = ScratchFolder::make();
  if (!folder) return Unexpected(folder.error());
  const fs::path script = folder->path() / "irace_log.R";
  std::ofstream(script) << kIraceLogScript;
  const auto ran = run_script(script, log, folder->path(), output);
  if (!ran) return Unexpected(ran.error());
  const auto& [status, last_line] = *ran;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return read_log_folder(folder->path());
  return bad_input("R could not read the log" + (last_line.empty() ? "" : ": " + last_line),
                   log.string());
}

}  // namespace swarmsmith::cli
