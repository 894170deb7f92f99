#include "analysis/figures/machine_figure.h"

#include "analysis/figures/figure.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"
#include "tests/support/synthetic_campaign.h"

namespace swarmsmith {
namespace {

struct MachineFigureTest : FilledStore {
  Expected<Figure> make(const FigureOptions& options) {
    return find_figure_kind("machine")->make(*reader, options);
  }
};

TEST_F(MachineFigureTest, DrawsTheBestOfTheOneDesignThatIsNamed) {
  const auto figure = value_of(make({.filter = {.design = DesignId{2}}}));
  const auto best = *designs(*reader, {.design = DesignId{2}})->front().best;
  EXPECT_THAT(figure.svg, HasSubstr("<title>d2 " + to_string(best) + ", "));
  EXPECT_THAT(figure.tex, StartsWith("\\begin{tikzpicture}"));
  EXPECT_THAT(figure.csv, StartsWith("state,behaviour,behaviour_parameters,transition,target,"
                                     "condition,condition_parameters\n0,"));
  const auto named = value_of(make({.candidate = best}));
  EXPECT_EQ(named.svg, figure.svg);
}

TEST_F(MachineFigureTest, OfSeveralDesignsIsASheetInTheirOrder) {
  const auto sheet = value_of(make({}));
  const std::size_t first = sheet.svg.find(">d1 c");
  const std::size_t second = sheet.svg.find(">d2 c");
  ASSERT_NE(second, std::string::npos);
  EXPECT_LT(first, second);
  EXPECT_THAT(sheet.csv, StartsWith("design,candidate,state,behaviour,"));
}

TEST_F(MachineFigureTest, OfManyDesignsHasPagesThatHoldEachOnce) {
  const SyntheticCampaign many = synthetic_campaign({.designs = 12, .iterations = 1});
  {
    auto store = open_store(folder / "many.db", many);
    for (const auto& batch : many.batches)
      store->append(batch);
  }
  reader = open_reader(folder / "many.db");
  for (const double width : {85.0, 174.0}) {
    const auto figure = value_of(make({.width_mm = width}));
    ASSERT_GT(figure.pages.size(), 1U);
    std::string all;
    for (const std::string& page : figure.pages) {
      EXPECT_LE(std::stod(page.substr(page.find("height=\"") + 8)), kFigurePage_mm);
      all += page;
    }
    for (int design = 1; design <= 12; ++design) {
      const std::string name = ">d" + std::to_string(design) + " c";
      const std::size_t at = all.find(name);
      ASSERT_NE(at, std::string::npos) << name;
      EXPECT_EQ(all.find(name, at + 1), std::string::npos) << name;
    }
  }
  EXPECT_THAT(make({.filter = {.design = DesignId{2}}})->pages, IsEmpty());
}

TEST_F(MachineFigureTest, SaysWhatIsMissingOrOutOfPlace) {
  EXPECT_EQ(make({.candidate = CandidateId{999'999'999}}).error().kind, ErrorKind::NotFound);
  EXPECT_EQ(make({.filter = {.mission = "gone"}}).error().kind, ErrorKind::NotFound);
  EXPECT_THAT(make({.by = "source"}).error().message, HasSubstr("no --by"));
  EXPECT_THAT(make({.width_mm = 40}).error().message, HasSubstr("60 mm"));
}

/// Designs of a machine, a tree and a network.
struct ControllerFigureTest : testing::Test {
  static constexpr SyntheticSize kSize{.designs = 3, .iterations = 3};
  TemporaryFolder folder;
  std::unique_ptr<StoreReader> reader;

  ControllerFigureTest() {
    auto store = open_store(folder / "s.db", synthetic_header(kSize));
    append(*store, DesignId{1}, "--nstates 1 --s0 1");
    append(*store, DesignId{2},
           "--nroot 3 --nchildroot 1 --n0 0 --nchild0 2 --n00 6 --c00 0 --p00 0.5 --n01 5 --a01 1 "
           "--p01 0");
    append(*store, DesignId{3},
           "--network rvr-gray --weights "
           "0,-0.5,1,1.25,5,0,0,0,0,0,0,1,2,3,4,5,-1,-2,-3,-4,-5,0.125");
    store.reset();
    reader = open_reader(folder / "s.db");
  }

  static void append(Store& store, DesignId design, const std::string& text) {
    for (std::vector<Row> batch : synthetic_design(kSize, design)) {
      for (Row& row : batch)
        if (auto* candidate = std::get_if<CandidateRow>(&row)) candidate->machine = text;
      store.append(batch);
    }
  }

  Expected<Figure> make(const FigureOptions& options) {
    return find_figure_kind("machine")->make(*reader, options);
  }
};

TEST_F(ControllerFigureTest, DrawsATree) {
  const auto figure = value_of(make({.filter = {.design = DesignId{2}}}));
  EXPECT_THAT(figure.svg, HasSubstr(">→*<"));
  EXPECT_THAT(figure.svg, Not(HasSubstr("\">d2 c")));
  EXPECT_THAT(figure.tex, HasSubstr("{$\\rightarrow$*};"));
  EXPECT_EQ(figure.csv,
            "subtree,condition,condition_parameters,action,action_parameters\n"
            "0,black_floor,beta=0.5,stop,\n");
}

TEST_F(ControllerFigureTest, DrawsANetworkBelowATitleThatPapersLeaveOut) {
  FigureOptions options{.filter = {.design = DesignId{3}}};
  const auto figure = value_of(make(options));
  EXPECT_THAT(figure.svg, HasSubstr(">bias<"));
  EXPECT_THAT(figure.svg, HasSubstr("\">d3 c"));
  EXPECT_THAT(figure.csv, StartsWith("input,left_weight,right_weight\n"
                                     "obstacle 45,0,1\nobstacle 135,-0.5,2\n"));
  options.paper = true;
  EXPECT_THAT(make(options)->svg, Not(HasSubstr("\">d3 c")));
}

TEST_F(ControllerFigureTest, OfAllKindsIsASheetWithTheColumnsOfAll) {
  const auto sheet = value_of(make({.width_mm = 174}));
  EXPECT_THAT(sheet.svg, HasSubstr("<title>3 controllers</title>"));
  EXPECT_THAT(sheet.csv,
              StartsWith("design,candidate,state,behaviour,behaviour_parameters,transition,target,"
                         "condition,condition_parameters,subtree,action,action_parameters,input,"
                         "left_weight,right_weight\n"));
  EXPECT_THAT(sheet.csv, HasSubstr(",,,,,,black_floor,beta=0.5,0,stop,,,,\n"));
  EXPECT_THAT(sheet.csv, HasSubstr(",,,,,,,,,,,bias,0,0.125\n"));
}

TEST(ControllerOf, NeedsTheFlavour) {
  MachineRecord record{.candidate = CandidateId{7}, .machine = "--nstates 1 --s0 1"};
  // A program may have the switches of machines.
  EXPECT_THAT(controller_of(record, 11).error().message,
              HasSubstr("c7 is a configuration of a program, not a machine"));
  EXPECT_THAT(controller_of(record, 3).error().message, HasSubstr("`swarmsmith backup"));
  record.flavour = "melon";
  EXPECT_THAT(controller_of(record, 11).error().message, HasSubstr("flavour melon"));
  record.flavour = "watermelon";
  EXPECT_TRUE(controller_of(record, 11));
  record.machine = "--x 3.5";
  EXPECT_THAT(controller_of(record, 11).error().message, HasSubstr("configuration of a program"));
}

TEST(MachineCsv, HasARowForEachStateAndTransition) {
  const StoredController stored{
      .controller = Machine{{State{.behaviour = Attraction{2.5},
                                   .transitions = {{ColorDetection{0.45, ColorLabel::Red}, 1},
                                                   {InvertedNeighbourCount{1.5, 3}, 1}}},
                             State{.behaviour = Stop{}, .transitions = {}}}},
      .flavour = &watermelon()};
  EXPECT_EQ(controller_csv(stored),
            "state,behaviour,behaviour_parameters,transition,target,condition,condition_parameters"
            "\n0,attraction,alpha=2.5,,,,\n"
            "0,attraction,alpha=2.5,0,1,color_detection,beta=0.45 label=red\n"
            "0,attraction,alpha=2.5,1,1,inverted_neighbour_count,xi=3 eta=1.5\n"
            "1,stop,,,,,\n");
}

}  // namespace
}  // namespace swarmsmith
