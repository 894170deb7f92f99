#include "cli/dashboard/run_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

#include "analysis/arena/reading_columns.h"
#include "base/base64.h"
#include "base/overloaded.h"
#include "cli/arguments/thing_id.h"
#include "cli/replay/real_replay.h"
#include "cli/replay/recording.h"
#include "cli/replay/stored_runs.h"
#include "sim/files/profile_file.h"
#include "sim/mission/score.h"

namespace swarmsmith::cli {
namespace {

/// The run that the id names.
struct RunName {
  ThingId id;
  std::int64_t seed = 0;  ///< of a candidate, or of a simulation beside a real run; else 0
  std::string profile;    ///< used instead of the candidate's own profile; empty: its own
};

/// "7" as a seed; 0 if the text is not a seed.
std::int64_t seed_of(std::string_view text) {
  std::int64_t seed = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  const bool good = error == std::errc() && stop == text.data() + text.size();
  return good && seed >= 1 && seed <= 2'147'483'647 ? seed : 0;
}

Expected<RunName> name_of_run(const std::string& text) {
  const std::size_t at = std::min(text.find('@'), text.size());
  const std::size_t dash = std::min(text.find('-'), at);
  const auto id = parse_thing_id(text.substr(0, dash));
  RunName name;
  if (id) name.id = *id;
  if (dash < at) name.seed = seed_of(std::string_view(text).substr(dash + 1, at - dash - 1));
  if (at < text.size()) name.profile = text.substr(at + 1);
  const char letter = id ? id->letter : ' ';
  const bool has_seed = name.seed > 0;
  const bool good = (letter == 'e' && dash == text.size()) || (letter == 'c' && has_seed) ||
                    (letter == 'r' && has_seed == (dash < at));
  const bool good_profile = at == text.size() || (letter == 'c' && !name.profile.empty());
  if (good && good_profile) return name;
  return bad_input(
      "must be an evaluation (e81200007), a candidate with a seed (c812-7) and perhaps a profile "
      "(c812-7@pseudo-reality), a real run (r7), or a simulation beside it (r7-1)",
      text);
}

Expected<StoredRun> find_run(const Question& question, const RunName& name) {
  // Each run has its own reader.
  auto reader = StoreReader::open(question.file);
  if (!reader) return Unexpected(reader.error());
  if (name.id.letter == 'r')
    return simulation_beside(std::move(*reader), RealRunId{std::stoll(name.id.digits)}, name.seed);
  auto runs = StoredRuns::open(std::move(*reader));
  if (!runs) return Unexpected(runs.error());
  if (name.id.letter == 'e') return runs->evaluation(name.id);
  return runs->candidate(name.id, name.seed, name.profile);
}

Expected<RealReplay> find_real_run(const Question& question, const RunName& name) {
  auto reader = StoreReader::open(question.file);
  if (!reader) return Unexpected(reader.error());
  return replay_real_run(std::move(*reader), RealRunId{std::stoll(name.id.digits)}, {});
}

std::string hex(std::uint64_t digest) {
  return fmt::format("{:016x}", digest);
}

/// Browsers use other colours for the same names.
std::string css_color(Rgb color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b);
}

JsonPiece place(Point point) {
  return {"[" + json_number(point.x) + "," + json_number(point.y) + "]"};
}

JsonPiece places(const std::vector<Point>& points) {
  return json_list(points, place);
}

/// Counter-clockwise, from the lower left.
std::vector<Point> corners_of(const Rectangle& area) {
  const double x = area.width_m / 2;
  const double y = area.height_m / 2;
  const Point c = area.centre;
  return {{c.x - x, c.y - y}, {c.x + x, c.y - y}, {c.x + x, c.y + y}, {c.x - x, c.y + y}};
}

/// In the object's own frame: a disc or a polygon.
JsonObject outline_json(const Outline& outline) {
  JsonObject object;
  std::visit(
      Overloaded{
          [&](const CircleOutline& circle) { object.add("radius_m", circle.radius_m); },
          [&](const BoxOutline& box) {
            object.add("corners", places(corners_of(Rectangle{{}, box.length_m, box.width_m})));
          },
          [&](const PolygonOutline& polygon) { object.add("corners", places(polygon.corners)); }},
      outline);
  return object;
}

JsonObject patch_json(const Patch& patch) {
  JsonObject object;
  std::visit(
      Overloaded{
          [&](const Disc& disc) {
            object.add("color", css_color(patch.color))
                .add("centre", place(disc.centre))
                .add("radius_m", disc.radius_m);
          },
          [&](const Rectangle& area) {
            object.add("color", css_color(patch.color)).add("corners", places(corners_of(area)));
          },
          [&](const FloorImage& image) {
            object.add("corners", places(corners_of(image.area)))
                .add("image", "data:image/png;base64," + base64_text(image.picture->png()));
          }},
      patch.shape);
  return object;
}

JsonObject arena_json(const Arena& arena) {
  return std::move(JsonObject()
                       .add("walls", places(swarmsmith::corners_of(arena)))
                       .add("floor", css_color(arena.floor))
                       .add("patches", json_list(arena.patches, patch_json))
                       .add("obstacles", json_list(arena.obstacles,
                                                   [](const Obstacle& obstacle) {
                                                     return outline_json(obstacle.outline)
                                                         .add("x_m", obstacle.pose.x)
                                                         .add("y_m", obstacle.pose.y)
                                                         .add("theta_rad", obstacle.pose.theta);
                                                   }))
                       .add("lights", json_list(arena.lights, [](const Light& light) {
                              return JsonObject()
                                  .add("x_m", light.x_m)
                                  .add("y_m", light.y_m)
                                  .add("z_m", light.z_m)
                                  .add("intensity_cd", light.intensity_cd);
                            })));
}

/// Poses in whole millimetres and milliradians, one array per column.
class Track {
 public:
  void add(const Pose& pose) {
    put(x_, pose.x);
    put(y_, pose.y);
    put(theta_, pose.theta);
  }
  /// For cycles without a known pose.
  void add_nothing() {
    for (std::string* column : {&x_, &y_, &theta_})
      *column += column->empty() ? "null" : ",null";
  }
  JsonObject json() const {
    return std::move(JsonObject()
                         .add("x_mm", JsonPiece{"[" + x_ + "]"})
                         .add("y_mm", JsonPiece{"[" + y_ + "]"})
                         .add("theta_mrad", JsonPiece{"[" + theta_ + "]"}));
  }

 private:
  static void put(std::string& column, double value) {
    if (!column.empty()) column += ',';
    column += std::to_string(std::llround(value * 1000));
  }

  std::string x_;
  std::string y_;
  std::string theta_;
};

/// [[cycle, value], ...]: the value holds from that cycle on.
class Changes {
 public:
  void add(int cycle, const std::string& json) {
    if (json == last_) return;
    last_ = json;
    text_ += (text_.empty() ? "[" : ",[") + std::to_string(cycle) + "," + json + "]";
    ++count_;
  }
  JsonPiece json() const { return {"[" + text_ + "]"}; }
  int count() const { return count_; }
  const std::string& last() const { return last_; }

 private:
  std::string last_;
  std::string text_;
  int count_ = 0;
};

/// One colour for a robot's lights: the common colour, else the first light that is on.
std::string light_of(const Leds& leds) {
  const std::string all = leds_text(leds);
  constexpr std::size_t kOne = 7;  // "#00ff00"
  for (std::size_t at = 0; at + kOne <= all.size(); at += kOne + 1) {
    const std::string color = all.substr(at, kOne);
    if (color != "#000000") return color;
  }
  return all.substr(0, kOne);
}

struct RobotColumns {
  Track track{};
  Changes states{};
  Changes leds{};
  Changes kinds{};
  std::string name{};

  JsonObject json() const {
    JsonObject object = track.json();
    object.add("state", states.json());
    if (leds.count() > 1 || (leds.count() == 1 && leds.last() != "\"#000000\""))
      object.add("leds", leds.json());
    if (kinds.count() > 0) object.add("kind", kinds.json());
    if (!name.empty()) object.add("name", name);
    return object;
  }
};

/// The score up to each cycle; there is none at the start.
class RunningScore {
 public:
  RunningScore(const Mission& mission, const Arena& arena) : scorer_(mission.rule, arena) {}

  void start() { text_ = "null"; }
  void observe(const std::vector<Point>& robots, const std::vector<Point>& objects) {
    scorer_.observe(robots, objects);
    text_ += "," + json_number(scorer_.score() + 0.0);
  }
  JsonPiece json() const { return {"[" + text_ + "]"}; }

 private:
  Scorer scorer_;
  std::string text_;
};

template <class T>
JsonPiece json_of_each(const std::vector<T>& items) {
  return json_list(items, [](const T& item) { return item.json(); });
}

JsonPiece objects_json(const std::vector<Track>& tracks, const Arena& arena) {
  std::string text;
  for (std::size_t i = 0; i < tracks.size(); ++i)
    text += (i == 0 ? "" : ",") +
            tracks[i].json().add("outline", outline_json(arena.objects[i].outline)).text();
  return {"[" + text + "]"};
}

Answer simulated_answer(const Question& question, const StoredRun& run) {
  const Arena arena = arena_of(run.mission, run.instance);
  std::vector<RobotColumns> robots(run.instance.starts.size());
  std::vector<Track> objects(arena.objects.size());
  RunningScore score(run.mission, arena);
  int cycles = 0;
  int most_state = 0;
  const auto observe = [&](const Snapshot& snapshot) {
    cycles = snapshot.cycle;
    std::vector<Point> places_of_robots;
    std::vector<Point> places_of_objects;
    for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
      const RobotRecord& record = snapshot.robots[i];
      robots[i].track.add(record.pose);
      robots[i].states.add(cycles, std::to_string(record.state));
      robots[i].leds.add(cycles, json_text(light_of(record.command.leds)));
      most_state = std::max(most_state, record.state);
      places_of_robots.push_back(record.pose.position());
    }
    for (std::size_t i = 0; i < snapshot.objects.size(); ++i) {
      objects[i].add(snapshot.objects[i]);
      places_of_objects.push_back(snapshot.objects[i].position());
    }
    cycles == 0 ? score.start() : score.observe(places_of_robots, places_of_objects);
  };
  const Measured result = simulate(run.setup(), Recorder(observe));
  std::vector<std::string> behaviours;
  for (int state = 0; state <= most_state; ++state)
    behaviours.emplace_back(acting_in(run.controller, state));
  const auto candidate = parse_thing_id(run.candidate);
  const bool known = run.outcome.has_value();
  return json_answer(
      answer_object()
          .add("id", question.id)
          .add("evaluation", run.id.empty() ? std::nullopt : std::optional(run.id))
          .add("candidate", run.candidate)
          .add("design",
               candidate ? std::optional(to_string(design_of_thing(*candidate))) : std::nullopt)
          .add("mission", run.mission.name)
          .add("source", run.profile.name)
          .add("seed", run.seed)
          .add("score", result.score)
          .add("stored_score", known ? std::optional(run.outcome->score) : std::nullopt)
          .add("same_bits", known ? std::optional(same_bits(*run.outcome, result)) : std::nullopt)
          .add("digest", hex(result.state_digest))
          .add("stored_digest",
               known ? std::optional(hex(run.outcome->state_digest)) : std::nullopt)
          .add("engine", engine_version_of(run.mission, run.profile))
          .add("stored_engine", run.engine_version)
          .add("rejected", run.rejected)
          .add("profiles", profiles_of(run.mission.robot))
          .add("unit", unit_of(run.mission.rule))
          .add("arena", arena_json(arena))
          .add("body", outline_json(run.mission.robot.body.outline))
          .add("cycles", cycles)
          .add("robots", json_of_each(robots))
          .add("objects", objects_json(objects, arena))
          .add("behaviours", behaviours)
          .add("score_at", score.json()),
      // The store may get a result for this run later.
      known);
}

/// The names are in the order of CycleKind in tracking.
std::string kind_of_pose(std::int64_t kind) {
  constexpr std::array<const char*, 4> kKinds{"measured", "interpolated", "degraded", "missing"};
  return kind < 0 || kind > 3 ? "" : kKinds.at(static_cast<std::size_t>(kind));
}

/// null: the run was scored by a version without checks.
JsonPiece checks_json(const RealRunRows& rows) {
  if (rows.checks.empty()) return {"null"};
  return json_list(rows.checks, [](const RealCheckRow& check) {
    return JsonObject()
        .add("name", check.name)
        .add("subject", check.subject)
        .add("outcome", check.outcome)
        .add("value", check.value)
        .add("limit", check.limit)
        .add("unit", check.unit)
        .add("catches", check.catches)
        .add("reason", check.reason);
  });
}

Answer real_answer(const Question& question, const RealReplay& replay) {
  const ShownRun& run = replay.runs.front();
  const Mission& mission = replay.filmed.mission;
  const Arena arena = arena_of(mission, run.instance);
  const std::size_t count = run.robots.size();
  const std::size_t instants = count == 0 ? 0 : run.robots.front().size();
  std::vector<RobotColumns> robots(count);
  RunningScore score(mission, arena);
  for (std::size_t cycle = 0; cycle < instants; ++cycle) {
    std::vector<Point> here;
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t kind = replay.rows.cycles[cycle * count + i].kind;
      const Pose& pose = run.robots[i][cycle];
      kind == 3 ? robots[i].track.add_nothing() : robots[i].track.add(pose);
      robots[i].kinds.add(static_cast<int>(cycle), json_text(kind_of_pose(kind)));
      here.push_back(pose.position());
    }
    cycle == 0 ? score.start() : score.observe(here, {});
  }
  for (std::size_t i = 0; i < count; ++i)
    robots[i].name = run.labels[i];
  const auto& stored = replay.rows.score.score;
  const CandidateId candidate = replay.rows.candidate;
  const ThingId machine{.letter = 'c', .digits = std::to_string(candidate.value), .purpose = {}};
  return json_answer(
      answer_object()
          .add("id", question.id)
          .add("name", replay.rows.name)
          .add("recorded", replay.rows.recorded)
          .add("candidate", candidate)
          .add("design",
               candidate ? std::optional(to_string(design_of_thing(machine))) : std::nullopt)
          .add("mission", mission.name)
          .add("source", run.source)
          .add("seed", JsonPiece{"null"})
          .add("score", replay.score)
          .add("stored_score", stored)
          .add("same_bits", stored ? std::optional(*stored == replay.score) : std::nullopt)
          .add("digest", JsonPiece{"null"})
          .add("stored_digest", JsonPiece{"null"})
          .add("engine", kEngineVersion)
          .add("verdict", replay.verdict)
          .add("checks", checks_json(replay.rows))
          .add("unit", unit_of(mission.rule))
          .add("arena", arena_json(arena))
          .add("body", outline_json(mission.robot.body.outline))
          .add("cycles", instants == 0 ? 0 : instants - 1)
          .add("robots", json_of_each(robots))
          .add("objects", JsonPiece{"[]"})
          .add("behaviours", JsonPiece{"[]"})
          .add("score_at", score.json()));
}

}  // namespace

Expected<Answer> trajectory_answer(const Question& question) {
  const auto name = name_of_run(question.id);
  if (!name) return Unexpected(name.error());
  if (name->id.letter == 'r' && name->seed == 0) {
    const auto replay = find_real_run(question, *name);
    if (!replay) return Unexpected(replay.error());
    return real_answer(question, *replay);
  }
  const auto run = find_run(question, *name);
  if (run) return simulated_answer(question, *run);
  // The run is in the store, but it cannot be simulated. This is not an error.
  if (run.error().kind != ErrorKind::BadInput || run.error().where == name->profile)
    return Unexpected(run.error());
  return json_answer(answer_object().add("nothing", to_string(run.error())));
}

Expected<Answer> trajectory_csv_answer(const Question& question) {
  const auto name = name_of_run(question.id);
  if (!name) return Unexpected(name.error());
  if (name->id.letter == 'r' && name->seed == 0) {
    const auto replay = find_real_run(question, *name);
    if (!replay) return Unexpected(replay.error());
    return Answer{.type = kCsvType,
                  .body = table_of(*replay, RealRunId{std::stoll(name->id.digits)})};
  }
  const auto run = find_run(question, *name);
  if (!run) return Unexpected(run.error());
  std::ostringstream table;
  std::ostringstream unused;
  Output output{.out = table, .err = unused};
  RecordingArguments arguments;
  arguments.csv = "-";
  auto recording = Recording::start(arguments, run->mission, run->controller, output);
  if (!recording) return Unexpected(recording.error());
  simulate(run->setup(), recording->recorder());
  if (auto finished = recording->finish({}, run->instance); !finished)
    return Unexpected(finished.error());
  return Answer{.type = kCsvType, .body = table.str(), .is_final = true};
}

}  // namespace swarmsmith::cli
