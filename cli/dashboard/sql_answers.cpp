#include "cli/dashboard/sql_answers.h"

#include <chrono>
#include <stop_token>
#include <string_view>
#include <thread>
#include <utility>

#include "base/process/interrupt.h"
#include "base/process/process.h"

namespace swarmsmith::cli {
namespace {

/// Triggers `interrupt` when the client disconnects.
class Watch {
 public:
  explicit Watch(const std::function<bool()>& is_gone) {
    if (!is_gone) return;
    thread_ = std::jthread([this, &is_gone](const std::stop_token& stop) {
      constexpr int kLookAgain_ms = 100;
      while (!stop.stop_requested() && !over_.wait_ms(kLookAgain_ms))
        if (is_gone()) interrupt_.trigger();
    });
  }
  ~Watch() { over_.trigger(); }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  const Interrupt& interrupt() const { return interrupt_; }

 private:
  Interrupt interrupt_;
  Interrupt over_;
  std::jthread thread_;
};

/// The program's error message without the program's name and the statement, which the user knows.
std::string sentence_of(std::string_view errors, const std::string& sql) {
  constexpr std::string_view kName = "swarmsmith: ";
  if (errors.starts_with(kName)) errors.remove_prefix(kName.size());
  const std::string place = sql + ": ";
  if (errors.starts_with(place)) errors.remove_prefix(place.size());
  const std::size_t last = errors.find_last_not_of('\n');
  return std::string(errors.substr(0, last == std::string_view::npos ? 0 : last + 1));
}

}  // namespace

Expected<Answer> sql_answer(const Question& question, const std::string& program) {
  const std::string& sql = question.text("sql");
  if (sql.empty()) return bad_input("no statement given", "sql");
  const auto limit = question.integer("limit", kSqlRows, 1, kSqlRows);
  if (!limit) return Unexpected(limit.error());
  const std::string& format = question.text("format");
  const bool csv = format == "csv";
  if (!csv && !format.empty() && format != "json")
    return bad_input("must be json or csv, not \"" + format + "\"", "format");
  std::vector<std::string> words{program,     "query",
                                 "--store",   question.file.string(),
                                 "--limit",   std::to_string(*limit),
                                 "--seconds", std::to_string(kSqlSeconds)};
  if (csv) {
    words.emplace_back("--csv");
  } else {
    words.insert(words.end(), {"--json", "--lists"});
  }
  // With a blank in front, an SQL comment is not read as an option.
  const std::string word = " " + sql;
  words.push_back(word);
  const auto begin = std::chrono::steady_clock::now();
  const Watch watch(question.is_gone);
  const auto end = run_process({.words = std::move(words),
                                .folder = {},
                                .limit = std::chrono::seconds(kSqlSeconds + 5),
                                .keep = kSqlBytes},
                               watch.interrupt());
  if (!end) return Unexpected(end.error());
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (end->why == ProcessEnd::Why::Interrupted)
    return unexpected(ErrorKind::Unavailable, "the client disconnected");
  if (end->why == ProcessEnd::Why::Limit) {
    return bad_input("the statement was ended after " + std::to_string(kSqlSeconds) +
                         " s; ask for one design, or type it into `swarmsmith query`",
                     "sql");
  }
  if (end->exit_code != 0 || end->signal != 0) {
    const std::string said = sentence_of(end->errors.text, word);
    return bad_input(said.empty() ? "the statement could not be carried out" : said, "sql");
  }
  if (!end->output.complete()) {
    return bad_input(
        "the answer is longer than 8 MB; ask for fewer rows or columns, or use "
        "`swarmsmith query --csv`",
        "sql");
  }
  if (csv) return Answer{.type = kCsvType, .body = end->output.text};
  // {"columns":...}: as from `query --json --lists`, with the time.
  std::string body = end->output.text;
  if (body.empty() || body.front() != '{')
    return unexpected(ErrorKind::Unavailable, "the statement gave no answer");
  body.replace(0, 1, "{\"v\":1,\"seconds\":" + json_number(seconds) + ",");
  return Answer{.body = std::move(body)};
}

}  // namespace swarmsmith::cli
