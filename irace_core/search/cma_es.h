#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/rng.h"
#include "irace_core/parameter_space.h"
#include "irace_core/scenario.h"
#include "irace_core/search/search_parts.h"
#include "irace_core/search/strategy.h"

namespace swarmsmith {

/// CMA-ES on a RealBox, starting from its middle, in generations like those of evolution. The final
/// stage runs the best configurations of the last generation and the mean of the distribution. A
/// point outside the box is drawn again, up to a hundred times; after that, the nearest point
/// inside is run, and the distribution is updated with the point that was drawn. Normal numbers of
/// generation g come from the stream "cma-es" with index g.
struct CmaEsOptions {
  static constexpr SearchWords kWords{.name = "cma-es",
                                      .round = "generation",
                                      .at_work = "searching",
                                      .where = "final stage",
                                      .candidate = "member",
                                      .wants_reals = true};

  std::int64_t population = 100;
  std::int64_t runs = 10;
  double step = 2;              ///< first standard deviation, in tenths of a parameter's range
  std::int64_t final_runs = 0;  ///< as for evolution

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visitor) {
    visitor(SearchField{"population", 4, kMostRuns}, self.population);
    visitor(SearchField{"runs", 1, kMostRuns}, self.runs);
    visitor(SearchField{"step", 1e-6, 10}, self.step);
    visitor(SearchField{"final_runs", 0, kMostRuns}, self.final_runs);
  }
  /// The errors are the same as for evolution.
  Expected<std::unique_ptr<search::Strategy>> start(search::Start from) const;
  SearchPoint planned(SearchPoint point) const;
  friend bool operator==(const CmaEsOptions&, const CmaEsOptions&) = default;
};

namespace search {

/// The distribution of CMA-ES: a normal distribution whose mean, step size and covariance matrix
/// follow the best half of each generation. Hansen, "The CMA Evolution Strategy: A Tutorial",
/// arXiv:1604.00772, with its standard parameters. Plain loops in a fixed order and our own
/// eigenvectors give the same bits on every machine.
class CmaEs {
 public:
  /// `population` is lambda; `step` the first standard deviation.
  CmaEs(std::vector<double> mean, double step, std::int64_t population);

  /// The point mean + step * B D z for standard normal numbers z.
  std::vector<double> point_of(std::span<const double> normals) const;
  /// `points` are those of a generation, best first: at least the best half of `population`.
  void update(std::span<const std::vector<double>> points);

  std::span<const double> mean() const { return mean_; }
  double step() const { return step_; }
  std::int64_t generation() const { return generation_; }
  /// The covariance matrix without the step size, row by row, n x n.
  std::span<const double> covariance() const { return covariance_; }

 private:
  std::size_t dimensions() const { return mean_.size(); }
  /// Decomposes the covariance matrix: `axes_` gets its eigenvectors as columns, and `lengths_` the
  /// square roots of its eigenvalues.
  void decompose();

  std::vector<double> weights_;  ///< weights of the best half; their sum is 1
  double mu_eff_ = 0;
  double c_sigma_ = 0;
  double d_sigma_ = 0;
  double c_c_ = 0;
  double c_1_ = 0;
  double c_mu_ = 0;
  double chi_n_ = 0;  ///< expected length of a standard normal vector

  std::vector<double> mean_;
  double step_;
  std::vector<double> covariance_;
  std::vector<double> axes_;
  std::vector<double> lengths_;
  std::vector<double> step_path_;
  std::vector<double> covariance_path_;
  std::int64_t generation_ = 0;
};

/// Eigenvalues of a symmetric matrix (n x n, row by row), by Jacobi's method with cyclic sweeps;
/// `vectors` gets the eigenvectors as columns. Golub and Van Loan, "Matrix Computations", 8.5.
std::vector<double> eigenvalues(std::vector<double> matrix, std::size_t n,
                                std::vector<double>& vectors);

}  // namespace search
}  // namespace swarmsmith
