#include "sim/mission/score.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace swarmsmith {
namespace {

using Scorers = ScorersOf<ScoreRule>::Type;

constexpr auto kKindNumbers = std::make_index_sequence<std::variant_size_v<ScoreRule>>();

template <std::size_t... I>
std::vector<std::string> kinds(std::index_sequence<I...> /*numbers*/) {
  return {std::string(std::variant_alternative_t<I, ScoreRule>::kKind)...};
}

template <std::size_t... I>
std::optional<ScoreRule> of_kind(std::string_view kind, std::index_sequence<I...> /*numbers*/) {
  std::optional<ScoreRule> found;
  ((std::variant_alternative_t<I, ScoreRule>::kKind == kind
        ? void(found.emplace(std::in_place_index<I>))
        : void()),
   ...);
  return found;
}

Error error_of(const ScoreFault& fault) {
  const std::string key(fault.key);
  return {ErrorKind::BadInput, "the score's `" + key + "` " + fault.what, key};
}

/// Finds the first fault.
class FaultFinder {
 public:
  std::optional<Error> fault;

  void operator()(const ScoreField& field, double value) {
    if (!field.allows(value)) complain(field, "is outside of its limits");
  }
  void operator()(const ScoreField& field, int value) {
    (*this)(field, static_cast<double>(value));
  }
  void operator()(const ScoreField& /*field*/, bool /*value*/) {}
  void operator()(const ScoreField& /*field*/, Rgb /*value*/) {}
  void operator()(const ScoreField& /*field*/, When /*value*/) {}
  void operator()(const ScoreField& field, const std::string& value) {
    if (field.choices.empty() || std::ranges::find(field.choices, value) != field.choices.end()) {
      return;
    }
    complain(field, "is not one of its choices");
  }
  void operator()(const ScoreField& field, const std::vector<Reward>& rewards) {
    if (rewards.empty()) complain(field, "must name a colour");
    for (std::size_t i = 0; i < rewards.size(); ++i) {
      (*this)(field, rewards[i].reward);
      for (std::size_t j = 0; j < i; ++j) {
        if (rewards[i].color == rewards[j].color) complain(field, "names a colour twice");
      }
    }
  }

 private:
  void complain(const ScoreField& field, const std::string& what) {
    if (!fault) fault = error_of({field.key, what});
  }
};

/// The scorer of the rule's kind.
Scorers scorer_of(const ScoreRule& rule, const Arena& arena) {
  if (const auto fault = fault_of(rule)) throw std::invalid_argument(fault->message);
  return std::visit(
      [&]<class Rule>(const Rule& kind) {
        return Scorers(std::in_place_type<typename Rule::Scorer>, kind, arena);
      },
      rule);
}

}  // namespace

std::vector<std::string> score_kinds() {
  return kinds(kKindNumbers);
}

std::optional<ScoreRule> score_of_kind(std::string_view kind) {
  return of_kind(kind, kKindNumbers);
}

std::string_view kind_of(const ScoreRule& rule) {
  return std::visit([](const auto& kind) { return kind.kKind; }, rule);
}

std::string unit_of(const ScoreRule& rule) {
  return std::visit([](const auto& kind) { return kind.unit(); }, rule);
}

std::optional<Error> fault_of(const ScoreRule& rule) {
  FaultFinder finder;
  visit_fields(rule, finder);
  if (finder.fault) return finder.fault;
  return std::visit(
      [](const auto& kind) -> std::optional<Error> {
        if constexpr (requires { kind.fault(); }) {
          if (const auto fault = kind.fault()) return error_of(*fault);
        }
        return std::nullopt;
      },
      rule);
}

Scorer::Scorer(const ScoreRule& rule, const Arena& arena) : scorer_(scorer_of(rule, arena)) {}

void Scorer::observe(std::span<const Point> robots, std::span<const Point> objects) {
  std::visit([&](auto& scorer) { scorer.observe(Positions{robots, objects}); }, scorer_);
}

double Scorer::score() const {
  return std::visit([](const auto& scorer) { return scorer.score(); }, scorer_);
}

}  // namespace swarmsmith
