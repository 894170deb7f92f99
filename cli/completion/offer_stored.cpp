#include "cli/completion/offer_stored.h"

#include <algorithm>
#include <array>
#include <exception>
#include <fstream>
#include <memory>
#include <set>
#include <vector>

#include "base/log.h"
#include "console/options.h"
#include "sim/control/flavour_file.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "sim/files/robot_file.h"
#include "storage/store.h"

namespace swarmsmith::cli {
namespace {

namespace fs = std::filesystem;

/// The query for the values of a kind in a store; its two columns are the value and its
/// description.
struct StoredKind {
  std::string_view kind;
  std::string_view query;
};
constexpr std::array kStoredKinds = {
    StoredKind{"DESIGN",
               "SELECT 'd' || design, mission || ', ' || method || ', repetition ' || repetition "
               "|| ', ' || state FROM v_designs ORDER BY design"},
    StoredKind{"CANDIDATE",
               "SELECT DISTINCT 'c' || candidate, 'elite of d' || design FROM v_convergence "
               "ORDER BY design, candidate"},
    StoredKind{"WHO",
               "SELECT DISTINCT principal, 'in quarantine' FROM v_workers "
               "WHERE state = 'quarantined' ORDER BY principal"},
    StoredKind{"RUN", "SELECT id, mission || ', ' || verdict FROM v_real_runs ORDER BY run"},
    StoredKind{"MISSION", "SELECT DISTINCT mission, '' FROM v_designs ORDER BY mission"},
    StoredKind{"METHOD", "SELECT DISTINCT method, '' FROM v_designs ORDER BY method"},
    StoredKind{"SOURCE", "SELECT DISTINCT source, '' FROM v_design_scores ORDER BY source"},
    StoredKind{"PARAMETER",
               "SELECT DISTINCT parameter, '' FROM v_parameters WHERE candidate IN "
               "(SELECT best_candidate FROM v_designs) ORDER BY parameter"},
};

bool is_database(const fs::path& file) {
  std::error_code trouble;
  if (!fs::is_regular_file(file, trouble)) return false;
  constexpr std::string_view kBegin = "SQLite format 3";
  std::array<char, kBegin.size()> begin{};
  std::ifstream stream(file, std::ios::binary);
  return stream.read(begin.data(), static_cast<std::streamsize>(kBegin.size())) &&
         std::string_view(begin.data(), begin.size()) == kBegin;
}

void offer_of_store(const fs::path& store, std::string_view query, Offer& offer) {
  const auto reader = StoreReader::open(store);
  if (!reader) return;
  const StoreReader::QueryLimits limits{.rows = 1000, .seconds = 0.5, .bytes = 1 << 20};
  // Kinds that a store lacks, such as real runs in an older store, offer no values.
  (void)(*reader)->query(
      std::string(query), limits, [](const auto&) {},
      [&](const std::vector<StoreReader::Cell>& cells) {
        if (!cells.at(0).text.empty()) offer.words.push_back({cells[0].text, cells.at(1).text});
      });
}

void offer_names(const std::vector<std::string>& names, Offer& offer) {
  for (const std::string& name : names)
    offer.words.push_back({name, ""});
}

void offer_built_in(std::string_view kind, Offer& offer) {
  if (kind == "MISSION") offer_names(mission_names(), offer);
  if (kind == "PROFILE") offer_names(profile_names(), offer);
  if (kind == "BEST") offer.words.push_back({"best", "the winners of the finished designs"});
  if (kind == "FLAVOUR") offer_names(flavour_names(), offer);
  if (kind == "ROBOT") offer_names(robot_names(), offer);
}

}  // namespace

std::optional<fs::path> store_in_words(std::span<const std::string> words, const fs::path& folder) {
  for (const std::string& word : words) {
    const std::size_t value = word.starts_with("--") ? word.find('=') : std::string::npos;
    const fs::path file = folder / (value == std::string::npos ? word : word.substr(value + 1));
    if (is_database(file)) return file;
  }
  if (const std::string store = store_of_environment(); !store.empty()) return folder / store;
  std::optional<fs::path> found;
  std::error_code trouble;
  for (fs::directory_iterator entry(folder, trouble), end; !trouble && entry != end;
       entry.increment(trouble)) {
    if (entry->path().extension() != ".db" || !is_database(entry->path())) continue;
    if (found) return std::nullopt;
    found = entry->path();
  }
  return found;
}

void offer_stored(std::string_view kind, std::span<const std::string> words, Offer& offer) {
  set_log_level(LogLevel::None);
  const std::size_t before = offer.words.size();
  offer_built_in(kind, offer);
  const auto* const stored = std::ranges::find(kStoredKinds, kind, &StoredKind::kind);
  if (stored == kStoredKinds.end()) return;
  try {
    if (const auto store = store_in_words(words, fs::current_path()))
      offer_of_store(*store, stored->query, offer);
  } catch (const std::exception&) {
    // A damaged store offers no values.
    offer.words.resize(before);
    offer_built_in(kind, offer);
  }
  // A mission of the store may also be built in.
  std::set<std::string> known;
  std::erase_if(offer.words,
                [&](const Offer::Word& word) { return !known.insert(word.text).second; });
}

}  // namespace swarmsmith::cli
