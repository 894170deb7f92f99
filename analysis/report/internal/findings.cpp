#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/comparison/paper_text.h"
#include "analysis/records/names.h"
#include "analysis/report/internal/sections.h"
#include "base/plain_text.h"

namespace swarmsmith {
namespace {

/// Limits of the first page; the rest is on the following pages.
constexpr std::size_t kMostSentences = 6;
constexpr std::size_t kMostMissions = 3;

/// About methods and about sources; if there are no pairs, about each group.
std::vector<PaperSentence> sentences_of(const std::vector<DesignScore>& scores) {
  std::vector<PaperSentence> sentences;
  for (const CompareBy by : {CompareBy::Method, CompareBy::Source}) {
    const Comparison comparison = compare(scores, {.by = by});
    if (comparison.pairs.empty()) continue;
    const auto more = paper_sentences(comparison);
    sentences.insert(sentences.end(), more.begin(), more.end());
  }
  return sentences.empty() ? paper_sentences(compare(scores, {.by = CompareBy::Mission}))
                           : sentences;
}

void write_sentences(HtmlPage& page, const std::vector<DesignScore>& scores) {
  const auto sentences = sentences_of(scores);
  std::vector<std::string> latex;
  for (const PaperSentence& sentence : sentences) {
    if (latex.size() < kMostSentences) page.paragraph(sentence.text);
    latex.push_back(sentence.latex);
  }
  if (sentences.size() > kMostSentences) {
    page.paragraph(
        counted(sentences.size() - kMostSentences, "more comparison is", "more comparisons are") +
        " below, and all of them in LaTeX here:");
  }
  page.begin_folded("The same for LaTeX", false);
  page.verbatim("", fmt::format("{}", fmt::join(latex, "\n")));
  page.end_folded();
}

/// The winner with the highest mean in a mission.
struct Best {
  DesignId design;
  std::string mission;
  CandidateId candidate;
};

std::vector<Best> best_of_each_mission(ReportDraft& draft) {
  std::vector<Best> best;
  draft.take(draft.store().query(
      "SELECT min(design), mission, candidate FROM v_leaderboard WHERE rank = 1 GROUP BY mission "
      "ORDER BY mission",
      {}, [](const std::vector<std::string>&) {},
      [&](const std::vector<StoreReader::Cell>& cells) {
        best.push_back({.design = {cells[0].integer()},
                        .mission = cells[1].text,
                        .candidate = {cells[2].integer()}});
      }));
  return best;
}

void write_best_machines(ReportDraft& draft) {
  auto best = best_of_each_mission(draft);
  if (best.size() > kMostMissions) best.resize(kMostMissions);
  HtmlPage& page = draft.page();
  const auto what = [](const Best& winner) {
    return fmt::format("the winner on {}, {} of {}", as_words(winner.mission),
                       to_string(winner.candidate), to_string(winner.design));
  };
  page.begin_grid();
  for (const Best& winner : best) {
    draft.figure("machine", {.width_mm = kColumnWidth, .candidate = winner.candidate},
                 fmt::format("Drawn: {}.", what(winner)));
  }
  page.end_grid();
  if (!draft.options().runs_from_above) return;
  page.begin_grid();
  for (const Best& winner : best) {
    const auto picture = draft.options().runs_from_above(winner.design);
    if (picture) page.picture(*picture, fmt::format("Runs from above: {}.", what(winner)));
  }
  page.end_grid();
}

}  // namespace

void write_findings(ReportDraft& draft, const std::vector<DesignScore>& scores) {
  HtmlPage& page = draft.page();
  page.heading(2, "Result");
  if (scores.empty()) {
    page.paragraph("No winner was evaluated outside of its race yet.");
  } else {
    draft.figure("box", {.width_mm = kWholeWidth},
                 "Scores of the winners; " + chosen(scores, {}).said + ". Higher is better.");
    write_sentences(page, scores);
  }
  write_best_machines(draft);
}

}  // namespace swarmsmith
