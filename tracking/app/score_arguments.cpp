#include "tracking/app/score_arguments.h"

#include "base/suggestion.h"
#include "sim/files/mission_file.h"

namespace swarmsmith {

std::string store_word(const std::string& option) {
  return option.empty() ? store_of_environment() : option;
}

void StartArguments::declare(Options& options) {
  constexpr Options::Range kTags{0, 65'535};
  options.text("--start TIME", start, "Start of the run on the clock of the first video: 12.4 s");
  options.integer("--sync-hidden", sync_hidden, kTags, "The run starts when this tag is covered");
  options.integer("--sync-shown", sync_shown, kTags, "The run starts when this tag is uncovered");
}

void ScoreArguments::declare(Options& options) {
  options.words(
      "VIDEO FILE", videos,
      "Videos, folders of images or bags, one per camera (default: those of the run log)");
  options.text("--arena FILE", arena, "Arena file", Options::Need::Required);
  options.text("--run FILE", run, "Run log; options override it");
  options.text("--mission MISSION|FILE", mission,
               joined(mission_names()) + " or a file (default: the design's)");
  options.text("--design DESIGN", design, "Design of the store whose winner ran: d3");
  options.text("--candidate CANDIDATE", candidate, "Candidate of the store that ran: c812");
  begin.declare(options);
  options.text("--patches FILE", patches,
               "Colour patches of the run: a CSV with seed,x,y,color of one seed; or `measured`, "
               "from the picture");
  options.texts("--times FILE", times,
                "CSV with a time for each frame, one per video: frame,time_s");
  options.text("--name NAME", name, "Name of the run (default: the log's, else the video's)");
  options.text("--recorded DATE", recorded, "Date of the run, 2026-11-21");
  options.flag("--accept-tag-as-centre", takes_tags_for_centres,
               "Score robots without an offset calibration, which marks the score BIASED");
  options.text("--into STORE", into, "Store for the run; created if needed");
  options.text("--store STORE", store, "The same for an existing store (else SWARMSMITH_STORE)");
  options.text("--csv FILE", csv,
               "Write the trajectory: cycle,time_s,robot,x,y,theta (docs/trajectories.md)");
  options.flag("--checks", all_checks,
               "List all checks of the run: number, limit, what each catches");
  options.text("--report FILE", report, "Write the quality report, a page of HTML");
}

}  // namespace swarmsmith
