#include "robot/log/log_file.h"

#include <array>
#include <string_view>
#include <utility>

#include "base/text/whole_file.h"
#include "robot/log/log_text.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kRows = ".log.csv";
constexpr std::string_view kHead = ".toml";

}  // namespace

LogFiles log_files_of(const std::filesystem::path& folder, const std::string& run,
                      const std::string& robot) {
  const std::string stem = run + "." + robot;
  return {folder / (stem + std::string(kRows)), folder / (stem + std::string(kHead))};
}

Expected<LogFiles> log_files_at(const std::filesystem::path& either) {
  const std::string name = either.filename().string();
  for (const std::string_view ending : {kRows, kHead}) {
    if (!name.ends_with(ending) || name.size() == ending.size()) continue;
    const std::string stem = name.substr(0, name.size() - ending.size());
    return LogFiles{either.parent_path() / (stem + std::string(kRows)),
                    either.parent_path() / (stem + std::string(kHead))};
  }
  return bad_input(
      "a robot's log consists of two files, such as run07.rvr1.log.csv and run07.rvr1.toml; "
      "name one of them",
      either.string());
}

OrErrors<RunRecord> read_robot_log(const std::filesystem::path& either) {
  const auto failed = [](const Error& error) { return tl::unexpected(std::vector<Error>{error}); };
  const auto files = log_files_at(either);
  if (!files) return failed(files.error());
  const auto head_bytes = read_whole_file(files->head);
  if (!head_bytes) return failed(head_bytes.error());
  const auto row_bytes = read_whole_file(files->rows);
  if (!row_bytes) return failed(row_bytes.error());
  auto head = parse_log_head(*head_bytes, files->head.string());
  if (!head) return tl::unexpected(head.error());
  auto rows = parse_log_rows(*row_bytes, files->rows.string());
  if (!rows) return tl::unexpected(rows.error());
  return RunRecord{std::move(*head), std::move(*rows)};
}

}  // namespace swarmsmith
