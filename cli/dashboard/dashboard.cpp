#include "cli/dashboard/dashboard.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <exception>
#include <functional>
#include <iterator>
#include <memory>
#include <mutex>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "base/text/json.h"
#include "cli/dashboard/answer_cache.h"
#include "cli/dashboard/live_answers.h"
#include "cli/dashboard/question.h"
#include "cli/dashboard/responses.h"
#include "cli/dashboard/routes.h"
#include "cli/dashboard/sql_answers.h"
#include "cli/dashboard/store_answers.h"
#include "cli/dashboard/store_readers.h"
#include "cli/output/stored_quarantine.h"
#include "coordinator/campaign/campaign.h"
#include "proto/access/address.h"
#include "sim/engine/simulate.h"

namespace swarmsmith::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kCacheBytes = std::size_t{32} << 20U;
/// A younger answer is given to other clients without computing it again.
constexpr std::chrono::milliseconds kFresh{500};
/// Numbers older than this are stale.
constexpr std::chrono::seconds kStale{5};
std::string now_text() {
  const auto now = std::chrono::system_clock::now();
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch());
  return fmt::format("{:%FT%T}.{:03}Z", fmt::gmtime(std::chrono::system_clock::to_time_t(now)),
                     ms.count() % 1000);
}

std::string name_of_user() {
  const passwd* user = getpwuid(geteuid());
  return user != nullptr ? user->pw_name : std::to_string(geteuid());
}

std::string random_hex(std::size_t words) {
  std::random_device device;
  std::string text;
  for (std::size_t i = 0; i < words; ++i)
    text += fmt::format("{:08x}", device());
  return text;
}

class Dashboard final : public HttpSite {
 public:
  explicit Dashboard(DashboardOptions options)
      : options_(std::move(options)), boot_(random_hex(2)), user_(name_of_user()) {}
  /// The threads that compute answers use all these members.
  ~Dashboard() override {
    heavy_.close();
    light_.close();
    cache_.wait_for_all();
  }

  bool is_open(std::string_view path) const override { return has_page(path) || path == "/"; }
  bool is_api(std::string_view path) const override { return path.starts_with("/api/"); }
  bool is_act(std::string_view path) const override {
    return act_of(path, options_.stores.size()).has_value();
  }
  std::string error_json(std::string_view kind, std::string_view message) const override {
    return error_text(kind, message, "");
  }

  void publish(const LiveStatus& status) override {
    auto fresh = std::make_shared<const Published>(Published{status, Clock::now()});
    const std::scoped_lock lock(mutex_);
    published_ = std::move(fresh);
    history_.add(status, std::chrono::system_clock::now());
  }

  SiteAnswer answer(const SiteRequest& request) override {
    SiteAnswer answer = is_api(request.path) ? api(request) : page_response(request);
    answer.headers.emplace_back("Referrer-Policy", "no-referrer");
    answer.headers.emplace_back("Cross-Origin-Resource-Policy", "same-origin");
    return answer;
  }

 private:
  struct Published {
    LiveStatus status;
    Clock::time_point when;
  };

  std::shared_ptr<const Published> published() const {
    const std::scoped_lock lock(mutex_);
    return published_;
  }

  /// The time of the last `live` answer.
  Clock::time_point told() const {
    const std::scoped_lock lock(mutex_);
    return told_;
  }

  SiteAnswer api(const SiteRequest& request) {
    const auto begin = Clock::now();
    AnswerCache::SoFar found;
    if (const auto act = act_of(request.path, options_.stores.size())) {
      found.answer = std::make_shared<const KeptAnswer>(kept_of(carry_out(*act, request), 0));
      cache_.forget();
    } else {
      found = find(request);
    }
    if (!found.answer) return not_yet_response(request, found);
    const double passed = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    // For an answer that was computed in the background, the time that it took there.
    const double spent = found.seconds > 0 ? 1e3 * found.seconds : found.shared ? 0 : passed;
    SiteAnswer answer = data_response(request, *found.answer);
    answer.headers.emplace_back("Server-Timing", fmt::format("total;dur={:.1f}", spent));
    if (found.answer->status == 503) answer.headers.emplace_back("Retry-After", "1");
    return answer;
  }

  /// A text that is the same for equal questions.
  static std::string key_of(const SiteRequest& request) {
    std::string key = request.path;
    for (const auto& [name, value] : request.parameters)
      key += '\n' + name + '=' + value;
    return key;
  }

  AnswerCache::SoFar find(const SiteRequest& request) {
    std::string_view path =
        std::string_view(request.path).substr(std::min(kApi.size(), request.path.size()));
    std::string key = key_of(request);
    const auto young = Clock::now() - kFresh;
    const auto made = [&](const std::string& stamp, Clock::time_point oldest,
                          const std::function<Expected<Answer>()>& make) {
      AnswerCache::SoFar found;
      found.answer = cache_.get(
          key, stamp, oldest, [&] { return timed(make); }, found.shared);
      return found;
    };
    for (const auto& [name, value] : request.parameters) {
      // A value that is passed on would end at the zero byte.
      if (value.find('\0') != std::string::npos)
        return made("", young,
                    [&name = name] { return bad_input("may not hold a zero byte", name); });
    }
    const std::string_view first = next_part(path);
    if (!request.path.starts_with(kApi)) return made("", young, [] { return no_such_path(); });
    if (first == "live" && path.empty()) {
      if (options_.before_live) options_.before_live();
      return made("", young, [this] { return live(); });
    }
    if (first == "workers" && path.empty()) return made("", young, [this] { return workers(); });
    if (first == "causes" && path.empty())
      return made("", young, [] { return json_answer(causes_json()); });
    if (first == "history" && path.empty())
      return made("", young, [&] { return history(request); });
    const auto store = store_named(first, options_.stores.size());
    if (!store) return made("", young, [] { return no_such_path(); });
    const DashboardStore& asked = options_.stores[*store];
    if (path == "query") return made("", young, [&] { return query(request, asked); });
    if (const auto routed = route_of(path)) {
      const Pattern& pattern = *routed->pattern;
      // A page asks when `live` has shown a change; older answers do not contain it.
      const std::string stamp = stamp_of(asked.file);
      // A final answer is one of this file: another store may get its name.
      key += '\n' + identity_of(asked.file);
      const auto oldest = std::max(young, told());
      const auto turn = std::make_shared<std::atomic<bool>>(false);
      if (options_.is_snapshot)
        return made(stamp, oldest, [&] { return ask(request, asked, pattern, routed->id, *turn); });
      SiteRequest later = request;
      later.is_gone = {};  // the client may disconnect and fetch the answer later
      return cache_.get_within(
          key, stamp, oldest,
          [this, later = std::move(later), &asked, &pattern, id = routed->id, turn] {
            return timed([&] { return ask(later, asked, pattern, id, *turn); });
          },
          turn, options_.patience);
    }
    return made("", young, [] { return no_such_path(); });
  }

  static Expected<Answer> no_such_path() {
    return unexpected(ErrorKind::NotFound, "there is no such path; docs/http-api.md lists them");
  }

  static KeptAnswer timed(const std::function<Expected<Answer>()>& make) {
    const auto begin = Clock::now();
    const Expected<Answer> answer = [&]() -> Expected<Answer> {
      try {
        return make();
      } catch (const std::exception& failure) {
        // A store that cannot be read any more (StoreFailure), or too little memory.
        return unexpected(ErrorKind::Unavailable, failure.what());
      }
    }();
    return kept_of(answer, std::chrono::duration<double>(Clock::now() - begin).count());
  }

  static Expected<Answer> busy() {
    return unexpected(ErrorKind::Unavailable,
                      "too many answers are being computed; ask again in a second");
  }

  Expected<Answer> ask(const SiteRequest& request, const DashboardStore& store,
                       const Pattern& pattern, const std::string& id, std::atomic<bool>& turn) {
    const auto pass = (pattern.is_heavy ? heavy_ : light_).enter();
    if (!pass) return busy();
    turn = true;
    const auto reader = readers_.take(store);
    if (!reader) return Unexpected(reader.error());
    Question question{.store = **reader,
                      .file = store.file,
                      .parameters = request.parameters,
                      .id = id,
                      .design = {},
                      .is_gone = request.is_gone,
                      .is_snapshot = options_.is_snapshot};
    if (pattern.path.starts_with("designs/")) {
      const auto design = id_from_text<DesignTag>(id);
      if (!design) return bad_input("must be a design such as d3", id);
      question.design = *design;
    }
    return pattern.route(question);
  }

  Expected<Answer> query(const SiteRequest& request, const DashboardStore& store) {
    // Together with the statement's own time limit, this is less than a connection may last.
    constexpr std::chrono::seconds kPatience{2};
    const auto turn = sql_.enter(kPatience);
    if (!turn) return busy();
    const auto pass = heavy_.enter(kPatience);
    if (!pass) return busy();
    const auto reader = readers_.take(store);
    if (!reader) return Unexpected(reader.error());
    return sql_answer({.store = **reader,
                       .file = store.file,
                       .parameters = request.parameters,
                       .is_gone = request.is_gone},
                      options_.program);
  }

  Expected<Answer> live() {
    const auto now = published();
    const bool runs = now && Clock::now() - now->when < kStale;
    std::vector<JsonObject> campaigns;
    std::vector<Look> looks = runs ? looks_of(now->status) : std::vector<Look>();
    for (std::size_t i = 0; i < options_.stores.size(); ++i) {
      const std::string c = "c" + std::to_string(i + 1);
      const DashboardStore& store = options_.stores[i];
      const bool is_written = has_writer(store.file);
      const auto reader = readers_.take(store);
      if (!reader) return Unexpected(reader.error());
      const CampaignStatus* status = nullptr;
      if (runs && store.place && now->status.campaigns &&
          *store.place < now->status.campaigns->size())
        status = &(*now->status.campaigns)[*store.place];
      const auto state = read_campaign_state(**reader, is_written, status);
      if (!state) return Unexpected(state.error());
      campaigns.push_back(campaign_json(c, options_.is_snapshot ? kSomeStore : store.file, *state,
                                        runs ? seconds_left(now->status) : -1,
                                        static_cast<bool>(options_.act)));
      std::ranges::move(looks_of(c, *state), std::back_inserter(looks));
    }
    {
      const std::scoped_lock lock(mutex_);
      told_ = Clock::now();
    }
    return json_answer(
        answer_object()
            .add("boot", options_.is_snapshot ? "snapshot" : boot_)
            .add("now", options_.is_snapshot ? std::nullopt : std::optional(now_text()))
            .add("host", options_.is_snapshot ? "" : name_of_this_host())
            .add("user", options_.is_snapshot ? "" : user_)
            .add("pid", options_.is_snapshot ? 0 : getpid())
            .add("version", options_.version)
            .add("engine", kEngineVersion)
            .add("may_act", static_cast<bool>(options_.act))
            .add("running", runs)
            .add("status", runs ? std::optional(head_json(now->status)) : std::nullopt)
            .add("looks", looks_json(looks))
            .add("campaigns", campaigns));
  }

  Expected<Answer> workers() {
    const auto now = published();
    if (now && Clock::now() - now->when < kStale)
      return json_answer(answer_object()
                             .add("workers", fleet_json(now->status))
                             .add("quarantine", quarantine_json(now->status.quarantine)));
    std::vector<JsonPiece> all;
    std::vector<QuarantineStatus> quarantine;
    for (const DashboardStore& store : options_.stores) {
      const auto reader = readers_.take(store);
      if (!reader) return Unexpected(reader.error());
      const auto workers = stored_workers(**reader, has_writer(store.file));
      if (!workers) return Unexpected(workers.error());
      auto its = stored_quarantine(**reader);
      if (!its) return Unexpected(its.error());
      std::ranges::move(*its, std::back_inserter(quarantine));
      std::ranges::move(*workers, std::back_inserter(all));
    }
    return json_answer(
        answer_object().add("workers", all).add("quarantine", quarantine_json(quarantine)));
  }

  Expected<Answer> history(const SiteRequest& request) {
    const auto after = request.parameters.find("after");
    double after_s = 0;
    if (after != request.parameters.end()) {
      const std::string& text = after->second;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), after_s);
      if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(after_s))
        return bad_input("must be seconds since 1970, not \"" + text + "\"", "after");
    }
    const std::scoped_lock lock(mutex_);
    return json_answer(history_.json(after_s));
  }

  Expected<Answer> carry_out(const Act& act, const SiteRequest& request) {
    if (!options_.act) return bad_input("this dashboard is read-only");
    CommandRow command{.kind = act.kind,
                       .design = act.design,
                       .step = std::nullopt,
                       .budget = 0,
                       .who = "dashboard " + request.peer};
    if (act.kind == CommandKind::Extend) {
      const auto budget = integer_parameter(request.parameters, "budget", 0, 1, kLargestBudget);
      if (!budget) return Unexpected(budget.error());
      if (*budget == 0)
        return bad_input("no budget given: name the number of further experiments", "budget");
      command.budget = *budget;
    }
    const auto done = options_.act(options_.stores[act.store].file, command);
    if (!done) return Unexpected(done.error());
    return json_answer(answer_object()
                           .add("command", swarmsmith::word_of(act.kind))
                           .add("design", act.design)
                           .add("done", *done));
  }

  DashboardOptions options_;
  std::string boot_;
  std::string user_;
  StoreReaders readers_;
  AnswerCache cache_{kCacheBytes};
  // A page with results asks for some twenty pictures and tables at once, and a person may have
  // several pages open. A waiting client costs only a sleeping thread.
  Turnstile heavy_{2, 128};
  Turnstile light_{6, 128};
  Turnstile sql_{1, 4};
  mutable std::mutex mutex_;
  std::shared_ptr<const Published> published_;
  Clock::time_point told_{};
  History history_;
};

}  // namespace

std::shared_ptr<HttpSite> make_dashboard(DashboardOptions options) {
  return std::make_shared<Dashboard>(std::move(options));
}

std::string new_token() {
  return random_hex(8);
}

std::filesystem::path token_file_of(const std::filesystem::path& store) {
  return store.string() + ".token";
}

Expected<void> write_token(const std::filesystem::path& file, const std::string& token) {
  const auto failed = [&] {
    return unexpected(
        ErrorKind::Unavailable,
        std::string("the token of the dashboard cannot be written: ") + std::strerror(errno),
        file.string());
  };
  // Makes a new file, so that no other process can have it open.
  ::unlink(file.c_str());
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (fd < 0) return failed();
  const std::string line = token + "\n";
  const bool written = ::write(fd, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  const bool closed = ::close(fd) == 0;
  if (!written || !closed) return failed();
  return {};
}

}  // namespace swarmsmith::cli
