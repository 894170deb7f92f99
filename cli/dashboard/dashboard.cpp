#include "cli/dashboard/dashboard.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <array>
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
#include <span>
#include <string_view>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "base/hash.h"
#include "base/text/gzip.h"
#include "base/text/json.h"
#include "cli/dashboard/answer_cache.h"
#include "cli/dashboard/figure_answers.h"
#include "cli/dashboard/live_answers.h"
#include "cli/dashboard/question.h"
#include "cli/dashboard/race_answers.h"
#include "cli/dashboard/run_answers.h"
#include "cli/dashboard/sql_answers.h"
#include "cli/dashboard/store_answers.h"
#include "cli/output/stored_quarantine.h"
#include "coordinator/campaign/campaign.h"
#include "proto/access/address.h"
#include "sim/engine/simulate.h"
#include "web/pages.h"

namespace swarmsmith::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view kApi = "/api/v1/";
constexpr std::size_t kCacheBytes = std::size_t{32} << 20U;
/// An answer as young as that is not made again for the next who asks.
constexpr std::chrono::milliseconds kFresh{500};
/// Older numbers than that are no numbers of now.
constexpr std::chrono::seconds kStale{5};
constexpr std::size_t kMostUnpacked = std::size_t{256} << 20U;

constexpr const char* kPagePolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
/// Of what is no page: figures have styles of their own, and nothing else.
constexpr const char* kDataPolicy =
    "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'; sandbox";

constexpr const char* kNoPages =
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>Swarmsmith</title>"
    "<p>This program was built without its pages: where it was built, esbuild, node-preact or "
    "zopfli was not installed. What they show is below <a href=\"api/v1/live\">api/v1/live</a> "
    "as JSON (docs/http-api.md).</p></html>\n";

using Route = Expected<Answer> (*)(const Question&);

struct Pattern {
  /// Below c1/: "designs/*/race"; * is an id.
  std::string_view path;
  Route route;
  bool is_heavy = false;
};

constexpr std::array<Pattern, 18> kRoutes = {{
    {"", campaign_answer},
    {"events", events_answer},
    {"convergence", convergence_answer},
    {"designs/*", design_answer},
    {"designs/*/steps", steps_answer},
    {"designs/*/race", race_answer, true},
    {"designs/*/parameters", parameters_answer, true},
    {"candidates/*", candidate_answer},
    {"evaluations/*", evaluation_answer},
    {"runs/*/trajectory", trajectory_answer, true},
    {"runs/*/trajectory.csv", trajectory_csv_answer, true},
    {"figures/*", figure_answer, true},
    {"comparison/*", comparison_answer, true},
    {"scores", scores_answer},
    {"leaderboard", leaderboard_answer},
    {"modules", modules_answer},
    {"real-runs", real_runs_answer},
    {"views", views_answer},
}};

std::string_view next_part(std::string_view& path) {
  const std::size_t slash = std::min(path.find('/'), path.size());
  const std::string_view part = path.substr(0, slash);
  path.remove_prefix(std::min(slash + 1, path.size()));
  return part;
}

/// The id in the path, where the pattern fits.
std::optional<std::string> fit(std::string_view pattern, std::string_view path) {
  std::string id;
  while (!pattern.empty() && !path.empty()) {
    const std::string_view wanted = next_part(pattern);
    const std::string_view part = next_part(path);
    if (wanted == "*") {
      id = part;
    } else if (wanted != part) {
      return std::nullopt;
    }
  }
  return pattern.empty() && path.empty() ? std::optional(id) : std::nullopt;
}

int status_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::BadInput:
      return 400;
    case ErrorKind::NotFound:
      return 404;
    case ErrorKind::Conflict:
    case ErrorKind::Corrupt:
    case ErrorKind::Newer:
      return 409;
    case ErrorKind::Unavailable:
      break;
  }
  return 503;
}

const char* word_of_kind(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::BadInput:
      return "bad_input";
    case ErrorKind::NotFound:
      return "not_found";
    case ErrorKind::Conflict:
      return "conflict";
    case ErrorKind::Corrupt:
      return "corrupt";
    case ErrorKind::Newer:
      return "newer";
    case ErrorKind::Unavailable:
      break;
  }
  return "unavailable";
}

std::string error_text(std::string_view kind, std::string_view message, std::string_view where) {
  return answer_object()
             .add("error",
                  JsonObject().add("kind", kind).add("message", message).add("where", where))
             .text() +
         "\n";
}

std::string etag_of(std::string_view type, std::string_view bytes) {
  Digest digest;
  digest.add(type);
  digest.add(bytes);
  return fmt::format("\"{:016x}\"", digest.value64());
}

KeptAnswer kept_of(const Expected<Answer>& answer, double seconds) {
  KeptAnswer kept;
  kept.seconds = seconds;
  if (answer) {
    kept.type = answer->type;
    kept.packed = gzip(answer->body);
    kept.etag = etag_of(answer->type, answer->body);
    kept.is_final = answer->is_final;
    return kept;
  }
  const Error& error = answer.error();
  kept.status = status_of(error.kind);
  kept.type = "application/json";
  kept.packed = gzip(error_text(word_of_kind(error.kind), error.message, error.where));
  kept.is_good = false;
  return kept;
}

/// Says whether a store's files have changed, without opening them. Empty while they change: the
/// clock of files is too coarse to tell what comes next.
std::string stamp_of(const std::filesystem::path& file) {
  constexpr auto kSettled = std::chrono::milliseconds(200);
  std::string stamp;
  for (const std::string& name : {file.string(), file.string() + "-wal"}) {
    struct stat facts = {};
    if (::stat(name.c_str(), &facts) != 0) {
      stamp += "-;";
      continue;
    }
    const auto changed = std::chrono::system_clock::time_point(
        std::chrono::duration_cast<std::chrono::system_clock::duration>(
            std::chrono::seconds(facts.st_mtim.tv_sec) +
            std::chrono::nanoseconds(facts.st_mtim.tv_nsec)));
    if (std::chrono::system_clock::now() - changed < kSettled) return "";
    stamp += fmt::format("{}.{}.{}.{};", facts.st_ino, facts.st_size, facts.st_mtim.tv_sec,
                         facts.st_mtim.tv_nsec);
  }
  return stamp;
}

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

/// Readers of the stores that stay open, kept from one answer to the next: opening one takes SQLite
/// some milliseconds, most of an answer, to read what tables and views there are. Of other stores
/// none is kept: while it is open, its writer cannot fold the log into the file at its end.
class Readers {
 public:
  using Reader = std::unique_ptr<StoreReader, std::function<void(StoreReader*)>>;

  Expected<Reader> take(const DashboardStore& store) {
    struct stat facts = {};
    const bool may_keep = store.stays_open && ::stat(store.file.c_str(), &facts) == 0;
    const File file{facts.st_dev, facts.st_ino};
    if (may_keep) {
      const std::scoped_lock lock(mutex_);
      // Another file under the name is another store.
      std::erase_if(kept_,
                    [&](const Kept& kept) { return kept.name == store.file && kept.file != file; });
      const auto found = std::ranges::find(kept_, store.file, &Kept::name);
      if (found != kept_.end()) {
        StoreReader* const reader = found->reader.release();
        kept_.erase(found);
        return lent(reader, store.file, file);
      }
    }
    auto opened = StoreReader::open(store.file);
    if (!opened) return Unexpected(opened.error());
    if (may_keep) return lent(opened->release(), store.file, file);
    return Reader(opened->release(), std::default_delete<StoreReader>());
  }

 private:
  using File = std::pair<dev_t, ino_t>;
  struct Kept {
    std::filesystem::path name;
    File file;
    std::unique_ptr<StoreReader> reader;
  };
  /// Of all stores: as many as answers are made at the same time, mostly.
  static constexpr std::size_t kMost = 4;

  Reader lent(StoreReader* reader, const std::filesystem::path& name, File file) {
    return {reader, [this, name, file](StoreReader* back) {
              std::unique_ptr<StoreReader> returned(back);
              // After a failure of the disk nothing is known of it.
              if (std::uncaught_exceptions() > 0) return;
              returned->rest();
              const std::scoped_lock lock(mutex_);
              if (kept_.size() < kMost) kept_.push_back({name, file, std::move(returned)});
            }};
  }

  std::mutex mutex_;
  std::vector<Kept> kept_;
};

/// What is asked of a campaign or a design by POST.
struct Act {
  std::size_t store = 0;
  DesignId design{};
  CommandKind kind = CommandKind::Unknown;
};

class Dashboard final : public HttpSite {
 public:
  explicit Dashboard(DashboardOptions options)
      : options_(std::move(options)), boot_(random_hex(2)), user_(name_of_user()) {}
  /// Threads that compute use all of this.
  ~Dashboard() override {
    heavy_.close();
    light_.close();
    cache_.wait_for_all();
  }

  bool is_open(std::string_view path) const override {
    return find_page(path) != nullptr || path == "/";
  }
  bool is_api(std::string_view path) const override { return path.starts_with("/api/"); }
  bool is_act(std::string_view path) const override { return act_of(path).has_value(); }
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
    SiteAnswer answer = is_api(request.path) ? api(request) : page(request);
    answer.headers.emplace_back("Referrer-Policy", "no-referrer");
    answer.headers.emplace_back("Cross-Origin-Resource-Policy", "same-origin");
    return answer;
  }

 private:
  struct Published {
    LiveStatus status;
    Clock::time_point when;
  };

  static const PageFile* find_page(std::string_view path) {
    for (const PageFile& file : page_files())
      if (file.path == path) return &file;
    return nullptr;
  }

  static SiteAnswer page(const SiteRequest& request) {
    const PageFile* file = find_page(request.path);
    if (file != nullptr) {
      KeptAnswer kept{.type = std::string(file->type),
                      .packed = std::string(file->packed),
                      .etag = etag_of(file->type, file->packed)};
      return outgoing(request, kept, kPagePolicy);
    }
    const bool is_start = request.path == "/";
    SiteAnswer answer{.status = is_start ? 200 : 404,
                      .type = is_start ? "text/html; charset=utf-8" : "text/plain",
                      .body = is_start ? kNoPages : "there is no such page\n"};
    answer.headers.emplace_back("Content-Security-Policy", kPagePolicy);
    return answer;
  }

  /// As the asker takes it: nothing of what it has, packed or not.
  static SiteAnswer outgoing(const SiteRequest& request, const KeptAnswer& kept,
                             const char* policy) {
    SiteAnswer answer{.status = kept.status, .type = kept.type, .body = {}};
    answer.headers.emplace_back("Content-Security-Policy", policy);
    answer.headers.emplace_back("Vary", "Accept-Encoding");
    if (!kept.etag.empty()) answer.headers.emplace_back("ETag", kept.etag);
    if (!kept.etag.empty() && request.etag.find(kept.etag) != std::string::npos) {
      answer.status = 304;
      return answer;
    }
    if (request.accepts_gzip) {
      answer.headers.emplace_back("Content-Encoding", "gzip");
      answer.body = kept.packed;
    } else {
      answer.body = gunzip(kept.packed, kMostUnpacked).value_or("");
    }
    return answer;
  }

  std::shared_ptr<const Published> published() const {
    const std::scoped_lock lock(mutex_);
    return published_;
  }

  /// When `live` was made last.
  Clock::time_point told() const {
    const std::scoped_lock lock(mutex_);
    return told_;
  }

  std::optional<std::size_t> store_named(std::string_view name) const {
    for (std::size_t i = 0; i < options_.stores.size(); ++i)
      if (name == "c" + std::to_string(i + 1)) return i;
    return std::nullopt;
  }

  std::optional<Act> act_of(std::string_view path) const {
    if (!path.starts_with(kApi)) return std::nullopt;
    path.remove_prefix(kApi.size());
    const auto store = store_named(next_part(path));
    if (!store) return std::nullopt;
    Act act{.store = *store};
    std::string_view word = next_part(path);
    if (word == "designs") {
      const auto design = id_from_text<DesignTag>(next_part(path));
      if (!design) return std::nullopt;
      act.design = *design;
      word = next_part(path);
    }
    if (!path.empty()) return std::nullopt;
    for (const CommandKind kind :
         {CommandKind::Pause, CommandKind::Resume, CommandKind::Cancel, CommandKind::Extend}) {
      const bool fits = act.design || is_of_leases(kind);
      if (fits && word == swarmsmith::word_of(kind)) {
        act.kind = kind;
        return act;
      }
    }
    return std::nullopt;
  }

  SiteAnswer api(const SiteRequest& request) {
    const auto begin = Clock::now();
    AnswerCache::SoFar found;
    if (const auto act = act_of(request.path)) {
      found.answer = std::make_shared<const KeptAnswer>(kept_of(carry_out(*act, request), 0));
      cache_.forget();
    } else {
      found = find(request);
    }
    if (!found.answer) return not_yet(request, found);
    const double passed = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    // An answer made in the background cost what it took there.
    const double spent = found.seconds > 0 ? 1e3 * found.seconds : found.shared ? 0 : passed;
    SiteAnswer answer = outgoing(request, *found.answer, kDataPolicy);
    answer.headers.emplace_back("Server-Timing", fmt::format("total;dur={:.1f}", spent));
    if (found.answer->status == 503) answer.headers.emplace_back("Retry-After", "1");
    return answer;
  }

  /// 202: how far it is, and where to ask again, which is the same address.
  static SiteAnswer not_yet(const SiteRequest& request, const AnswerCache::SoFar& so_far) {
    std::string place = request.path;
    for (const auto& [name, value] : request.parameters)
      place += (place.size() == request.path.size() ? '?' : '&') + as_in_address(name) + '=' +
               as_in_address(value);
    const std::string body =
        answer_object()
            .add("pending", JsonObject()
                                .add("state", so_far.goes_on ? "computing" : "waiting")
                                .add("seconds", so_far.seconds)
                                .add("place", place))
            .text() +
        "\n";
    SiteAnswer answer = outgoing(
        request, {.status = 202, .type = "application/json", .packed = gzip(body), .etag = {}},
        kDataPolicy);
    answer.headers.emplace_back("Location", place);
    answer.headers.emplace_back("Retry-After", "1");
    return answer;
  }

  static std::string as_in_address(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
      const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                         (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
      escaped += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return escaped;
  }

  /// The question's text, the same for equal questions.
  static std::string key_of(const SiteRequest& request) {
    std::string key = request.path;
    for (const auto& [name, value] : request.parameters)
      key += '\n' + name + '=' + value;
    return key;
  }

  AnswerCache::SoFar find(const SiteRequest& request) {
    std::string_view path =
        std::string_view(request.path).substr(std::min(kApi.size(), request.path.size()));
    const std::string key = key_of(request);
    const auto young = Clock::now() - kFresh;
    const auto made = [&](const std::string& stamp, Clock::time_point oldest,
                          const std::function<Expected<Answer>()>& make) {
      AnswerCache::SoFar found;
      found.answer = cache_.get(
          key, stamp, oldest, [&] { return timed(make); }, found.shared);
      return found;
    };
    for (const auto& [name, value] : request.parameters) {
      // What is handed on would end there.
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
    const auto store = store_named(first);
    if (!store) return made("", young, [] { return no_such_path(); });
    const DashboardStore& asked = options_.stores[*store];
    if (path == "query") return made("", young, [&] { return query(request, asked); });
    for (const Pattern& pattern : kRoutes) {
      const auto id = fit(pattern.path, path);
      if (!id) continue;
      // A page asks when `live` has told it of something new: older answers lack it.
      const std::string stamp = stamp_of(asked.file);
      const auto oldest = std::max(young, told());
      const auto turn = std::make_shared<std::atomic<bool>>(false);
      if (options_.is_snapshot)
        return made(stamp, oldest, [&] { return ask(request, asked, pattern, *id, *turn); });
      SiteRequest later = request;
      later.is_gone = {};  // the client may disconnect, and fetch the answer
      return cache_.get_within(
          key, stamp, oldest,
          [this, later = std::move(later), &asked, &pattern, id = *id, turn] {
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
        // A store that cannot be read any more (StoreFailure), or no memory.
        return unexpected(ErrorKind::Unavailable, failure.what());
      }
    }();
    return kept_of(answer, std::chrono::duration<double>(Clock::now() - begin).count());
  }

  static Expected<Answer> busy() {
    return unexpected(ErrorKind::Unavailable,
                      "too much is being computed for others; ask again in a second");
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
      if (!design) return bad_input("wants a design such as d3", id);
      question.design = *design;
    }
    return pattern.route(question);
  }

  Expected<Answer> query(const SiteRequest& request, const DashboardStore& store) {
    // Together with the statement's own time less than a connection lives.
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
    std::string campaigns;
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
      campaigns +=
          (i == 0 ? "" : ",") + campaign_json(c, options_.is_snapshot ? kSomeStore : store.file,
                                              *state, runs ? seconds_left(now->status) : -1,
                                              static_cast<bool>(options_.act))
                                    .text();
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
            .add("campaigns", JsonPiece{"[" + campaigns + "]"}));
  }

  Expected<Answer> workers() {
    const auto now = published();
    if (now && Clock::now() - now->when < kStale)
      return json_answer(
          answer_object()
              .add("workers", fleet_json(now->status))
              .add("quarantine", quarantine_json(now->status.quarantine)));
    std::string all;
    std::vector<QuarantineStatus> quarantine;
    for (const DashboardStore& store : options_.stores) {
      const auto reader = readers_.take(store);
      if (!reader) return Unexpected(reader.error());
      const auto workers = stored_workers(**reader, has_writer(store.file));
      if (!workers) return Unexpected(workers.error());
      auto its = stored_quarantine(**reader);
      if (!its) return Unexpected(its.error());
      std::ranges::move(*its, std::back_inserter(quarantine));
      const std::string list = workers->text.substr(1, workers->text.size() - 2);
      if (!list.empty()) all += (all.empty() ? "" : ",") + list;
    }
    return json_answer(answer_object()
                           .add("workers", JsonPiece{"[" + all + "]"})
                           .add("quarantine", quarantine_json(quarantine)));
  }

  Expected<Answer> history(const SiteRequest& request) {
    const auto after = request.parameters.find("after");
    double after_s = 0;
    if (after != request.parameters.end()) {
      const std::string& text = after->second;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), after_s);
      if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(after_s))
        return bad_input("wants seconds since 1970, not \"" + text + "\"", "after");
    }
    const std::scoped_lock lock(mutex_);
    return json_answer(history_.json(after_s));
  }

  Expected<Answer> carry_out(const Act& act, const SiteRequest& request) {
    if (!options_.act) return bad_input("nobody may act here");
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
  Readers readers_;
  AnswerCache cache_{kCacheBytes};
  Turnstile heavy_{2, 16};
  Turnstile light_{6, 32};
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
  // A new file, so that nobody has it open already.
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
