#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "irace_core/internal/model.h"
#include "irace_core/internal/ranking.h"
#include "irace_core/internal/rounding.h"
#include "irace_core/internal/sampling.h"
#include "irace_core/internal/similarity.h"
#include "irace_core/internal/sobol.h"
#include "tests/irace_core/golden.h"
#include "tests/irace_core/spaces.h"

namespace swarmsmith::irace {
namespace {

using namespace swarmsmith::testing;

std::vector<std::string> split_values(std::string inside) {
  std::vector<std::string> values;
  std::istringstream fields(inside);
  for (std::string value; std::getline(fields, value, ',');)
    values.push_back(value);
  return values;
}

/// The space of a golden definition such as `x "" i,log (1,1000)`, one parameter a line, whose last
/// one may have a bound that names another parameter.
ParameterSpace parse_space(const std::string& definition) {
  std::vector<Parameter> parameters;
  std::istringstream lines(definition);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string id, switch_text, type, domain;
    fields >> id >> switch_text >> type >> domain;
    const auto values = split_values(domain.substr(1, domain.size() - 2));
    const auto bound = [](const std::string& word) -> Bound {
      if (word.find_first_not_of("0123456789.-") == std::string::npos) return std::stod(word);
      return name(word);
    };
    const bool log = type.size() > 1;
    Parameter parameter{id, "", Categorical{values}, {}};
    if (type[0] == 'o') parameter.domain = Ordinal{values};
    if (type[0] == 'i') parameter.domain = Integer{bound(values[0]), bound(values[1]), log};
    if (type[0] == 'r') parameter.domain = Real{bound(values[0]), bound(values[1]), log};
    parameters.push_back(std::move(parameter));
  }
  return space_of(std::move(parameters));
}

UpdateStrength strength_of(const nlohmann::json& json) {
  return update_strength(json["iteration"], json["n_iterations"], json["n_new_configurations"],
                         json["n_variable"], json["elitist"]);
}

TEST(ModelGolden, UpdatesProbabilitiesAndSpreads) {
  int compared = 0;
  int spreads = 0;
  for (const auto& json : golden("model.json", "update")) {
    auto p = as_vector<double>(json["prob_before"]);
    const UpdateStrength strength = strength_of(json);
    update_probabilities(p, json["chosen_index"].get<std::size_t>() - 1, strength);
    const auto expected = as_vector<double>(json["prob_after"]);
    for (std::size_t i = 0; i < p.size(); ++i)
      EXPECT_NEAR(p[i], expected[i], 1e-13);
    if (!json["sd_after"].is_null()) {  // there only for some
      EXPECT_NEAR(json["sd_before"].get<double>() * strength.shrink, json["sd_after"], 1e-13);
      ++spreads;
    }
    ++compared;
  }
  EXPECT_EQ(compared, 40);
  EXPECT_GT(spreads, 20);
}

TEST(ModelGolden, SobolPointsAreThoseOfIrace) {
  for (const std::uint32_t seed : {0U, 12345U}) {
    const auto expected = golden("model.json", "sobol_seed" + std::to_string(seed) + "_8x5");
    const SobolSequence sequence(5, seed);
    std::vector<double> point(5);
    for (std::uint32_t i = 0; i < 8; ++i) {
      sequence.point(i, point);
      for (std::size_t d = 0; d < 5; ++d)
        EXPECT_NEAR(point[d], expected[i][d].get<double>(), 1e-14) << "seed " << seed;
    }
  }
}

TEST(ModelGolden, StartsWithTheSpreadsOfIrace) {
  for (const auto& json : golden("model.json", "initial_sd")) {
    const std::string definition = json["definition"];
    const ParameterSpace space = parse_space(definition);
    EXPECT_EQ(initial_sd(space, *space.index_of("x")), json["sd"]) << definition;
  }
}

TEST(ModelGolden, SoftRestartsWiden) {
  for (const auto& json : golden("model.json", "soft_restart")) {
    auto p = as_vector<double>(json["prob_before"]);
    restart_probabilities(p);
    const auto expected = as_vector<double>(json["prob_after"]);
    for (std::size_t i = 0; i < p.size(); ++i)
      EXPECT_NEAR(p[i], expected[i], 1e-13);
    EXPECT_NEAR(restart_sd(json["sd_before"], json["initial_sd"], json["n_new_configurations"],
                           json["n_variable"]),
                json["sd_after"], 1e-12);
  }
}

/// Draws from a model of parameter x with the given mean and spread, as the engine makes them.
class ModelSampler {
 public:
  ModelSampler(const ParameterSpace& space, double mean, double sd)
      : models_(space), parameter_(*space.index_of("x")), elite_(space.size()) {
    elite_.set(parameter_, mean);
    const EliteLine line{1, 0, &elite_};
    models_.initialise(std::span(&line, 1));
    const double shrink = sd / initial_sd(space, parameter_);
    models_.update(std::span(&line, 1), {.fraction = 0, .shrink = shrink, .most = 1});
  }
  double operator()(Rng& rng) const { return (*models_.sample(1, rng))[parameter_]; }

 private:
  SamplingModels models_;
  std::size_t parameter_;
  Configuration elite_;
};

/// Both our draws and irace's are samples: frequencies may differ by the error of two.
void expect_frequencies(const std::vector<double>& drawn, const nlohmann::json& values,
                        const nlohmann::json& frequencies, double their_size) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double ours = static_cast<double>(std::count(drawn.begin(), drawn.end(), values[i])) /
                        static_cast<double>(drawn.size());
    const double theirs = frequencies[i];
    const double p = std::max({theirs, ours, 1e-5});
    const double error =
        std::sqrt(p * (1 - p) * (1 / static_cast<double>(drawn.size()) + 1 / their_size));
    EXPECT_NEAR(ours, theirs, 4 * error) << values[i];
  }
}

std::vector<double> draw_many(const ModelSampler& sampler) {
  Rng rng(20);
  std::vector<double> drawn;
  for (int i = 0; i < 400'000; ++i)
    drawn.push_back(sampler(rng));
  return drawn;
}

TEST(ModelGolden, SamplesNumbersWithTheDistributionOfIrace) {
  for (const auto& json : golden("model.json", "sample_model_numeric")) {
    SCOPED_TRACE(json["definition"].dump() + " mean " + json["mean"].dump());
    const ParameterSpace space = parse_space(json["definition"]);
    std::vector<double> drawn = draw_many(ModelSampler(space, json["mean"], json["sd"]));
    const auto n = static_cast<double>(drawn.size());
    const double mean = std::accumulate(drawn.begin(), drawn.end(), 0.0) / n;
    const double error = json["sample_sd"].get<double>() * std::sqrt(2 / n);
    EXPECT_NEAR(mean, json["sample_mean"], 4 * error);
    std::sort(drawn.begin(), drawn.end());
    for (std::size_t i = 1; i + 1 < json["quantiles"].size(); ++i) {
      // The share of our draws up to irace's quantile brackets the probability.
      const double p = json["quantile_probs"][i];
      const double quantile = json["quantiles"][i];
      const double slack = 4 * std::sqrt(2 * p * (1 - p) / n);
      const auto below = std::lower_bound(drawn.begin(), drawn.end(), quantile - 2e-4);
      const auto upto = std::upper_bound(drawn.begin(), drawn.end(), quantile + 2e-4);
      EXPECT_LE(static_cast<double>(below - drawn.begin()) / n, p + slack);
      EXPECT_GE(static_cast<double>(upto - drawn.begin()) / n, p - slack);
    }
    if (json.contains("freq")) expect_frequencies(drawn, json["freq_values"], json["freq"], n);
  }
}

TEST(ModelGolden, SamplesOrdinalsByTheCorrectRule) {
  for (const auto& json : golden("model.json", "sample_model_ordinal")) {
    SCOPED_TRACE(json["n_values"].dump() + " values, sd " + json["sd"].dump());
    std::vector<std::string> values;
    nlohmann::json indices;
    for (int i = 0; i < json["n_values"]; ++i) {
      values.push_back(std::to_string(i));
      indices.push_back(static_cast<double>(i));
    }
    const ParameterSpace space = space_of({make_ordinal("x", values)});
    const ModelSampler sampler(space, json["mean_index"].get<double>() - 1, json["sd"]);
    expect_frequencies(draw_many(sampler), indices, json["freq_correct_3_5"], 400'000);
  }
}

TEST(ModelGolden, QuantilesAreThoseOfIrace) {
  for (const auto& json : golden("model.json", "quantile")) {
    const ParameterSpace space = parse_space(json["definition"]);
    const bool choice = !space.is_numeric(0);
    const Interval domain = choice ? Interval{0, 0} : *space.constant_interval(0);
    for (std::size_t i = 0; i < json["probs"].size(); ++i) {
      SCOPED_TRACE(json["definition"].dump() + " at " + json["probs"][i].dump());
      const double ours = quantile_value(space, 0, domain, json["probs"][i]);
      if (choice) {
        EXPECT_EQ(space.scalar(0, ours).text, json["values"][i].get<std::string>());
      } else {
        EXPECT_EQ(ours, json["values"][i]);
      }
    }
  }
}

TEST(ModelGolden, UniformSamplesAreUniform) {
  for (const auto& json : golden("model.json", "uniform")) {
    SCOPED_TRACE(json["definition"].dump());
    const ParameterSpace space = parse_space(json["definition"]);
    Rng rng(21);
    std::vector<double> drawn;
    for (int i = 0; i < 400'000; ++i)
      drawn.push_back((*sample_uniform(space, rng))[0]);
    nlohmann::json values;
    for (std::size_t i = 0; i < json["values"].size(); ++i) {
      const std::string value = json["values"][i];
      values.push_back(space.is_numeric(0) ? std::stod(value) : static_cast<double>(i));
    }
    expect_frequencies(drawn, values, json["freq"], 400'000);
  }
}

TEST(ModelGolden, ParentsHaveTheWeightsOfIrace) {
  for (const auto& json : golden("model.json", "elite_weights")) {
    const auto weights = as_vector<double>(json);
    Rng rng(22);
    std::vector<double> drawn;
    for (int i = 0; i < 100'000; ++i) {
      drawn.push_back(static_cast<double>(draw_parent(weights.size(), rng)));
    }
    nlohmann::json ranks;
    for (std::size_t i = 0; i < weights.size(); ++i)
      ranks.push_back(static_cast<double>(i));
    expect_frequencies(drawn, ranks, weights, 1e12);
  }
}

TEST(ModelGolden, OverallRanksAreThoseOfIrace) {
  for (const auto& json : golden("model.json", "overall_ranks")) {
    const auto rows = as_matrix(json["costs"], kNotEvaluated);
    std::vector<std::vector<double>> by_configuration(rows.front().size());
    for (const auto& row : rows) {
      for (std::size_t c = 0; c < row.size(); ++c)
        by_configuration[c].push_back(row[c]);
    }
    EXPECT_EQ(overall_ranks(by_configuration, TestType::FTest),
              as_vector<double>(json["friedman"]));
    EXPECT_EQ(overall_ranks(by_configuration, TestType::TTest), as_vector<double>(json["t"]));
  }
}

TEST(ModelGolden, FindsTheSimilarConfigurationsThatIraceFinds) {
  const ParameterSpace space =
      space_of({make_categorical("c1", {"a", "b"}), make_real("x", 0, 10),
                make_integer("y", 1, 1000), active_when(make_real("z", 0, 1), equals("c1", "a"))});
  for (const auto& json : golden("model.json", "similar")) {
    std::vector<Configuration> configurations;
    for (const auto& row : json["configurations"]) {
      Configuration& configuration = configurations.emplace_back(space.size());
      configuration.set(0, row["c1"] == "a" ? 0 : 1);
      configuration.set(1, row["x"]);
      configuration.set(2, row["y"]);
      if (!row["z"].is_null()) configuration.set(3, row["z"]);
    }
    std::vector<const Configuration*> pointers;
    for (const Configuration& configuration : configurations)
      pointers.push_back(&configuration);
    std::vector<int> ids;
    for (const auto i : similar_configurations(space, pointers, json["threshold"])) {
      ids.push_back(json["configurations"][i][".ID."]);
    }
    const auto& expected = json["similar_ids"];
    EXPECT_EQ(ids, expected.is_null() ? std::vector<int>{} : as_vector<int>(expected))
        << json["threshold"];
  }
}

TEST(ModelGolden, RoundsAsRDoes) {
  for (const auto& json : golden("model.json", "round4")) {
    const double value = json["value"];
    EXPECT_EQ(round_to_digits(value, 4), json["d4"]) << value;
    EXPECT_EQ(round_to_digits(value, 2), json["d2"]) << value;
    EXPECT_EQ(round_to_digits(value, 1), json["d1"]) << value;
    EXPECT_EQ(round_to_digits(value, 0), json["d0"]) << value;
  }
}

TEST(ModelGolden, WritesNumbersAsIraceDoes) {
  for (const auto& json : golden("model.json", "number_format")) {
    const double value = std::strtod(json["hex"].get<std::string>().c_str(), nullptr);
    if (value < 1e-307) continue;  // R gives up on fixed notation for subnormal numbers
    EXPECT_EQ(to_fixed_text(value), json["text"].get<std::string>());
  }
}

}  // namespace
}  // namespace swarmsmith::irace
