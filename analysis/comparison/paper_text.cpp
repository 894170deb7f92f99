#include "analysis/comparison/paper_text.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/records/names.h"
#include "analysis/statistics/effect_size.h"
#include "analysis/statistics/wilcoxon.h"

namespace swarmsmith {
namespace {

std::string latex_escaped(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    if (letter == '\\') {
      escaped += "\\textbackslash{}";
    } else if (letter == '~' || letter == '^') {
      escaped += fmt::format("\\{}{{}}", letter);
    } else {
      if (std::string_view("#$%&_{}").find(letter) != std::string_view::npos) escaped += '\\';
      escaped += letter;
    }
  }
  return escaped;
}

/// Four significant digits, as in papers; no exponent for numbers that people would write without
/// one.
std::string as_printed(double value) {
  constexpr double kNoDecimalsFrom = 1000;
  constexpr double kExponentFrom = 1e7;
  const double size = std::abs(value);
  return size < kNoDecimalsFrom || size >= kExponentFrom ? fmt::format("{:.4g}", value)
                                                         : fmt::format("{:.0f}", value);
}

/// Writes the plain text and the LaTeX text at the same time.
class Writer {
 public:
  Writer& words(std::string_view words) {
    sentence_.text += words;
    sentence_.latex += latex_escaped(words);
    return *this;
  }
  /// A number alone; in LaTeX between dollar signs, so that a minus sign is printed correctly.
  Writer& number(double value) {
    sentence_.text += as_printed(value);
    sentence_.latex += "$" + as_printed(value) + "$";
    return *this;
  }
  /// "n = 10", or "$n = 10$"; `symbol` is used in LaTeX if it differs from the name.
  Writer& value(std::string_view name, std::string_view value, std::string_view symbol = "") {
    const bool is_less = value.starts_with('<');
    const std::string rest = fmt::format("{}{}", is_less ? " " : " = ", value);
    sentence_.text += std::string(name) + rest;
    sentence_.latex += fmt::format("${}{}$", symbol.empty() ? name : symbol, rest);
    return *this;
  }
  Writer& interval(double low, double high) {
    sentence_.text += fmt::format("95 % interval [{}, {}]", as_printed(low), as_printed(high));
    sentence_.latex +=
        fmt::format("95\\,\\% interval $[{}, {}]$", as_printed(low), as_printed(high));
    return *this;
  }
  PaperSentence sentence() const { return sentence_; }

 private:
  PaperSentence sentence_;
};

/// Two significant digits; more if a p below the level would be printed as the level itself.
std::string printed_p(double p) {
  constexpr double kLeastShown = 0.0001;
  if (p < kLeastShown) return "< 0.0001";
  const std::string level = fmt::format("{:.2g}", kTestLevel);
  std::string printed = fmt::format("{:.2g}", p);
  for (int digits = 3; p < kTestLevel && printed == level; ++digits)
    printed = fmt::format("{:.{}g}", p, digits);
  return printed;
}

std::string_view units_of(ScoreUnit unit) {
  return unit == ScoreUnit::Design ? "designs" : "runs";
}

const ComparedGroup* group_of(const Comparison& comparison, const std::string& mission,
                              const std::string& method, const std::string& source) {
  const auto found = std::ranges::find_if(comparison.groups, [&](const ComparedGroup& group) {
    return group.mission == mission && group.method == method && group.source == source;
  });
  return found == comparison.groups.end() ? nullptr : &*found;
}

/// The environment in which the scores of a source were made, with a blank before it.
std::string place_of(const std::string& source) {
  if (source == "real") return " on the robots";
  if (source == "command") return "";  // the user's own program
  return " in simulation with the profile " + source;
}

/// Whether the test found the first to be larger. Its ranks decide, as they give the p; the
/// difference of the means may have the other sign.
bool is_first_higher(const ComparedPair& pair) {
  if (!pair.paired) return pair.a12 > 0.5;  // W / (m n)
  // V is the sum of the positive ranks; without a difference it is half of the sum of all.
  const auto n = static_cast<double>(pair.n_first - pair.test.zeros);
  return pair.test.statistic > n * (n + 1) / 4;
}

/// The result of the test: a difference, or that none was found.
std::string finding_of(const ComparedPair& pair, std::string_view units) {
  const auto p = pair.p_holm ? pair.p_holm : pair.test.p_value;
  const bool differ = p && *p < kTestLevel;
  const char* more = is_first_higher(pair) ? "higher" : "lower";
  if (pair.paired) {
    const std::string first = place_of(pair.first);
    const std::string second = place_of(pair.second);
    if (differ)
      return fmt::format("{} by {} scored {}{} than{}", units, pair.method, more, first, second);
    return fmt::format("no difference was found between {} by {}{} and the same {}{}", units,
                       pair.method, first, units, second);
  }
  const std::string place = place_of(pair.source);
  if (differ) return fmt::format("{} scored {} than {}{}", pair.first, more, pair.second, place);
  return fmt::format("no difference was found between {} and {}{}", pair.first, pair.second, place);
}

PaperSentence sentence_of(const Comparison& comparison, const ComparedPair& pair) {
  const std::string_view units = units_of(comparison.unit);
  Writer writer;
  writer.words(fmt::format("On {}, ", as_words(pair.mission)));
  writer.words(finding_of(pair, units) + " (").value("n", fmt::format("{}", pair.n_first));
  if (pair.paired) {
    writer.words(fmt::format(" {}", units));
  } else {
    writer.words(fmt::format(" and {} {}", pair.n_second, units));
  }
  const ComparedGroup* first =
      group_of(comparison, pair.mission, pair.paired ? pair.method : pair.first,
               pair.paired ? pair.first : pair.source);
  const ComparedGroup* second =
      group_of(comparison, pair.mission, pair.paired ? pair.method : pair.second,
               pair.paired ? pair.second : pair.source);
  if (first != nullptr && second != nullptr) {
    writer.words("; mean scores ").number(first->summary.mean).words(" and ");
    writer.number(second->summary.mean);
  }
  writer.words(
      fmt::format("; Wilcoxon {} test, two-sided, ", pair.paired ? "signed-rank" : "rank-sum"));
  writer.value(pair.paired ? "V" : "W", as_printed(pair.test.statistic)).words(", ");
  if (pair.test.p_value) {
    writer.value("p", printed_p(*pair.test.p_value));
    if (const std::size_t tests = corrected_tests(comparison.pairs); pair.p_holm && tests > 1) {
      writer.words(fmt::format(", by Holm over {} comparisons ", tests));
      writer.value("p", printed_p(*pair.p_holm));
    }
  } else {
    writer.words("no p");
  }
  writer.words("; ").value("A12", fmt::format("{:.2f}", pair.a12), "\\hat{A}_{12}");
  writer.words(fmt::format(" ({}), difference of the means ", magnitude_of(pair.a12)));
  writer.number(pair.difference.value).words(", ");
  writer.interval(pair.difference.low, pair.difference.high).words(").");
  if (comparison.unit == ScoreUnit::Run && !pair.paired) {
    const auto one_design = [](const ComparedGroup* group) {
      return group != nullptr && group->designs == 1;
    };
    if (one_design(first) && one_design(second)) {
      writer.words(
          " Each group is one machine: the test tells machines apart, and says nothing about the "
          "methods.");
    }
  }
  if (!pair.notes.empty()) writer.words(fmt::format(" Note: {}.", fmt::join(pair.notes, "; ")));
  return writer.sentence();
}

PaperSentence sentence_of(const Comparison& comparison, const ComparedGroup& group) {
  const Summary& summary = group.summary;
  Writer writer;
  writer.words(fmt::format("On {}, {} scored ", as_words(group.mission), group.method));
  writer.number(summary.mean).words(" on average" + place_of(group.source) + " (");
  if (summary.n > 1) writer.words("standard deviation ").number(summary.sd).words(", ");
  writer.words("median ").number(summary.median).words(", from ").number(summary.least);
  writer.words(" to ").number(summary.most).words("; ");
  const std::string_view units = units_of(comparison.unit);
  writer.value("n", fmt::format("{}", summary.n));
  writer.words(fmt::format(" {}", summary.n == 1 ? units.substr(0, units.size() - 1) : units));
  if (comparison.unit == ScoreUnit::Design)
    writer.words(fmt::format(", each the mean of its runs, {} in all", group.runs));
  return writer.words(").").sentence();
}

}  // namespace

std::vector<PaperSentence> paper_sentences(const Comparison& comparison) {
  std::vector<PaperSentence> sentences;
  for (const ComparedPair& pair : comparison.pairs)
    sentences.push_back(sentence_of(comparison, pair));
  if (!sentences.empty()) return sentences;
  for (const ComparedGroup& group : comparison.groups)
    sentences.push_back(sentence_of(comparison, group));
  return sentences;
}

}  // namespace swarmsmith
