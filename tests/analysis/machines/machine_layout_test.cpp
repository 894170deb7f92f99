#include "analysis/machines/machine_layout.h"

#include <gmock/gmock.h>

#include <cmath>
#include <stdexcept>

#include "tests/analysis/machines/machines_to_draw.h"
#include "tests/support/long_runs.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

constexpr double kPage = 174;   // two columns of a paper
constexpr double kColumn = 84;  // one

double distance(PagePoint a, PagePoint b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// How far two boxes are apart in x or in y, whichever is more; negative when they overlap.
double apart(const ConditionShape& a, const ConditionShape& b) {
  return std::max(std::fabs(a.centre.x - b.centre.x) - (a.width + b.width) / 2,
                  std::fabs(a.centre.y - b.centre.y) - (a.height + b.height) / 2);
}

double distance_to_box(const ConditionShape& box, PagePoint point) {
  return std::hypot(std::max(0.0, std::fabs(point.x - box.centre.x) - box.width / 2),
                    std::max(0.0, std::fabs(point.y - box.centre.y) - box.height / 2));
}

PagePoint on_curve(const ConditionShape& shape, double part) {
  const double rest = 1 - part;
  const auto [a, b, c] = shape.curve;
  return {rest * rest * a.x + 2 * rest * part * b.x + part * part * c.x,
          rest * rest * a.y + 2 * rest * part * b.y + part * part * c.y};
}

/// Text in its shape: each line's four corners lie where `holds` says, and lines are below each
/// other.
template <class Holds>
void expect_lines_within(const std::vector<LabelLine>& lines, const Holds& holds) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double half = text_width(lines[i].text, lines[i].size) / 2;
    for (const double x : {-half, half}) {
      // Letters reach 0.8 of their size above the base line, and 0.2 below.
      for (const double y : {-0.8 * lines[i].size, 0.2 * lines[i].size}) {
        EXPECT_TRUE(holds(PagePoint{lines[i].at.x + x, lines[i].at.y + y})) << lines[i].text;
      }
    }
    if (i > 0) {
      EXPECT_GE(lines[i].at.y - lines[i - 1].at.y, lines[i].size);
    }
  }
}

void expect_page_holds(const MachineLayout& layout) {
  const auto holds = [&](PagePoint point, double x, double y) {
    return point.x - x >= 0 && point.x + x <= layout.width && point.y - y >= 0 &&
           point.y + y <= layout.height;
  };
  for (const StateShape& state : layout.states)
    EXPECT_TRUE(holds(state.centre, state.radius, state.radius));
  for (const ConditionShape& shape : layout.conditions) {
    EXPECT_TRUE(holds(shape.centre, shape.width / 2, shape.height / 2));
    for (int i = 0; i <= 50; ++i)
      EXPECT_TRUE(holds(on_curve(shape, i / 50.0), 0, 0));
    for (const PagePoint corner : shape.head)
      EXPECT_TRUE(holds(corner, 0, 0));
  }
}

/// From its source's circle, through its box, to its target's circle; through no other state.
void expect_edge(const MachineLayout& layout, const ConditionShape& shape) {
  const StateShape& source = layout.states[shape.source];
  const StateShape& target = layout.states[shape.target];
  EXPECT_NEAR(distance(shape.curve[0], source.centre), source.radius, 0.3);
  EXPECT_NEAR(distance(shape.head[0], target.centre), target.radius, 0.5);
  EXPECT_GT(distance(shape.curve[2], target.centre), target.radius + 1.5);
  double nearest = 1e9;
  for (int i = 0; i <= 200; ++i) {
    const PagePoint point = on_curve(shape, i / 200.0);
    nearest = std::min(nearest, distance(point, shape.centre));
    for (std::size_t state = 0; state < layout.states.size(); ++state) {
      if (state == shape.source || state == shape.target) continue;
      EXPECT_GT(distance(point, layout.states[state].centre), layout.states[state].radius)
          << "through state " << state;
    }
  }
  EXPECT_LT(nearest, 1.5);
}

/// Nothing lies over anything else, and nothing outside of the page.
void expect_readable(const Machine& machine, const Flavour& flavour, double width,
                     const std::string& name) {
  SCOPED_TRACE(name + " at " + std::to_string(width));
  const MachineLayout layout = lay_out(machine, flavour, width);
  ASSERT_EQ(layout.states.size(), machine.states.size());
  EXPECT_EQ(layout.width, width);
  expect_page_holds(layout);
  std::size_t next = 0;
  for (std::size_t i = 0; i < layout.states.size(); ++i) {
    const StateShape& state = layout.states[i];
    EXPECT_EQ(state.initial, i == 0);
    expect_lines_within(state.lines, [&](PagePoint point) {
      return distance(point, state.centre) <= state.radius - kInitialRing;
    });
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(distance(state.centre, layout.states[j].centre), 2 * state.radius + 1);
    for (const Transition& transition : machine.states[i].transitions) {
      ASSERT_LT(next, layout.conditions.size());
      EXPECT_EQ(layout.conditions[next].source, i);
      EXPECT_EQ(layout.conditions[next].target, static_cast<std::size_t>(transition.target));
      ++next;
    }
  }
  EXPECT_EQ(next, layout.conditions.size());
  for (std::size_t a = 0; a < layout.conditions.size(); ++a) {
    const ConditionShape& shape = layout.conditions[a];
    expect_edge(layout, shape);
    expect_lines_within(shape.lines, [&](PagePoint point) {
      return std::fabs(point.x - shape.centre.x) <= shape.width / 2 - kBoxPoint &&
             std::fabs(point.y - shape.centre.y) <= shape.height / 2;
    });
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GT(apart(shape, layout.conditions[b]), 0.8) << "conditions " << a << " and " << b;
    for (const StateShape& state : layout.states)
      EXPECT_GT(distance_to_box(shape, state.centre) - state.radius, 0.8);
  }
}

/// Curves that pass under a box of another one.
int hidden_curves(const MachineLayout& layout) {
  int count = 0;
  for (const ConditionShape& curve : layout.conditions) {
    for (const ConditionShape& box : layout.conditions) {
      if (&curve == &box) continue;
      bool hidden = false;
      for (int i = 0; i <= 100 && !hidden; ++i)
        hidden = distance_to_box(box, on_curve(curve, i / 100.0)) <= 0;
      count += hidden ? 1 : 0;
    }
  }
  return count;
}

TEST(MachineLayout, OfTheThesisDesignsIsReadable) {
  const auto machines = machines_of("argos-thesis-designs.csv");
  ASSERT_EQ(machines.size(), 30U);
  int hidden = 0;
  for (const auto& [name, machine] : machines) {
    expect_readable(machine, watermelon_argos3(), kPage, name);
    expect_readable(machine, watermelon_argos3(), kColumn, name);
    hidden += hidden_curves(lay_out(machine, watermelon_argos3(), kPage));
  }
  EXPECT_EQ(hidden, 0) << "curves pass under boxes of others";
}

TEST(MachineLayout, OfTheReferenceMachinesIsReadable) {
  const auto machines = machines_of("argos-fsms.csv");
  ASSERT_EQ(machines.size(), 20U);
  for (const auto& [name, machine] : machines)
    expect_readable(machine, watermelon_argos3(), kPage, name);
}

TEST(MachineLayout, OfRandomMachinesIsReadable) {
  Rng rng = Rng(1).split("machines to draw");
  for (int i = 0; i < times(40, 160); ++i) {
    const Machine machine = random_machine(rng, 1 + i % 4);
    expect_readable(machine, watermelon_argos3(), i % 8 < 4 ? kPage : kColumn,
                    print_machine(machine, watermelon_argos3()));
    if (HasFailure()) break;
  }
}

TEST(MachineLayout, OfSixteenTransitionsIsReadable) {
  for (const auto& [name, machine] : not_empty(fullest_machines())) {
    expect_readable(machine, watermelon_argos3(), kPage, name);
    expect_readable(machine, watermelon_argos3(), kColumn, name);
  }
}

TEST(MachineLayout, OfModulesWithLongNamesAndValuesIsReadable) {
  Machine machine = fullest_machine({{1, 1}, {0, 2}, {0}});
  machine.states[1].behaviour = AntiPhototaxis{};
  machine.states[2].behaviour = Attraction{1.2345678e300};
  machine.states[2].transitions[0].condition = NeighbourCount{123456.789, 1'000'000};
  expect_readable(machine, chocolate(), kPage, "long");
}

TEST(MachineLayout, OfMoreThanFourStatesStandsOnAnEllipse) {
  Rng rng = Rng(2).split("machines to draw");
  for (const int states : {5, 6, 8})
    expect_readable(random_machine(rng, states), watermelon_argos3(), kPage,
                    std::to_string(states) + " states");
}

TEST(MachineLayout, IsTheSameEachTime) {
  const Machine machine = fullest_machines().front().machine;
  const MachineLayout first = lay_out(machine, watermelon_argos3(), kPage);
  const MachineLayout second = lay_out(machine, watermelon_argos3(), kPage);
  ASSERT_FALSE(first.conditions.empty());
  for (std::size_t i = 0; i < first.conditions.size(); ++i)
    EXPECT_EQ(first.conditions[i].centre, second.conditions[i].centre);
}

TEST(MachineLayout, RefusesWhatIsNoMachine) {
  EXPECT_THROW(lay_out(Machine{}, watermelon(), kPage), std::invalid_argument);
  EXPECT_THROW(lay_out(fullest_machine({{0}}), watermelon(), kPage), std::invalid_argument);
  EXPECT_THROW(lay_out(fullest_machine({{2}, {}}), watermelon(), kPage), std::invalid_argument);
  EXPECT_THROW(lay_out(fullest_machine({{1}, {}}), watermelon(), 50), std::invalid_argument);
  const Machine light{{State{.behaviour = Phototaxis{}, .transitions = {}}}};
  EXPECT_THROW(lay_out(light, watermelon(), kPage), std::invalid_argument);
}

}  // namespace
}  // namespace swarmsmith
