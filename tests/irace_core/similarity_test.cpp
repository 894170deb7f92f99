#include "irace_core/internal/similarity.h"

#include <gtest/gtest.h>

#include "tests/irace_core/spaces.h"

namespace swarmsmith::irace {
namespace {

using testing::make_integer;
using testing::make_real;
using testing::space_of;

std::vector<std::size_t> similar(const ParameterSpace& space, double a, double b,
                                 double threshold) {
  Configuration first(1);
  Configuration second(1);
  first.set(0, a);
  second.set(0, b);
  return similar_configurations(space, {&first, &second}, threshold);
}

TEST(Similarity, MeasuresNumbersByTheWidthOfTheirDomain) {
  const ParameterSpace space = space_of({make_integer("ants", 1, 1001)});
  EXPECT_EQ(similar(space, 10, 20, 0.01).size(), 2U);
  EXPECT_TRUE(similar(space, 10, 21, 0.01).empty());
}

TEST(Similarity, MeasuresLogarithmicNumbersInTheLogarithm) {
  const ParameterSpace space = space_of({make_real("rate", 0.001, 1, true)});
  // A tenth of three decades is a factor of 2, wherever it is.
  EXPECT_EQ(similar(space, 0.002, 0.0039, 0.1).size(), 2U);
  EXPECT_TRUE(similar(space, 0.002, 0.0042, 0.1).empty());
  EXPECT_EQ(similar(space, 0.4, 0.78, 0.1).size(), 2U);
  EXPECT_TRUE(similar(space, 0.001, 0.01, 0.1).empty());
}

/// Each is measured in its own domain, [1, ants].
TEST(Similarity, MeasuresDependentNumbersByTheDomainThatTheyHaveThere) {
  const ParameterSpace space = space_of(
      {{"elite", "", Integer{1.0, testing::name("ants")}, {}}, make_integer("ants", 1, 1001)});
  const auto similar_elites = [&](double first_elite, double second_elite) {
    Configuration first(2);
    Configuration second(2);
    first.set(0, first_elite);
    second.set(0, second_elite);
    first.set(1, 101);
    second.set(1, 111);
    return similar_configurations(space, {&first, &second}, 0.01).size();
  };
  EXPECT_EQ(similar_elites(51, 56), 2U);  // the middle of both
  EXPECT_EQ(similar_elites(51, 51), 0U);
}

}  // namespace
}  // namespace swarmsmith::irace
