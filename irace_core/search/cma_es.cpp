#include "irace_core/search/cma_es.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/assert.h"
#include "base/math.h"
#include "irace_core/search/generations.h"
#include "irace_core/search/real_box.h"

namespace swarmsmith::search {
namespace {

double square(double x) {
  return x * x;
}

/// The index of an element in a matrix that is stored row by row.
std::size_t at(std::size_t n, std::size_t row, std::size_t column) {
  return row * n + column;
}

/// One rotation that makes the element (p, q) zero (Jacobi's method; Golub and Van Loan, Matrix
/// Computations, section 8.5). Matrix and vectors are n x n, row by row.
void rotate(std::vector<double>& matrix, std::vector<double>& vectors, std::size_t n, std::size_t p,
            std::size_t q) {
  const double off = matrix[at(n, p, q)];
  if (off == 0) return;
  const double theta = (matrix[at(n, q, q)] - matrix[at(n, p, p)]) / (2 * off);
  // Of the two possible angles this is the smaller one: the other elements change least with it.
  const double sign = theta < 0 ? -1 : 1;
  const double t = sign / (std::abs(theta) + std::sqrt(square(theta) + 1));
  const double c = 1 / std::sqrt(square(t) + 1);
  const double s = t * c;
  for (std::size_t k = 0; k < n; ++k) {
    const double a = matrix[at(n, k, p)];
    const double b = matrix[at(n, k, q)];
    matrix[at(n, k, p)] = c * a - s * b;
    matrix[at(n, k, q)] = s * a + c * b;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double a = matrix[at(n, p, k)];
    const double b = matrix[at(n, q, k)];
    matrix[at(n, p, k)] = c * a - s * b;
    matrix[at(n, q, k)] = s * a + c * b;
    const double v = vectors[at(n, k, p)];
    const double w = vectors[at(n, k, q)];
    vectors[at(n, k, p)] = c * v - s * w;
    vectors[at(n, k, q)] = s * v + c * w;
  }
}

}  // namespace

std::vector<double> eigenvalues(std::vector<double> matrix, std::size_t n,
                                std::vector<double>& vectors) {
  constexpr int kMostSweeps = 50;
  constexpr double kSmall = 1e-30;  ///< for squares off the diagonal, relative to the diagonal
  SWARMSMITH_ASSERT(matrix.size() == n * n, "a square matrix");
  vectors.assign(n * n, 0);
  for (std::size_t i = 0; i < n; ++i)
    vectors[at(n, i, i)] = 1;
  // Sweeps over all pairs until all elements off the diagonal are zero; they shrink quadratically.
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double off = 0;
    double diagonal = 0;
    for (std::size_t i = 0; i < n; ++i) {
      diagonal += square(matrix[at(n, i, i)]);
      for (std::size_t j = i + 1; j < n; ++j)
        off += square(matrix[at(n, i, j)]);
    }
    if (off <= kSmall * diagonal) break;
    for (std::size_t p = 0; p + 1 < n; ++p) {
      for (std::size_t q = p + 1; q < n; ++q)
        rotate(matrix, vectors, n, p, q);
    }
  }
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i)
    values[i] = matrix[at(n, i, i)];
  return values;
}

CmaEs::CmaEs(std::vector<double> mean, double step, std::int64_t population)
    : mean_(std::move(mean)), step_(step) {
  const auto n = static_cast<double>(dimensions());
  const auto half = static_cast<std::size_t>(population / 2);
  SWARMSMITH_ASSERT(half > 0 && dimensions() > 0, "CMA-ES has two points and a dimension or more");
  SWARMSMITH_ASSERT(step > 0, "the first step size spreads the first generation");
  // Only the better half counts, and the best counts most: the weights use the logarithm of the
  // rank (table 1).
  double sum = 0;
  for (std::size_t i = 1; i <= half; ++i) {
    weights_.push_back(log((static_cast<double>(population) + 1) / 2) -
                       log(static_cast<double>(i)));
    sum += weights_.back();
  }
  double squares = 0;
  for (double& weight : weights_) {
    weight /= sum;
    squares += square(weight);
  }
  SWARMSMITH_ASSERT(weights_.back() > 0, "each of the better half has a positive weight");
  mu_eff_ = 1 / squares;
  // Table 1 of the tutorial.
  c_sigma_ = (mu_eff_ + 2) / (n + mu_eff_ + 5);
  d_sigma_ = 1 + 2 * std::max(0.0, std::sqrt((mu_eff_ - 1) / (n + 1)) - 1) + c_sigma_;
  c_c_ = (4 + mu_eff_ / n) / (n + 4 + 2 * mu_eff_ / n);
  c_1_ = 2 / (square(n + 1.3) + mu_eff_);
  c_mu_ = std::min(1 - c_1_, 2 * (mu_eff_ - 2 + 1 / mu_eff_) / (square(n + 2) + mu_eff_));
  chi_n_ = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * square(n)));

  covariance_.assign(dimensions() * dimensions(), 0);
  for (std::size_t i = 0; i < dimensions(); ++i)
    covariance_[at(dimensions(), i, i)] = 1;
  step_path_.assign(dimensions(), 0);
  covariance_path_.assign(dimensions(), 0);
  decompose();
}

void CmaEs::decompose() {
  // Rounding may make the smallest eigenvalue slightly negative.
  constexpr double kLeast = 1e-20;
  lengths_ = eigenvalues(covariance_, dimensions(), axes_);
  for (double& length : lengths_)
    length = std::sqrt(std::max(length, kLeast));
}

std::vector<double> CmaEs::point_of(std::span<const double> normals) const {
  const std::size_t n = dimensions();
  SWARMSMITH_ASSERT(normals.size() == n, "there is a normal number for each dimension");
  // mean + step B D z (equations 38 to 40).
  std::vector<double> point(mean_);
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j)
      sum += axes_[at(n, i, j)] * (lengths_[j] * normals[j]);
    point[i] += step_ * sum;
  }
  return point;
}

void CmaEs::update(std::span<const std::vector<double>> points) {
  SWARMSMITH_ASSERT(points.size() >= weights_.size(), "a generation's best half is there");
  constexpr double kLargestStep = 1e10;
  const std::size_t n = dimensions();
  ++generation_;
  // y_w, the weighted mean of the steps (equation 41).
  std::vector<double> moved(n, 0);
  for (std::size_t k = 0; k < weights_.size(); ++k) {
    SWARMSMITH_ASSERT(points[k].size() == n, "a point has each dimension");
    for (std::size_t i = 0; i < n; ++i)
      moved[i] += weights_[k] * (points[k][i] - mean_[i]) / step_;
  }
  // C^(-1/2) y_w = B D^-1 B^T y_w, for the path of the step size (equation 43).
  std::vector<double> whitened(n, 0);
  for (std::size_t j = 0; j < n; ++j) {
    double along = 0;
    for (std::size_t i = 0; i < n; ++i)
      along += axes_[at(n, i, j)] * moved[i];
    along /= lengths_[j];
    for (std::size_t i = 0; i < n; ++i)
      whitened[i] += axes_[at(n, i, j)] * along;
  }
  const double step_gain = std::sqrt(c_sigma_ * (2 - c_sigma_) * mu_eff_);
  double length = 0;
  for (std::size_t i = 0; i < n; ++i) {
    step_path_[i] = (1 - c_sigma_) * step_path_[i] + step_gain * whitened[i];
    length += square(step_path_[i]);
  }
  length = std::sqrt(length);
  // h_sigma stops the other path while the step size grows fast (text below equation 45).
  double remembered = 1;
  for (std::int64_t i = 0; i < 2 * generation_ && remembered > 1e-20; ++i)
    remembered *= 1 - c_sigma_;
  const bool stalls =
      length / std::sqrt(1 - remembered) >= (1.4 + 2 / (static_cast<double>(n) + 1)) * chi_n_;
  const double path_gain = stalls ? 0 : std::sqrt(c_c_ * (2 - c_c_) * mu_eff_);
  for (std::size_t i = 0; i < n; ++i)
    covariance_path_[i] = (1 - c_c_) * covariance_path_[i] + path_gain * moved[i];
  // Rank one and rank mu (equation 47).
  const double kept = 1 - c_1_ - c_mu_ + (stalls ? c_1_ * c_c_ * (2 - c_c_) : 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double rank_mu = 0;
      for (std::size_t k = 0; k < weights_.size(); ++k) {
        rank_mu +=
            weights_[k] * ((points[k][i] - mean_[i]) / step_) * ((points[k][j] - mean_[j]) / step_);
      }
      double& element = covariance_[at(n, i, j)];
      element = kept * element + c_1_ * covariance_path_[i] * covariance_path_[j] + c_mu_ * rank_mu;
      covariance_[at(n, j, i)] = element;
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    mean_[i] += step_ * moved[i];
  // Equation 44.
  step_ = std::min(kLargestStep, step_ * exp(c_sigma_ / d_sigma_ * (length / chi_n_ - 1)));
  decompose();
}

namespace {

class CmaEsBreeder final : public Breeder {
 public:
  CmaEsBreeder(RealBox box, Rng rng, CmaEs distribution)
      : box_(std::move(box)), rng_(rng), distribution_(std::move(distribution)) {}

  Expected<Brood> breed(std::int64_t generation, std::int64_t size, std::int64_t next_id,
                        std::span<const Scored> last) override {
    learn(last);
    points_.clear();
    Rng rng = rng_.split("cma-es", static_cast<std::uint64_t>(generation));
    Brood brood;
    for (std::int64_t i = 0; i < size; ++i) {
      std::vector<double> point = draw(rng);
      Configuration configuration = box_.to_configuration(point);
      // The distribution learns from the rounded point that was run, except for points outside the
      // box.
      if (is_inside(point)) point = box_.to_point(configuration);
      SWARMSMITH_ASSERT(point.size() == box_.dimensions(), "a point has the box's dimensions");
      points_.emplace(next_id + i, std::move(point));
      brood.newcomers.push_back({std::move(configuration), 0});
    }
    return brood;
  }

  Expected<Brood> finalists(std::int64_t count, std::int64_t,
                            std::span<const Scored> last) override {
    learn(last);
    // The distribution's mean, which is its estimate of the best point, replaces the worst member
    // (docs/methods.md).
    SWARMSMITH_ASSERT(static_cast<std::int64_t>(last.size()) >= count - 1, "finalists were run");
    Brood brood;
    for (const Scored& one : last.first(static_cast<std::size_t>(count - 1)))
      brood.known.push_back(one.id);
    brood.newcomers.push_back({box_.to_configuration(distribution_.mean()), 0});
    return brood;
  }

  std::vector<Scored> elites(std::span<const Scored> generation) override {
    constexpr std::size_t kElites = 5;  ///< one of this many is an elite, as in evolution
    const auto best = generation.first(std::max<std::size_t>(1, generation.size() / kElites));
    return {best.begin(), best.end()};
  }

  void add_to(Digest& digest) const override {
    digest.add(distribution_.step());
    for (const double value : distribution_.mean())
      digest.add(value);
    for (const double value : distribution_.covariance())
      digest.add(value);
  }

 private:
  static bool is_inside(std::span<const double> point) {
    return std::ranges::all_of(
        point, [](double x) { return x >= -RealBox::kHalfWidth && x <= RealBox::kHalfWidth; });
  }

  /// A point outside the box is drawn again. After a hundred times it stays outside, and its
  /// configuration is on the border: the distribution may have left the box.
  std::vector<double> draw(Rng& rng) {
    constexpr int kTries = 100;
    std::vector<double> point;
    for (int i = 0; i < kTries; ++i) {
      std::vector<double> normals(box_.dimensions());
      for (double& normal : normals)
        normal = rng.normal();
      point = distribution_.point_of(normals);
      if (is_inside(point)) break;
    }
    return point;
  }

  /// Updates the distribution with a generation, only once.
  void learn(std::span<const Scored> last) {
    if (last.empty() || !points_.contains(last.front().id)) return;
    std::vector<std::vector<double>> order;
    order.reserve(last.size());
    for (const Scored& one : last)
      order.push_back(points_.at(one.id));
    distribution_.update(order);
    points_.clear();
  }

  RealBox box_;
  Rng rng_;
  CmaEs distribution_;
  std::map<std::int64_t, std::vector<double>> points_;  ///< points of the generation, by id
};

}  // namespace

}  // namespace swarmsmith::search

namespace swarmsmith {

Expected<std::unique_ptr<search::Strategy>> CmaEsOptions::start(search::Start from) const {
  auto box = search::RealBox::of(from.space, kWords.name);
  if (!box) return Unexpected(box.error());
  const auto plan =
      search::plan_generations(from.scenario.max_experiments, population, runs, final_runs);
  if (!plan) return Unexpected(plan.error());
  std::vector<double> mean(box->dimensions(), 0);
  if (!from.initial.empty()) mean = box->to_point(from.initial.front());
  search::CmaEs distribution(std::move(mean), step, population);
  return std::make_unique<search::Generations>(
      *plan, std::make_unique<search::CmaEsBreeder>(std::move(*box), Rng(from.scenario.seed),
                                                    std::move(distribution)));
}

SearchPoint CmaEsOptions::planned(SearchPoint point) const {
  return search::planned_by(search::plan_generations(point.budget, population, runs, final_runs),
                            point);
}

}  // namespace swarmsmith
