#include "propagation/budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stop_token>
#include <thread>

#include "propagation/result_file.h"

namespace grimaldi {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double first_rays = 62500, most_rays = 6.4e7;
constexpr double share_asked = 0.95;
constexpr double share_for_files = 0.1;  ///< of the time
constexpr double least_growth = 2, most_growth = 16;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Its flag is set as soon as the user stops the run or the time has come, while it lives.
class Deadline {
 public:
  Deadline(std::optional<Clock::time_point> at, const std::atomic<bool>* asked)
      : flag_(come(at, asked)), watch_([this, at, asked](const std::stop_token& over) {
          while (!over.stop_requested() && !flag_) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            if (come(at, asked)) flag_ = true;
          }
        }) {}
  const std::atomic<bool>* flag() const { return &flag_; }

 private:
  static bool come(const std::optional<Clock::time_point>& at, const std::atomic<bool>* asked) {
    return (asked != nullptr && *asked) || (at && Clock::now() > *at);
  }
  std::atomic<bool> flag_;
  std::jthread watch_;
};

/// Seconds that a run of `rays` takes: a power of the rays through the last two rounds, from the root to the rays
/// themselves.
double seconds_of(const std::vector<BudgetRound>& rounds, double rays) {
  const BudgetRound& last = rounds.back();
  double power = 1;
  if (rounds.size() > 1) {
    const BudgetRound& before = rounds[rounds.size() - 2];
    power = std::clamp(std::log(last.seconds / before.seconds) / std::log(last.rays / before.rays), 0.5, 1.0);
  }
  return last.seconds * std::pow(rays / last.rays, power);
}

/// The most rays whose round is expected to take no longer than `seconds`; 0 if that is not worth a round.
double rays_within(const std::vector<BudgetRound>& rounds, double seconds) {
  const double last = rounds.back().rays;
  if (seconds_of(rounds, least_growth * last) > seconds) return 0;
  double growth = least_growth;
  while (growth < most_growth && seconds_of(rounds, 1.1 * growth * last) <= seconds) growth *= 1.1;
  return last * std::min(growth, most_growth);
}

}  // namespace

Result simulate_within_budget(const Scene& scene, const Tracer& tracer, Plan& plan, Clock::time_point start,
                              const ProgressReport& progress, const std::atomic<bool>* stop) {
  const std::optional<double> accuracy = plan.request.accuracy, time = plan.request.time;
  if (!accuracy && !time) return simulate(scene, tracer, plan, progress, stop);
  const double usable = time ? (1 - share_for_files) * *time : 0;
  std::optional<Clock::time_point> deadline;
  std::vector<BudgetRound> rounds;
  Result result;
  BudgetEnd ended_by = BudgetEnd::rays;
  for (double rays = first_rays; rays > 0;) {
    Plan round = plan;
    round.request.rays = std::round(rays);
    const Deadline watch(rounds.empty() ? std::nullopt : deadline, stop);
    const Clock::time_point begun = Clock::now();
    const auto report = [&](const std::string& stage, double share) {
      if (progress) progress(fmt::format("round {}: {}", rounds.size() + 1, stage), share);
    };
    Result found = simulate(scene, tracer, round, report, watch.flag());
    if (stop != nullptr && *stop) return found;
    if (found.interrupted) {
      ended_by = BudgetEnd::time;
      break;
    }
    result = std::move(found);
    plan.request.rays = round.request.rays;
    BudgetRound told{round.request.rays, seconds_since(begun), 0};
    if (result.coverage) told.error_dB = map_figures(plan, *result.coverage).p95_standard_error_dB;
    rounds.push_back(told);
    if (accuracy && told.error_dB <= *accuracy) {
      ended_by = BudgetEnd::accuracy;
      break;
    }
    const double allowed = time ? rays_within(rounds, usable - seconds_since(start)) : most_growth * told.rays;
    double wanted = most_growth * told.rays;
    if (accuracy) {
      const double factor = std::pow(told.error_dB / *accuracy, 2);
      wanted = std::clamp(factor, least_growth, most_growth) * told.rays;
    }
    rays = std::min({wanted, allowed, most_rays});
    if (allowed == 0) ended_by = BudgetEnd::time;
    if (rays <= told.rays) break;
    if (time) deadline = start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(usable));
  }
  if (accuracy && ended_by != BudgetEnd::accuracy)
    result.warnings.push_back(
        {Severity::warning, plan.request.scenario_file.string(), 0, "budget.accuracy",
         fmt::format("not reached ({})", ended_by == BudgetEnd::time ? "the time was up" : "no more rays are launched"),
         fmt::format("95 % of the reached cells have a standard error below {:.2f} dB, {:g} dB was asked",
                     rounds.back().error_dB, *accuracy),
         ended_by == BudgetEnd::time ? "give more time" : "take larger cells or a smaller depth"});
  result.figures.rounds = rounds;
  result.figures.ended_by = ended_by;
  return result;
}

}  // namespace grimaldi
