#include "irace_core/search/cma_es.h"

#include <gmock/gmock.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/irace_core/search/played.h"

namespace swarmsmith {
namespace {

TEST(Eigenvalues, TakeASymmetricMatrixApart) {
  Rng rng(1);
  constexpr std::size_t n = 12;
  std::vector<double> matrix(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j)
      matrix[i * n + j] = matrix[j * n + i] = rng.normal();
  }
  std::vector<double> vectors;
  const std::vector<double> values = search::eigenvalues(matrix, n, vectors);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      double rebuilt = 0;
      double product = 0;
      for (std::size_t k = 0; k < n; ++k) {
        rebuilt += vectors[i * n + k] * values[k] * vectors[j * n + k];
        product += vectors[k * n + i] * vectors[k * n + j];
      }
      EXPECT_NEAR(rebuilt, matrix[i * n + j], 1e-12);
      EXPECT_NEAR(product, i == j ? 1 : 0, 1e-13);
    }
  }
}

/// The third axis is apart from the others, and its value is that of the diagonal.
TEST(Eigenvalues, TakeAnAxisThatIsApartAsItIs) {
  std::vector<double> axes;
  std::vector<double> values = search::eigenvalues({2, 1, 0, 1, 2, 0, 0, 0, 2}, 3, axes);
  EXPECT_EQ(values[2], 2);
  std::ranges::sort(values);
  EXPECT_NEAR(values[0], 1, 1e-15);
  EXPECT_NEAR(values[2], 3, 1e-15);
}

using Function = double (*)(const std::vector<double>&);

/// Evaluations until a function of ten variables is below 1e-9, from 1 in each with a step of 0.5
/// and the default population of 10.
std::int64_t evaluations_of(Function function, std::uint64_t seed) {
  constexpr std::int64_t kPopulation = 10;
  search::CmaEs cma(std::vector<double>(10, 0.1), 0.1, kPopulation);
  Rng rng(seed);
  for (std::int64_t count = 0; count < 200'000;) {
    std::vector<std::vector<double>> points;
    for (std::int64_t k = 0; k < kPopulation; ++k) {
      std::vector<double> normals(10);
      for (double& normal : normals)
        normal = rng.normal();
      points.push_back(cma.point_of(normals));
    }
    std::ranges::stable_sort(points, {}, function);
    count += kPopulation;
    if (function(points.front()) < 1e-9) return count;
    cma.update(points);
  }
  return 1'000'000;
}

double median_evaluations(Function function) {
  std::vector<std::int64_t> counts;
  for (std::uint64_t seed = 1; seed <= 11; ++seed)
    counts.push_back(evaluations_of(function, seed));
  std::ranges::sort(counts);
  return static_cast<double>(counts[5]);
}

double sphere(const std::vector<double>& x) {
  double sum = 0;
  for (const double value : x)
    sum += value * value;
  return sum;
}

double ellipsoid(const std::vector<double>& x) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += std::pow(1e6, static_cast<double>(i) / 9) * x[i] * x[i];
  return sum;
}

double rosenbrock(const std::vector<double>& x) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    sum += 100 * std::pow(x[i] * x[i] - x[i + 1], 2) + std::pow(x[i] - 1, 2);
  return sum;
}

/// Medians of seven runs of CMA-ES/pycma, cma/purecma.py @ 0028b330, on the same functions from the
/// same start: worked out once from its formulas, in Python.
TEST(CmaEs, NeedsAsManyEvaluationsAsTheReference) {
  EXPECT_NEAR(median_evaluations(sphere), 1310, 0.2 * 1310);
  EXPECT_NEAR(median_evaluations(ellipsoid), 5500, 0.2 * 5500);
  EXPECT_NEAR(median_evaluations(rosenbrock), 6040, 0.2 * 6040);
}

/// Factors that are powers of two change no digit, however small they are.
TEST(Eigenvalues, ScaleWithTheMatrix) {
  const std::vector<double> matrix = {2, 1, 0.5, 1, 3, -1, 0.5, -1, 1};
  std::vector<double> axes;
  const std::vector<double> values = search::eigenvalues(matrix, 3, axes);
  for (const double factor : {0x1p-80, 0x1p-3, 0x1p80}) {
    std::vector<double> scaled;
    for (const double element : matrix)
      scaled.push_back(factor * element);
    std::vector<double> same_axes;
    const std::vector<double> scaled_values = search::eigenvalues(scaled, 3, same_axes);
    EXPECT_EQ(same_axes, axes) << factor;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(scaled_values[i], factor * values[i]);
  }
}

/// In the first and the third of three generations the path of the step size is long, and the path
/// of the covariance stands still; in the first one only in relation to the length that it can have
/// after one step. Worked out in Python from the equations of the tutorial, with another square
/// root of the matrix.
TEST(CmaEs, StopsThePathOfTheCovarianceWhileTheStepGrows) {
  struct Generation {
    std::vector<std::vector<double>> points;
    std::vector<double> mean;
    double step;
    std::vector<double> covariance;
  };
  const std::vector<Generation> generations = {
      {{{2, 1}, {1.5, 0.5}, {1, 2}},
       {1.7793276999602332, 0.9361020426017339},
       1.3204791421700712,
       {1.1093346498938628, 0.09513695172627729, 0.09513695172627729, 0.9794348294961231}},
      {{{2.5, 1}, {2, 1.5}, {1.5, 1.25}},
       {2.279327699960233, 1.161881921549204},
       1.5018447590099815,
       {0.9237305238861272, 0.09429115648156453, 0.09429115648156453, 0.782366644774087}},
      {{{6, 3}, {5, 3.5}, {4.5, 4}},
       {5.597848985580842, 3.220672300039767},
       3.035094280436073,
       {1.145749020002621, 0.2601085253772053, 0.2601085253772053, 0.8324537680161281}},
  };
  search::CmaEs cma({0, 0}, 1, 6);
  std::int64_t number = 0;
  for (const Generation& expected : generations) {
    cma.update(expected.points);
    EXPECT_EQ(cma.generation(), ++number);
    EXPECT_NEAR(cma.step(), expected.step, 1e-12);
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(cma.mean()[i], expected.mean[i], 1e-12);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(cma.covariance()[i], expected.covariance[i], 1e-12) << number;
  }
}

TEST(CmaEs, KeepsItsStepBelowALimit) {
  search::CmaEs cma({0}, 1e9, 4);
  for (int i = 0; i < 20; ++i)
    cma.update(std::vector<std::vector<double>>{{cma.mean()[0] + 3 * cma.step()},
                                                {cma.mean()[0] + 2 * cma.step()}});
  EXPECT_EQ(cma.step(), 1e10);
}

/// The same numbers in place of normal ones; mean and covariance after a generation.
TEST(CmaEs, LearnsFromAGenerationWhatTheReferenceLearns) {
  search::CmaEs cma({0.5, -0.25, 1.0, 0.75}, 0.3, 6);
  std::vector<std::vector<double>> points;
  for (int k = 0; k < 6; ++k) {
    std::vector<double> normals;
    for (int i = 0; i < 4; ++i)
      normals.push_back(1.5 * std::sin(1.0 + 7 * k + 3 * i));
    points.push_back(cma.point_of(normals));
  }
  std::ranges::sort(points, {}, [](const std::vector<double>& x) {
    return x[0] * x[0] + 2 * x[1] * x[1] + 3 * x[2] * x[2] + 4 * x[3] * x[3];
  });
  cma.update(points);
  constexpr std::array kMean = {0.2736389325999194, -0.07487435799955625, 0.8796149243145305,
                                0.8132350012621395};
  constexpr std::array kCovariance = {
      0.9857610163551146,   -0.06349187523507549,  0.04611797392528747,   -0.02782102105382373,
      -0.06349187523507549, 0.9573505870165008,    -0.037852779294190016, 0.023763378061710215,
      0.046117973925287464, -0.037852779294190016, 0.9349959911529235,    -0.019230110896121755,
      -0.02782102105382373, 0.023763378061710215,  -0.019230110896121755, 0.9204779830549692};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(cma.mean()[i], kMean[i], 1e-12);
  for (std::size_t i = 0; i < 16; ++i)
    EXPECT_NEAR(cma.covariance()[i], kCovariance[i], 1e-12);
}

TEST(CmaEs, EndsWithTheLastPopulationAndItsMean) {
  auto search = started(weights_space(6), options_of(SearchKind::CmaEs), 10'000);
  const Played played = play(*search, noisy_sphere);
  const auto starts = only<IterationStarted>(played.events);
  ASSERT_EQ(starts.size(), 9U);
  EXPECT_EQ(starts.back().n_configurations, 100);
  // The mean is new, the others are known.
  EXPECT_EQ(only<ConfigurationSampled>(played.events).size(), 801U);
  EXPECT_EQ(search->experiments_used(), 10'000);
}

}  // namespace
}  // namespace swarmsmith
