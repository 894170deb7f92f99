#include "cli/commands/commands.h"

#include <array>

#include "cli/arguments/machine_words.h"
#include "cli/commands/irace_command.h"
#include "cli/completion/offer_stored.h"

namespace swarmsmith::cli {
namespace {

constexpr std::string_view kRunDetails =
    R"(Runs the design processes of a campaign file with its own workers, and prints the winners. Without a
file it runs a demo: color_selection, 2,000 experiments, next to a hand-written machine and a random one,
store demo.db. Every score is stored as soon as it counts. After Ctrl-C, kill -9 or a power cut the same
command continues, and gives the same answer. On a finished store it prints the result again. Several
campaigns share the workers; each has its own store, and gives the answer that it would give alone.

Examples:
  swarmsmith run
  swarmsmith run campaign.toml
  swarmsmith run campaign.toml --budget 10_000 --workers 2 --store tonight.db
  swarmsmith run campaign.toml --workers slurm:16x64
  swarmsmith run first.toml second.toml)";

constexpr std::string_view kServeDetails =
    R"(Like run, but starts no workers: start them elsewhere with `swarmsmith worker`. Beyond loopback,
connections are encrypted and only listed keys may connect. `swarmsmith keygen` makes the keys;
docs/security.md explains them. While it runs, the coordinator's address is in STORE.coordinator.

Examples:
  swarmsmith serve campaign.toml
  swarmsmith serve campaign.toml --bind 0.0.0.0:5555
  swarmsmith serve campaign.toml --bind 0.0.0.0:5555 --keys thesis-keys --advertise login1)";

constexpr std::string_view kWorkerDetails =
    R"(Evaluates for a coordinator until the campaign is over. Workers can come and go at any time. SIGTERM
lets a worker finish its current evaluations. Starts the program swarmsmith-worker.

Examples:
  swarmsmith worker --connect 127.0.0.1:5555 --slots 4
  swarmsmith worker --coordinator thesis.db.coordinator
  swarmsmith worker --connect login1:5555 --key worker.key)";

constexpr std::string_view kKeygenDetails =
    R"(Makes a folder with the coordinator's key (server.key), a key for each role (worker.key,
operator.key, reader.key), and the list of clients (clients.toml). With --client it adds one key to
such a folder. It overwrites nothing. Only files of mode 0600 contain secrets.

Examples:
  swarmsmith keygen
  swarmsmith keygen thesis-keys
  swarmsmith keygen thesis-keys --client guest --role reader --expires 2027-01-31)";

constexpr std::string_view kPauseDetails =
    R"(Workers get no new evaluations of the designs; running ones end, and count. Designs stay paused until
you resume them, also when the coordinator restarts. The answer does not change.

Examples:
  swarmsmith pause demo.db
  swarmsmith pause d2 d3 demo.db)";

constexpr std::string_view kResumeDetails = R"(Examples:
  swarmsmith resume demo.db
  swarmsmith resume d2 demo.db)";

constexpr std::string_view kCancelDetails =
    R"(The design stops for good after the current step of its race, with its best candidate so far. Other
designs continue. The step is stored: if the campaign is run again, the design stops at the same step.

Example:
  swarmsmith cancel d2 demo.db)";

constexpr std::string_view kExtendDetails =
    R"(Continues a design from its end with further iterations, as soon as its race is over. The result differs
from a design with the larger budget from the start (docs/irace.md). If no coordinator runs, the designs
continue when the campaign is run again.

Example:
  swarmsmith extend d1 demo.db --budget 5_000 && swarmsmith run)";

constexpr std::string_view kForgiveDetails =
    R"(Lets workers in quarantine work again. They are there because their results were wrong, or because they
failed where others did not. `status` lists them, with the reason. Fix the host first: their first results
are checked like those of new workers, and one wrong result brings them back. The scores in the store stay
as they are.

Examples:
  swarmsmith forgive demo.db node7
  swarmsmith forgive demo.db 10.0.0.7)";

constexpr std::string_view kVerifyDetails =
    R"(Replays every race of the store from its scores, and compares candidates, tests, eliminations, budget
and winner with the stored ones. Checks the file itself. Evaluates a part of it again: all rejections
and 64 scores, or as many as --sample says. Exit code 0 when all is clean.

Examples:
  swarmsmith verify demo.db
  swarmsmith verify demo.db --sample 5_000)";

constexpr std::string_view kInitDetails = R"(Examples:
  swarmsmith init mine
  swarmsmith init mine --mission grid_exploration && swarmsmith run mine/campaign.toml)";

constexpr std::string_view kCheckDetails =
    R"(Reads the file, and prints all its errors (exit code 2) or the plan. Simulates for about half a second
to estimate how long the campaign will take on this machine.

Examples:
  swarmsmith check campaign.toml
  swarmsmith check campaign.toml --json)";

constexpr std::string_view kEvaluateDetails =
    R"(Simulates the machine once for each seed, in this process. A larger score is better, in every mission.
Scores of a store's candidates are stored, with the profile as their source. `best` stands for the
winners of the finished designs. --json prints one line per run: {"seed":1,"score":2}.

Examples:
  swarmsmith evaluate best demo.db
  swarmsmith evaluate best demo.db --profile pseudo-reality
  swarmsmith evaluate c812 demo.db --seeds 1-100 --no-store
  swarmsmith evaluate best.fsm
  swarmsmith evaluate best.fsm --mission my_mission.toml --profile my_rvr.toml
  swarmsmith evaluate --nstates 1 --s0 0 --rwm0 10 --flavour watermelon --mission grid_exploration
  swarmsmith evaluate --flavour watermelon-argos3 --profile argos3 --mission color_selection \
      --seeds 1-100 --starts starts.csv --patches patches.csv machine.fsm)";

constexpr std::string_view kAssessDetails =
    R"(Runs each behaviour 5 times and each condition 10 times with three robots for 120 s, and compares what
they do with what they promise. Then it compares how often conditions fired with their probability. Exit
code 0 when all modules pass, 1 when one fails. Under a profile with much noise some may fail; a line
says why. docs/assessment.md explains the measurements.

Examples:
  swarmsmith assess
  swarmsmith assess --flavour watermelon-argos3 --profile argos3
  swarmsmith assess --json)";

constexpr std::string_view kReplayDetails =
    R"(Simulates a stored evaluation again, and checks that score and final state have the stored bits; exit
code 1 when they differ. It can record the run: poses, commands, states and readings as CSV, a picture
as SVG (docs/trajectories.md).

Examples:
  swarmsmith replay e100001 demo.db
  swarmsmith replay e100001 demo.db --csv run.csv --readings ground_color,proximity
  swarmsmith replay c1 demo.db --seed 7 --svg run.svg
  swarmsmith replay c1 demo.db --seed 7 --svg - --at 60 > minute.svg
  swarmsmith replay --sample 100 demo.db)";

constexpr std::string_view kProfileDetails =
    R"(Prints a built-in profile as a commented file, to edit and to name in a campaign file: profile =
"my_rvr.toml". For a file of your own it prints all settings, including those of its base. Without a
name it lists the built-in profiles.

Examples:
  swarmsmith profile
  swarmsmith profile pseudo-reality
  swarmsmith profile rvr -o my_rvr.toml
  swarmsmith profile my_rvr.toml)";

constexpr std::string_view kFlavourDetails =
    R"(Prints a built-in flavour as a commented file, to edit and to name in a campaign file (flavour =
"mine.toml") or after --flavour. For a file of your own it prints everything, including what its
base has. Without a name it lists the built-in flavours. docs/flavours.md explains the file.

Examples:
  swarmsmith flavour
  swarmsmith flavour chocolate -o mine.toml
  swarmsmith flavour mine.toml)";

constexpr std::string_view kStatusDetails =
    R"(Asks the running coordinator for campaigns, idle slots and their reasons, designs, and hosts, the worst
first. If no coordinator is known, it reads the store. On a terminal --watch redraws one screen until
Ctrl-C or the end; elsewhere it writes a line every 5 s. docs/observability.md explains the numbers.

Examples:
  swarmsmith status demo.db
  swarmsmith status --connect 127.0.0.1:5555 --watch
  SWARMSMITH_STORE=demo.db swarmsmith status --watch)";

constexpr std::string_view kExplainDetails =
    R"(For an evaluation: which race asked for it and whether it counted, who evaluated it, what went wrong
before (lost, expired, failed, other results), and how to simulate it again. For a design: how its winner
came about, part by part of its search.

Examples:
  swarmsmith explain e1000007 demo.db
  swarmsmith explain d1 demo.db
  swarmsmith explain e1000007 demo.db --json)";

constexpr std::string_view kDashboardDetails =
    R"(Serves pages about the stores: campaigns, races, machines, runs that are simulated again, results,
SQL. `run` and `serve` have the same pages while a campaign runs. Here any store will do: finished,
merged, imported, or of a campaign that runs elsewhere. It shows them to you alone, on this host; from
another one, use ssh -L (docs/dashboard.md).

Examples:
  swarmsmith dashboard demo.db
  swarmsmith dashboard first.db second.db --http 127.0.0.1:9000
  swarmsmith dashboard demo.db --export demo.html --design d1)";

constexpr std::string_view kLsDetails =
    R"(Conditions and order are SQL over the columns. --json shows all columns. `ls flavours` and
`ls robots` list what is built in, and need no store.

Examples:
  swarmsmith ls designs demo.db
  swarmsmith ls candidates demo.db --where "n_states = 2 AND mean > 2.5" --sort "mean DESC" --limit 10
  swarmsmith ls evaluations demo.db --where "status <> 'ok'" --json
  swarmsmith ls flavours
  swarmsmith ls robots)";

constexpr std::string_view kShowDetails = R"(Examples:
  swarmsmith show d1 demo.db
  swarmsmith show c812 demo.db --json)";

constexpr std::string_view kQueryDetails =
    R"(Statements may only read. Without a statement it lists the views, the store's public schema
(docs/storage.md). Ids are numbers here: design 3, candidate 812.

Examples:
  swarmsmith query demo.db
  swarmsmith query "SELECT * FROM v_leaderboard" demo.db
  swarmsmith query "SELECT seed, score FROM v_design_scores" demo.db --csv > scores.csv)";

constexpr std::string_view kFigureDetails =
    R"(The file's extension selects the format: a picture (.svg; .pdf and .png with librsvg2-bin; .tex for
machines), or its numbers (.csv). docs/figures.md explains each kind.

Examples:
  swarmsmith figure box thesis.db -o performance.pdf
  swarmsmith figure modules thesis.db --method watermelon --width 175mm -o modules.svg
  swarmsmith figure convergence thesis.db --mission aggregation > convergence.svg
  swarmsmith figure scores thesis.db -o scores.csv)";
constexpr std::string_view kCompareDetails =
    R"(Summarises and tests the scores of the designs' winners outside of the race. By source, it compares the
same designs in simulation and reality (signed-rank); by method, designs of one mission and source
(rank-sum); over missions, ranks (Friedman). It leaves out comparisons that make no sense.
docs/statistics.md has the formulas.

Examples:
  swarmsmith compare thesis.db
  swarmsmith compare thesis.db --by method --mission aggregation
  swarmsmith compare thesis.db --by mission
  swarmsmith compare thesis.db --csv > p-values.csv)";

constexpr std::string_view kExportDetails =
    R"(`evaluate` and AutoMoDe's programs read the text form; its lines with # name the machine. With --format
irace a campaign, from its file or its store, becomes a folder of irace's files: `irace --scenario
scenario.txt` runs one of its designs there, with this simulator behind the target-runner. Pictures
show states and conditions with their parameters (docs/machines.md); PDF needs rsvg-convert. With
--format argos each machine becomes a file for the ARGoS of the thesis.

Examples:
  swarmsmith export demo.db -o best.fsm
  swarmsmith export demo.db --design d1 --format svg --width 174mm -o best.svg
  swarmsmith export demo.db --what elites --format json
  swarmsmith export campaign.toml --format irace --design d1 -o folder)";

constexpr std::string_view kImportDetails =
    R"(Without --into: turns a scenario of irace, with the files that it names, into a campaign file that runs
the same race. `swarmsmith irace` runs a scenario directly.

With --into: imports results into a store, all or nothing. Importing again changes nothing.
  scores    CSV with score (or cost), who (candidate, design, fsm_id, or mission, method, repetition), and
            source, seed, instance, time, note
  machines  one text per line, or CSV with fsm (or fsm_config), fsm_id, mission, method
  logs      irace.Rdata (needs Rscript), or the folder of its tables

Examples:
  swarmsmith import scenario.txt -o campaign.toml
  swarmsmith import robots.csv --source real --into demo.db
  swarmsmith import machines.txt --flavour watermelon-argos3 --mission aggregation --into theirs.db
  swarmsmith import irace.Rdata --into tuning.db)";

constexpr std::string_view kReportDetails =
    R"(Writes the question, results, statistics, one chapter per design with its machine and its race, and the
provenance: one HTML file without scripts that opens offline and prints. docs/report.md lists its parts.

Examples:
  swarmsmith report demo.db
  swarmsmith report demo.db -o thesis.html --design d1 --design d3)";

constexpr std::string_view kSupplementDetails =
    R"(Writes a new folder to publish beside a paper: all scores, controllers as text, JSON and drawings,
figures with their numbers, the report, campaign file, a README and checksums. The same store gives the
same bytes. docs/report.md lists its parts.

Example:
  swarmsmith supplement thesis.db -o supplement && cd supplement && sha256sum -c SHA256SUMS)";

constexpr std::string_view kDigestDetails =
    R"(Prints one hash over all that is part of the answer. Two stores of one campaign have the same hash, for
any number of workers and any history of crashes.

Example:
  swarmsmith digest demo.db)";

constexpr std::string_view kBackupDetails =
    R"(Makes a complete copy of the store as it is now, also while a campaign runs, and checks it. It never
replaces another file. The copy has this program's schema: an old store is updated without touching it.

Examples:
  swarmsmith backup demo.db demo-monday.db
  swarmsmith backup thesis-2024.db thesis.db)";

constexpr std::string_view kMergeDetails =
    R"(Copies the campaigns of several stores into a new one, to read them together: figures, tables, queries.
Designs are numbered on from store to store (c3 of the second store, after one with two designs, is
c2000003). The answer of each campaign stays the same. The stores do not change. The new one is for
reading; campaigns continue in their own.

Examples:
  swarmsmith merge aggregation.db grid.db color.db -o thesis.db
  swarmsmith ls designs thesis.db)";

constexpr std::string_view kRecoverDetails =
    R"(Makes a new store from a damaged one: every whole row of every page that can be read, even without
the file's header. It leaves out scores that another program has changed, derives again what follows from
scores, and reports what is missing. Run the campaign on the new store: it evaluates what was lost, and
gives the same answer. Exit code 3 when changed values can be neither identified nor derived: the new
store then says that it is not reliable.

Examples:
  swarmsmith recover demo.db -o rescued.db && swarmsmith run --store rescued.db
  swarmsmith recover thesis.db -o rescued.db --campaign thesis.toml
  swarmsmith recover thesis.db -o honest.db --without-key node7 && swarmsmith serve thesis.toml --store honest.db)";

constexpr std::string_view kIraceDetails =
    R"(Replaces irace: it reads the same scenario, parameter, instance and configuration files, calls the same
target-runner, has the same options, and ends with the same report. It keeps everything in the store
that logFile names. After Ctrl-C, kill -9 or a failing target the same command continues, and gives
the same answer with any number of workers.

Examples:
  swarmsmith irace --init
  swarmsmith irace --check
  swarmsmith irace --scenario scenario.txt --max-experiments 1000 --seed 42 --parallel 8
  swarmsmith irace --only-test configurations.txt
  swarmsmith irace --psrace --psrace-max-experiments 200
  swarmsmith irace --ablation --ablation-csv ablation.csv
  swarmsmith irace -s scenario.txt | sed '1,/as commandlines/d')";

constexpr std::array kCommands = {
    ProgramCommand{"run", "Run or continue a campaign", kRunDetails, declare_run},
    ProgramCommand{"init", "Write a commented campaign file", kInitDetails, declare_init},
    ProgramCommand{"check", "Check a campaign file and show its plan", kCheckDetails,
                   declare_check},
    ProgramCommand{"profile", "Print a simulator profile, as a starting point", kProfileDetails,
                   declare_profile},
    ProgramCommand{"flavour", "Print a flavour, as a starting point", kFlavourDetails,
                   declare_flavour},
    ProgramCommand{"serve", "Run a campaign with workers on other hosts", kServeDetails,
                   declare_serve},
    ProgramCommand{"worker", "Evaluate for a coordinator", kWorkerDetails, declare_worker},
    ProgramCommand{"pause", "Pause a design or a campaign", kPauseDetails, declare_pause},
    ProgramCommand{"resume", "Resume paused designs", kResumeDetails, declare_resume},
    ProgramCommand{"cancel", "Stop a design after its current step", kCancelDetails,
                   declare_cancel},
    ProgramCommand{"extend", "Give a design more budget", kExtendDetails, declare_extend},
    ProgramCommand{"forgive", "Let workers in quarantine work again", kForgiveDetails,
                   declare_forgive},
    ProgramCommand{"keygen", "Make keys for coordinator, workers and people", kKeygenDetails,
                   declare_keygen},
    ProgramCommand{"irace", "Configure an algorithm from irace's files, as irace does",
                   kIraceDetails, nullptr, run_irace, nullptr, irace_declared},
    ProgramCommand{"status", "Show how far a campaign is", kStatusDetails, declare_status},
    ProgramCommand{"dashboard", "Show stores and campaigns in the browser", kDashboardDetails,
                   declare_dashboard},
    ProgramCommand{"ls",
                   "List designs, candidates, evaluations, elites, workers, flavours or robots",
                   kLsDetails, declare_ls},
    ProgramCommand{"show", "Show one design, candidate or evaluation", kShowDetails, declare_show},
    ProgramCommand{"explain", "Show the history of one evaluation or one design", kExplainDetails,
                   declare_explain},
    ProgramCommand{"query", "Ask a store in SQL", kQueryDetails, declare_query},
    ProgramCommand{"compare", "Compare sources or methods by statistical tests", kCompareDetails,
                   declare_compare},
    ProgramCommand{"evaluate", "Score a machine, tree or network outside of a race",
                   kEvaluateDetails, declare_evaluate, nullptr, with_machine_as_one_word},
    ProgramCommand{"assess", "Test whether each module does what it promises", kAssessDetails,
                   declare_assess},
    ProgramCommand{"replay", "Simulate a stored evaluation again, and record it", kReplayDetails,
                   declare_replay},
    ProgramCommand{"figure", "Draw a figure from a store: SVG, PDF, PNG, CSV or TeX",
                   kFigureDetails, declare_figure},
    ProgramCommand{"export", "Write machines of a store", kExportDetails, declare_export},
    ProgramCommand{"import", "Import scenarios, scores, machines and logs", kImportDetails,
                   declare_import},
    ProgramCommand{"report", "Write the contents of a store as one HTML file", kReportDetails,
                   declare_report},
    ProgramCommand{"supplement", "Write a folder of files to publish beside a paper",
                   kSupplementDetails, declare_supplement},
    ProgramCommand{"digest", "Print the digest of a store's answer", kDigestDetails,
                   declare_digest},
    ProgramCommand{"verify", "Check a store: replay its races, evaluate a sample", kVerifyDetails,
                   declare_verify},
    ProgramCommand{"backup", "Copy a store, also while a campaign runs", kBackupDetails,
                   declare_backup},
    ProgramCommand{"merge", "Merge several stores into a new one, for reading", kMergeDetails,
                   declare_merge},
    ProgramCommand{"recover", "Make a new store from a damaged one", kRecoverDetails,
                   declare_recover},
    ProgramCommand{"robot", "Run machines on real robots", "", nullptr, run_robot},
    ProgramCommand{"track", "Score runs of real robots, filmed from above", "", nullptr, run_track},
    ProgramCommand{"version", "Print the version", "", declare_version},
};

}  // namespace

std::span<const ProgramCommand> commands() {
  return kCommands;
}

ExitCode run_program(const std::vector<std::string>& arguments, Output& output) {
  const Program program{"swarmsmith", "Designs control software for robot swarms.", kCommands,
                        "Start with `swarmsmith run` (a demo) or `swarmsmith init`.", offer_stored};
  return run_program(program, arguments, output);
}

}  // namespace swarmsmith::cli
