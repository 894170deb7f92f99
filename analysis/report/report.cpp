#include "analysis/report/report.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/records/names.h"
#include "analysis/report/internal/sections.h"
#include "base/plain_text.h"

namespace swarmsmith {
namespace {

std::string title_of(const std::vector<CampaignRecord>& campaigns) {
  std::vector<std::string> names;
  names.reserve(campaigns.size());
  for (const CampaignRecord& campaign : campaigns)
    names.push_back(campaign.name);
  return fmt::format("Report of {}", fmt::join(names, ", "));
}

/// "3", or "2 to 3".
std::string range_of(const std::vector<std::int64_t>& numbers) {
  const auto [least, most] = std::ranges::minmax(numbers);
  return least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
}

std::string plural(std::size_t number, std::string_view word) {
  return fmt::format("{}{}", word, number == 1 ? "" : "s");
}

/// The question in one sentence, and the progress of the designs.
std::string summary_of(const std::vector<DesignRecord>& designs) {
  if (designs.empty()) return "The store has no designs.";
  std::set<std::string, NameOrder> missions;
  std::set<std::string, NameOrder> methods;
  std::map<std::pair<std::string, std::string>, std::int64_t> groups;
  std::vector<std::int64_t> budgets;
  std::set<std::string, NameOrder> baselines;
  std::ptrdiff_t finished = 0;
  for (const DesignRecord& design : designs) {
    missions.insert(as_words(design.mission));
    methods.insert(design.method);
    ++groups[{design.mission, design.method}];
    // Baselines have no race; programs may have a time as their budget.
    const bool has_race = design.budget > 0 || design.flavour.empty();
    if (design.budget > 0) budgets.push_back(design.budget);
    if (!has_race) baselines.insert(design.method);
    if (design.state == "finished") ++finished;
  }
  std::vector<std::int64_t> repetitions;
  repetitions.reserve(groups.size());
  for (const auto& group : groups)
    repetitions.push_back(group.second);
  const bool is_one = *std::ranges::max_element(repetitions) == 1;
  std::string text = fmt::format(
      "Question: which machines do best on the {} {}? {} {} each by the {} {}",
      plural(missions.size(), "mission"), fmt::join(missions, ", "), range_of(repetitions),
      plural(is_one ? 1 : 2, "design"), plural(methods.size(), "method"), fmt::join(methods, ", "));
  if (!budgets.empty())
    text += fmt::format(", {} {} a design", range_of(budgets),
                        plural(*std::ranges::max_element(budgets) == 1 ? 1 : 2, "experiment"));
  if (!baselines.empty()) {
    text += fmt::format("; without a race, to compare with: {}", fmt::join(baselines, ", "));
  }
  return text + fmt::format(". {} of {} finished. Higher scores are better.", finished,
                            counted(designs.size(), "design is", "designs are"));
}

/// Up to this number of designs, each gets a chapter by default.
constexpr std::size_t kMostChapters = 3;

void write_chapters(ReportDraft& draft, const std::vector<DesignRecord>& known) {
  const ReportOptions& options = draft.options();
  const bool few = known.size() <= kMostChapters && !options.page_of_design;
  const bool all = options.all_designs || (options.designs.empty() && few);
  for (const DesignRecord& design : known) {
    if (all || std::ranges::find(options.designs, design.design) != options.designs.end())
      write_design(draft, design);
  }
}

}  // namespace

Expected<std::string> html_report(StoreReader& store, const ReportOptions& options) {
  const auto known = designs(store, {});
  if (!known) return Unexpected(known.error());
  const auto asked = campaigns(store);
  if (!asked) return Unexpected(asked.error());
  for (const DesignId design : options.designs) {
    if (std::ranges::find(*known, design, &DesignRecord::design) == known->end())
      return unexpected(ErrorKind::NotFound, "the store has no design " + to_string(design));
  }
  ReportDraft draft(store, options);
  const auto scores = draft.take(design_scores(store, {}));
  write_findings(draft, scores);
  write_scores(draft, scores);
  write_comparison(draft, scores);
  write_modules(draft);
  write_machines(draft, *known);
  write_races(draft, *known);
  write_chapters(draft, *known);
  write_question(draft);
  write_settings(draft);
  write_provenance(draft);
  if (draft.trouble()) return Unexpected(*draft.trouble());
  return draft.page().finish(title_of(*asked), summary_of(*known));
}

Expected<std::string> design_page(StoreReader& store, const DesignRecord& design,
                                  const ReportOptions& options) {
  ReportDraft draft(store, options);
  write_design(draft, design);
  if (draft.trouble()) return Unexpected(*draft.trouble());
  return draft.page().finish(fmt::format("Design {}", to_string(design.design)),
                             fmt::format("{}, {}, repetition {}", as_words(design.mission),
                                         design.method, design.repetition));
}

}  // namespace swarmsmith
