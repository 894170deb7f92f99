#include "analysis/machines/machine_drawing.h"

#include <algorithm>
#include <regex>
#include <sstream>

#include "sim/control/flavour_file.h"
#include "tests/analysis/machines/machines_to_draw.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// Explores until black, then stands; leaves again on green.
Machine small_machine() {
  return {{State{.behaviour = Exploration{42}, .transitions = {{BlackFloor{0.96}, 1}}},
           State{.behaviour = Stop{},
                 .transitions = {{ColorDetection{0.5, ColorLabel::Green}, 0},
                                 {NeighbourCount{6.2, 2}, 0}}}}};
}

MachineLayout small_layout() {
  return lay_out(small_machine(), watermelon(), 84);
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

TEST(MachineSvg, HasNamesParametersAndTwoCirclesForTheInitialState) {
  const std::string svg = svg_of(small_layout(), "d1 c7");
  for (const char* word : {"<title>d1 c7</title>", ">Exploration<", ">τ = 42<", ">Stop<",
                           ">Black floor<", ">β = 0.96<", ">Color detection<", ">β = 0.5, green<",
                           ">Neighbour count<", ">ξ = 2, η = 6.2<"}) {
    EXPECT_THAT(svg, HasSubstr(word));
  }
  EXPECT_EQ(occurrences(svg, "<circle"), 3U);
}

TEST(MachineSvg, NamesEachStateAsAPartForPagesThatLightItUp) {
  const std::string svg = svg_of(small_layout(), "d1 c7");
  EXPECT_EQ(occurrences(svg, "<g data-state="), 2U);
  const std::string first = svg.substr(svg.find("<g data-state=\"0\">"));
  const std::string part = first.substr(0, first.find("</g>"));
  EXPECT_EQ(occurrences(part, "<circle"), 2U);
  EXPECT_THAT(part, HasSubstr(">Exploration<"));
  EXPECT_EQ(occurrences(svg, "</g>"), 2U);
}

TEST(MachineSvg, CanStandInAPageWithOthers) {
  const std::string svg = svg_of(small_layout(), "");
  for (const char* word : {" id=", "marker", "<style", "url(", "<defs"})
    EXPECT_THAT(svg, Not(HasSubstr(word)));
}

/// What a line of our pictures may be: commands of TikZ itself, with numbers, colours and the five
/// letters of the thesis.
bool is_tikz_line(const std::string& line) {
  const std::string number = R"(-?[0-9]+(\.[0-9]+)?)";
  const std::string point = "\\(" + number + "," + number + "\\)";
  const std::string color = R"(\{rgb,255:red,[0-9]+;green,[0-9]+;blue,[0-9]+\})";
  const std::string dashes = "(,dash pattern=(on " + number + "mm off " + number + "mm ?)+)?";
  const std::string text = R"(([A-Za-z0-9 =.,:+-]|\$\\(tau|alpha|beta|xi|eta)\$)+)";
  for (const std::string& form :
       {std::string(R"(\\begin\{tikzpicture\}\[x=1mm,y=-1mm\])"),
        std::string(R"(\\end\{tikzpicture\})"),
        R"(\\useasboundingbox )" + point + " rectangle " + point + ";",
        R"(\\draw\[draw=)" + color + ",line width=" + number + "mm" + dashes + "\\] " + point +
            " \\.\\. controls " + point + " and " + point + " \\.\\. " + point + ";",
        R"(\\fill\[fill=)" + color + "\\] " + point + " -- " + point + " -- " + point +
            " -- cycle;",
        R"(\\draw\[draw=)" + color + ",fill=" + color + ",line width=" + number + "mm\\] " + point +
            " circle\\[radius=" + number + "mm\\];",
        R"(\\draw\[draw=)" + color + ",fill=" + color + ",line width=" + number + "mm\\]( " +
            point + " --){6} cycle;",
        R"(\\node\[anchor=base,inner sep=0pt,outer sep=0pt,scale=)" + number + "(,text=" + color +
            ")?" + R"(,font=\\sffamily\\fontsize\{10\}\{12\}\\selectfont\] at )" + point + " \\{" +
            text + "\\};"}) {
    if (std::regex_match(line, std::regex(form))) return true;
  }
  return false;
}

TEST(MachineTikz, HoldsNothingButPlainTikz) {
  std::vector<MachineLayout> layouts = {small_layout()};
  for (const auto& [name, machine] : machines_of("argos-thesis-designs.csv"))
    layouts.push_back(lay_out(machine, watermelon_argos3(), 84));
  for (const MachineLayout& layout : layouts) {
    std::istringstream lines(tikz_of(layout));
    std::string line;
    while (std::getline(lines, line))
      EXPECT_TRUE(is_tikz_line(line)) << line;
  }
}

TEST(MachineTikz, EscapesTheUnderscoresOfNames) {
  MachineLayout layout = small_layout();
  layout.states.front().lines.front().text = "turn_speed = 0.25, τ_2 = 1";
  EXPECT_THAT(tikz_of(layout), HasSubstr("{turn\\_speed = 0.25, $\\tau$\\_2 = 1};"));
}

TEST(MachineTikz, HasThePlacesOfTheSvg) {
  const MachineLayout layout = small_layout();
  const std::string tikz = tikz_of(layout);
  EXPECT_THAT(tikz, HasSubstr("{$\\tau$ = 42};"));
  EXPECT_THAT(tikz, HasSubstr("{$\\xi$ = 2, $\\eta$ = 6.2};"));
  EXPECT_EQ(occurrences(tikz, "circle["), 3U);
  std::ostringstream centre;
  centre.precision(2);
  centre << std::fixed << "(" << layout.states[1].centre.x << "," << layout.states[1].centre.y
         << ") circle";
  EXPECT_THAT(tikz, HasSubstr(centre.str()));
}

TEST(MachineTikz, HasTheLettersOfRandomWalks) {
  const Flavour walks = value_of(parse_flavour(
      "format = 1\nbase = \"watermelon\"\n[behaviours]\nlevy_walk = { number = 0 }\n", "w.toml"));
  const MachineLayout layout = lay_out(Machine{{{LevyWalk{2.77, 0.7}, {}}}}, walks, 84);
  EXPECT_THAT(tikz_of(layout), HasSubstr("{$\\mu$ = 2.77, $\\rho$ = 0.7};"));
  EXPECT_THAT(svg_of(layout, ""), HasSubstr(">μ = 2.77, ρ = 0.7<"));
}

/// The second state is one that nothing leads to.
MachineLayout with_an_unreachable_state() {
  Machine machine = small_machine();
  machine.states[0].transitions.clear();
  return lay_out(machine, watermelon(), 84);
}

TEST(MachineSvg, IsGreyWhereNoTransitionLeads) {
  const std::string whole = svg_of(small_layout(), "");
  EXPECT_THAT(whole, Not(HasSubstr("grey: ")));
  EXPECT_THAT(whole, HasSubstr(distinct_color(1)));
  const MachineLayout layout = with_an_unreachable_state();
  EXPECT_TRUE(layout.states[0].reachable);
  EXPECT_FALSE(layout.states[1].reachable);
  const std::string svg = svg_of(layout, "");
  EXPECT_THAT(svg, HasSubstr(">grey: no transition leads there<"));
  EXPECT_THAT(svg, Not(HasSubstr(distinct_color(1))));
  std::istringstream tikz(tikz_of(layout));
  for (std::string line; std::getline(tikz, line);)
    EXPECT_TRUE(is_tikz_line(line)) << line;
}

TEST(MachineDot, LeadsFromStatesThroughConditionsToStates) {
  const std::string dot = dot_of(small_layout(), "a \"b\" \\");
  EXPECT_THAT(dot, HasSubstr("digraph \"a \\\"b\\\" \\\\\" {"));
  EXPECT_THAT(dot, HasSubstr("s0 [shape=doublecircle"));
  EXPECT_THAT(dot, HasSubstr("label=\"Exploration\\nτ = 42\""));
  EXPECT_THAT(dot, HasSubstr("s1 [shape=circle"));
  EXPECT_THAT(dot, HasSubstr("label=\"Neighbour count\\nξ = 2, η = 6.2\""));
  for (const char* edge : {"s0 -> c0", "c0 -> s1", "s1 -> c1", "c1 -> s0", "s1 -> c2", "c2 -> s0"})
    EXPECT_THAT(dot, HasSubstr(edge));
  EXPECT_EQ(occurrences(dot, "{"), occurrences(dot, "}"));
}

}  // namespace
}  // namespace swarmsmith
