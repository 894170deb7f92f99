#include "tracking/profile/lab_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "base/plain_text.h"
#include "base/text/toml_text.h"
#include "tracking/robots/delays.h"

namespace swarmsmith {
namespace {

/// Delays in a profile are multiples of this.
constexpr double kStep_ms = 10;
/// The simulator controls the treads at the ends of its steps, so each delay already includes half
/// a step.
constexpr double kHalfStep_ms = kStep_ms / 2;
/// A control period that differs from 100 ms by less than `kLeastPeriodOff_ms` counts as 100 ms.
constexpr double kNominal_ms = 100;
constexpr double kLeastPeriodOff_ms = 0.5;
/// The largest number of robots' reasons that the file gives for a missing figure.
constexpr std::size_t kReasons = 3;
/// Smallest number of single commands whose delays give the latency: of all robots, and of one
/// robot; and the number from which they also give the distribution of the delay.
constexpr std::size_t kLeastDelays = 10;
constexpr std::size_t kLeastOfOne = 3;
constexpr std::size_t kLeastOfLaw = 30;
/// Lower bound of the standard error, because three delays may agree by chance; and the scatter
/// from which the distribution is given.
constexpr double kLeastError_s = 0.001;
constexpr double kLeastScatter_s = 0.015;

/// Rounds for readability; the profile loses nothing, since its errors are larger.
double rounded(double value, double digits) {
  return std::round(value * digits) / digits;
}

/// The figures of robots that have one, and the reasons of the others.
struct Told {
  std::vector<Estimate> estimates;
  std::vector<std::string> reasons;
  std::set<std::string> runs;
  std::set<std::string> robots;

  void add(const MeasuredRobot& of, std::optional<Estimate> estimate, const std::string& reason) {
    if (!estimate) {
      reasons.push_back(of.run + ", " + of.robot + ": " + reason);
      return;
    }
    estimates.push_back(*estimate);
    runs.insert(of.run);
    robots.insert(of.robot);
  }
};

class Writer {
 public:
  explicit Writer(const LabSource& source) : source_(source) {}

  LabProfile write() {
    head();
    LabProfile profile;
    std::string body = neighbours();
    body += timing();
    body += treads();
    profile.figures = std::move(figures_);
    profile.text = std::move(text_) + body + foot();
    return profile;
  }

 private:
  using Tell = std::function<void(const MeasuredRobot&, Told&)>;

  void head() {
    std::set<std::string> runs;
    std::set<std::string> names;
    for (const MeasuredRobot& robot : source_.robots) {
      runs.insert(robot.run);
      names.insert(robot.robot);
    }
    text_ = fmt::format(
        "# A profile of the simulator that {} measured on {} ({}) in {} ({}).\n"
        "# Numbers in brackets are 95 % intervals of the mean. `spread` is the standard deviation\n"
        "# between robots and runs, beyond what the errors of single runs explain. The\n"
        "# rest is as in the profile `{}`.\n"
        "format = 1\nbase   = {}\n",
        source_.program, counted(names.size(), "robot"), fmt::format("{}", fmt::join(names, ", ")),
        counted(runs.size(), "run"), fmt::format("{}", fmt::join(runs, ", ")), source_.base,
        quoted_text(source_.base));
  }

  Told collect(const Tell& tell) const {
    Told told;
    for (const MeasuredRobot& robot : source_.robots)
      tell(robot, told);
    return told;
  }

  static std::string count_text(const Told& told) {
    std::string text =
        "of " + counted(told.robots.size(), "robot") + " in " + counted(told.runs.size(), "run");
    if (!told.reasons.empty()) text += fmt::format(" ({} without a result)", told.reasons.size());
    return text;
  }

  /// The comment on a measured figure.
  static std::string comment(const std::string& name, const Pooled& value, const Told& told,
                             double factor, const std::string& unit) {
    return fmt::format("# {}: {:.1f} {} [{:.1f}, {:.1f}], spread {:.1f} {}; {}\n", name,
                       factor * value.mean, unit, factor * value.low, factor * value.high,
                       factor * value.spread, unit, count_text(told));
  }

  /// The comment on a figure that could not be measured; also adds the figure.
  std::string left(const std::string& name, const Told& told, const std::string& unit) {
    std::string reason = "no robot's runs show it";
    for (std::size_t i = 0; i < std::min(told.reasons.size(), kReasons); ++i)
      reason += (i == 0 ? ": " : "; ") + told.reasons[i];
    if (told.reasons.size() > kReasons)
      reason += fmt::format("; and {} more", told.reasons.size() - kReasons);
    figures_.push_back({name, {}, unit, {}, reason});
    return fmt::format("# {}: as in `{}`, because {}\n", name, source_.base, reason);
  }

  std::string neighbours() {
    const Told told = collect([](const MeasuredRobot& of, Told& into) {
      const NeighboursSeen& seen = of.reality.neighbours;
      into.add(
          of, seen.is_told() ? std::optional(Estimate{seen.miss_rate(), seen.error}) : std::nullopt,
          seen.reason);
    });
    const std::string name = "neighbours missed";
    std::string text = "\n[neighbours]\n";
    if (told.estimates.empty()) return text + left(name, told, "%");
    std::int64_t there = 0;
    std::int64_t phantoms = 0;
    for (const MeasuredRobot& robot : source_.robots) {
      there += robot.reality.neighbours.there;
      phantoms += robot.reality.neighbours.phantoms;
    }
    Pooled all = pooled(told.estimates);
    all.low = std::max(all.low, 0.0);
    all.high = std::min(all.high, 1.0);
    figures_.push_back({name, all, "%", count_text(told), {}});
    text += comment(name, all, told, 100, "%");
    text += fmt::format(
        "# Counted: {} robots in reach, in single control cycles. In {} a log has a\n"
        "# neighbour where no robot was; profiles cannot contain such neighbours.\n",
        there, counted(phantoms, "more cycle"));
    const Groups groups = grouped(told.estimates);
    const auto rate = [](std::span<const Estimate> rates) {
      return number_text(rounded(std::clamp(pooled(rates).mean, 0.0, 1.0), 1e4));
    };
    text += "miss_rate      = " + rate(groups.usual) + "\n";
    if (groups.weak.empty()) return text + "weak_share     = 0\nweak_miss_rate = 0\n";
    const double share =
        static_cast<double>(groups.weak.size()) / static_cast<double>(told.estimates.size());
    text += fmt::format("# {} of {} robots in a run missed many neighbours during the whole run.\n",
                        groups.weak.size(), told.estimates.size());
    return text + "weak_share     = " + number_text(rounded(share, 1e4)) +
           "\nweak_miss_rate = " + rate(groups.weak) + "\n";
  }

  /// The latency from single commands that changed the turning speed; empty if there are too few.
  std::string latency_of_changes() {
    std::vector<double> delays_s;
    double squares = 0;
    const Told told = collect([&](const MeasuredRobot& of, Told& into) {
      const std::vector<double>& own = of.reality.delays_s;
      const Estimate mean = mean_of(own);
      for (const double one : own)
        squares += (one - mean.value) * (one - mean.value);  // robots may differ
      delays_s.insert(delays_s.end(), own.begin(), own.end());
      into.add(of, own.size() < kLeastOfOne ? std::nullopt : std::optional(mean),
               "too few of its commands changed the turning");
    });
    if (delays_s.size() < kLeastDelays || told.estimates.empty()) return {};
    const double scatter_s = std::sqrt(squares / static_cast<double>(delays_s.size()));
    Pooled all = pooled(told.estimates);
    std::vector<DrawnDelay> drawn;
    if (scatter_s >= kLeastScatter_s) {
      drawn = drawn_delays(delays_s, kNominal_ms / 1000);
      double mean_s = 0;
      for (const DrawnDelay& delay : drawn)
        mean_s += delay.seconds * delay.probability;
      // Late commands also delay the commands after them; this is subtracted.
      const double later_s = all.mean - mean_s;
      for (double* value : {&all.mean, &all.low, &all.high})
        *value -= later_s;
    }
    figures_.push_back({"latency", all, "ms", count_text(told), {}});
    std::string text = comment("latency", all, told, 1000, "ms");
    text += fmt::format(
        "# From command to treads, by {} changes of the turning, which scatter by {:.1f} ms "
        "within\n# robots. The latency of the simulator's own treads is subtracted.\n",
        delays_s.size(), 1000 * scatter_s);
    if (drawn.empty() || delays_s.size() < kLeastOfLaw) return text + delays_of_mean(all, 0);
    text += "# Late commands also delay the next ones; this is subtracted.\ndelays = [\n";
    double left = 1;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const bool is_last = i + 1 == drawn.size();
      const double share = rounded(is_last ? left : drawn[i].probability, 1e4);
      left -= share;
      text += "  " + delay_text(1000 * drawn[i].seconds, share) + ",\n";
    }
    return text + "]\n";
  }

  static Estimate mean_of(const std::vector<double>& values) {
    const auto count = static_cast<double>(values.size());
    if (values.empty()) return {};
    double sum = 0;
    for (const double value : values)
      sum += value;
    double squares = 0;
    for (const double value : values)
      squares += (value - sum / count) * (value - sum / count);
    const double error = std::sqrt(squares / std::max(count - 1, 1.0) / count);
    return {sum / count, std::max(error, kLeastError_s)};
  }

  static std::string delay_text(double time_ms, double probability) {
    return fmt::format("{{ time = \"{:.0f} ms\", probability = {} }}", time_ms,
                       number_text(probability));
  }

  /// The mean delay as a mix of two multiples of 10 ms, minus the simulator's own delay.
  static std::string delays_of_mean(const Pooled& all, double own_ms) {
    const double mean_ms = std::max(0.0, 1000 * all.mean - own_ms);
    const double before_ms = kStep_ms * std::floor(mean_ms / kStep_ms);
    const double share = rounded((mean_ms - before_ms) / kStep_ms, 100);
    if (mean_ms < kStep_ms / 2 && 1000 * all.low <= own_ms)
      return "# It cannot be distinguished from zero.\ndelays = []\n";
    std::string list;
    if (share < 1) list = delay_text(before_ms, rounded(1 - share, 100));
    if (share > 0) list += (list.empty() ? "" : ", ") + delay_text(before_ms + kStep_ms, share);
    return "delays = [ " + list + " ]\n";
  }

  std::string latency() {
    if (const std::string text = latency_of_changes(); !text.empty()) return text;
    const Told told = collect([](const MeasuredRobot& of, Told& into) {
      const Latency& latency = of.reality.latency;
      into.add(of,
               latency.seconds ? std::optional(Estimate{*latency.seconds, latency.error_s})
                               : std::nullopt,
               latency.reason);
    });
    if (told.estimates.empty()) return left("latency", told, "ms");
    const Pooled all = pooled(told.estimates);
    figures_.push_back({"latency", all, "ms", count_text(told), {}});
    return comment("latency", all, told, 1000, "ms") +
           "# From command to treads, by the motion of whole runs, less the simulator's 5 ms.\n" +
           delays_of_mean(all, kHalfStep_ms);
  }

  std::string timing() {
    std::string text = "\n[timing]\n" + latency();
    double least_ms = 1e9;
    double most_ms = 0;
    const Told told = collect([&](const MeasuredRobot& of, Told& into) {
      const auto period_s = of.reality.period_s;
      into.add(of, period_s ? std::optional(Estimate{*period_s, 0}) : std::nullopt,
               "its log has fewer than 50 control cycles");
      if (!period_s) return;
      least_ms = std::min(least_ms, 1000 * *period_s);
      most_ms = std::max(most_ms, 1000 * *period_s);
    });
    if (told.estimates.empty()) return text + left("control period", told, "ms");
    const Pooled all = pooled(told.estimates);
    figures_.push_back({"control period", all, "ms", count_text(told), {}});
    text += fmt::format("# control period: {:.2f} to {:.2f} ms; {}\n", least_ms, most_ms,
                        count_text(told));
    if (std::max(std::fabs(least_ms - kNominal_ms), std::fabs(most_ms - kNominal_ms)) <
        kLeastPeriodOff_ms) {
      return text + "period = [\"100 ms\", \"100 ms\"]\n";
    }
    return text + fmt::format("period = [\"{:.2f} ms\", \"{:.2f} ms\"]\n", least_ms, most_ms);
  }

  std::string treads() {
    std::string text = "\n[treads]\n";
    for (const std::string key : {"way", "turn"}) {
      const bool is_way = key == "way";
      const Told told = collect([&](const MeasuredRobot& of, Told& into) {
        const Gain& gain = is_way ? of.reality.slip.way : of.reality.slip.turn;
        into.add(of, gain.gain ? std::optional(Estimate{*gain.gain, gain.error}) : std::nullopt,
                 gain.reason);
      });
      const std::string name =
          is_way ? "way driven, of that commanded" : "turn made, of that commanded";
      if (told.estimates.empty()) {
        text += left(name, told, "%");
        continue;
      }
      const Pooled all = pooled(told.estimates);
      figures_.push_back({name, all, "%", count_text(told), {}});
      text += comment(name, all, told, 100, "%");
      text += fmt::format("{:<8}= {}\n", key, number_text(rounded(std::max(0.0, all.mean), 1e4)));
      text += fmt::format("{:<8}= {}\n", key + "_sd", number_text(rounded(all.spread, 1e4)));
    }
    return text;
  }

  std::string foot() const {
    return fmt::format(
        "\n# Logs and film do not show the noise of proximity sensors, ground colour and lidar, "
        "nor the\n# treads' steps: these are as in `{}`.\n",
        source_.base);
  }

  const LabSource& source_;
  std::string text_;
  std::vector<LabFigure> figures_;
};

}  // namespace

bool LabProfile::is_measured() const {
  return std::ranges::any_of(figures, [](const LabFigure& figure) {
    return figure.value && figure.name != "control period";
  });
}

LabProfile lab_profile(const LabSource& source) {
  return Writer(source).write();
}

}  // namespace swarmsmith
