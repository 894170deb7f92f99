#include "benchmarks/colony/colony.h"

#include <array>
#include <cmath>
#include <vector>

#include "base/math.h"

namespace swarmsmith::colony {
namespace {

/// Indexes of the parameters in the space.
enum Index : std::size_t { kAlgo, kLs, kAlpha, kBeta, kRho, kAnts, kQ0, kRank, kNn, kDlb };

/// Indexes of values of `algo`.
constexpr std::size_t kC = 2;
constexpr std::size_t kD = 3;

double fraction(double x) {
  return x - std::floor(x);
}
double square(double x) {
  return x * x;
}

/// The numbers a and b of an instance.
struct Traits {
  explicit Traits(std::int64_t instance)
      : a(fraction(static_cast<double>(instance) * 0.6180339887498949)),
        b(fraction(static_cast<double>(instance) * 0.7548776662466927)) {}
  double a;
  double b;
};

/// A hash of the keys, then the sum of four uniform numbers, scaled to variance 1.
class Noise {
 public:
  void add(std::int64_t key) {
    const auto prime = static_cast<std::int64_t>(kPrime);
    const std::int64_t positive = ((key % prime) + prime) % prime;
    state_ = (state_ * state_ + static_cast<std::uint64_t>(positive) + 40503) % kPrime;
  }
  double draw() {
    double sum = 0;
    for (std::uint64_t j = 1; j <= 4; ++j) {
      for (std::uint64_t r = 1; r <= 2; ++r)
        state_ = (state_ * state_ + 1000003 * j + r) % kPrime;
      sum += (static_cast<double>(state_) + 0.5) / static_cast<double>(kPrime);
    }
    return (sum - 2) * std::sqrt(3.0);
  }

 private:
  static constexpr std::uint64_t kPrime = 67108859;
  std::uint64_t state_ = 12345;
};

/// The key of a parameter's value: choices by their position from 1, reals in ten-thousandths,
/// integers plus one; 0 for inactive.
std::int64_t key_of(const Configuration& configuration, std::size_t index) {
  if (!configuration.is_active(index)) return 0;
  const double value = configuration[index];
  const bool is_real = index == kAlpha || index == kBeta || index == kRho || index == kQ0;
  return static_cast<std::int64_t>(is_real ? std::floor(value * 10000 + 0.5) : value + 1);
}

}  // namespace

ParameterSpace space() {
  const auto equal = [](const char* name, const char* value) {
    return Expression::call(Operation::Equal,
                            {Expression::parameter(name), Expression::text(value)});
  };
  const Expression searches =
      Expression::in(Expression::parameter("ls"),
                     {Expression::text("1"), Expression::text("2"), Expression::text("3")});
  std::vector<Parameter> parameters = {{"algo", "--algo ", Categorical{{"a", "b", "c", "d"}}, {}},
                                       {"ls", "--ls ", Ordinal{{"0", "1", "2", "3"}}, {}},
                                       {"alpha", "--alpha ", Real{0.0, 5.0}, {}},
                                       {"beta", "--beta ", Real{0.0, 10.0}, {}},
                                       {"rho", "--rho ", Real{0.01, 1.0}, {}},
                                       {"ants", "--ants ", Integer{5.0, 500.0, true}, {}},
                                       {"q0", "--q0 ", Real{0.0, 1.0}, equal("algo", "d")},
                                       {"rank", "--rank ", Integer{1.0, 100.0}, equal("algo", "c")},
                                       {"nn", "--nn ", Integer{5.0, 50.0}, searches},
                                       {"dlb", "--dlb ", Categorical{{"0", "1"}}, searches}};
  return ParameterSpace::make(std::move(parameters)).value();
}

double loss(const Configuration& c, std::int64_t instance) {
  constexpr std::array<double, 4> kOfAlgo = {0.30, 0.12, 0.08, 0.05};
  constexpr std::array<double, 4> kOfLs = {0.40, 0.15, 0.05, 0.00};
  constexpr std::array<double, 4> kBestRho = {0.10, 0.30, 0.50, 0.20};
  const Traits of(instance);
  const std::size_t algo = c.choice(kAlgo);
  const std::size_t ls = c.choice(kLs);
  const double ln_100 = log(100);
  double g = kOfAlgo[algo] + kOfLs[ls];
  g += 1.2 * square((c[kAlpha] - 1.0 - 0.6 * (of.a - 0.5)) / 5);
  g += 0.8 * square((c[kBeta] - 3.0 - 4.0 * (of.b - 0.5)) / 10);
  g += 0.02 * (1 - cos(2 * kPi * c[kBeta]));
  g += 0.6 * square(c[kRho] - kBestRho[algo] - 0.1 * (of.a - 0.5));
  g += 0.5 * square((log(c[kAnts]) - log(ls == 0 ? 200 : 25)) / ln_100);
  if (algo == kD) g += 0.5 * square(c[kQ0] - 0.9 + 0.2 * of.a);
  if (algo == kC) g += 0.3 * square((log(c[kRank]) - log(6 + 4 * of.b)) / ln_100);
  if (ls > 0) {
    g += 0.4 * square((c[kNn] - 20 - 10 * (of.a - 0.5)) / 45);
    if (c.choice(kDlb) == 0) g += 0.03 * (1 + of.b);
  }
  return g;
}

double cost(const Configuration& configuration, std::int64_t instance, std::int64_t seed) {
  Noise noise;
  noise.add(instance);
  noise.add(seed);
  for (std::size_t i = 0; i < configuration.size(); ++i)
    noise.add(key_of(configuration, i));
  return pow(10, 1 + 2 * Traits(instance).a) * (1 + loss(configuration, instance)) *
         (1 + 0.05 * noise.draw());
}

double true_cost(const Configuration& configuration) {
  constexpr std::int64_t kScored = 1000;
  double sum = 0;
  for (std::int64_t instance = 1; instance <= kScored; ++instance)
    sum += loss(configuration, instance);
  return sum / static_cast<double>(kScored);
}

}  // namespace swarmsmith::colony
