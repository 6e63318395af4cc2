#include "tools/bench/published_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tools/bench/bench_table.h"

namespace talus {
namespace {

/// Runs of one experiment on one engine under one policy.
struct PublishedGroup {
  std::vector<const PublishedRun*> runs;

  std::vector<double> values_at(std::size_t row) const {
    std::vector<double> values;
    for (const PublishedRun* run : runs)
      if (run->row == row) values.push_back(run->value);
    return values;
  }

  /// Of each seed for itself, so that the scatter of the fits is theirs.
  std::vector<double> fits(const Experiment& experiment, const ExperimentFit& fit) const {
    std::map<int, std::pair<std::vector<double>, std::vector<double>>> by_seed;
    for (const PublishedRun* run : runs) {
      by_seed[run->run.seed].first.push_back(*experiment.rows[run->row].x);
      by_seed[run->run.seed].second.push_back(run->value);
    }
    std::vector<double> all;
    for (const auto& [seed, points] : by_seed) all.push_back(fitted(fit, points.first, points.second));
    return all;
  }
};

std::string published_text(const Published& published) {
  if (published.values.empty()) return "-";
  std::string text = fmt::format("{:.4g}", fmt::join(published.values, " to "));
  if (published.error > 0.0) text += fmt::format(" ± {:g}", published.error);
  return text;
}

/// Of one policy: ours, the difference, and whether it agrees.
std::string policy_cells(const std::string& ours, const Difference& off) {
  if (!std::isfinite(off.value)) return fmt::format(" {} | | |", ours);
  return fmt::format(" {} | {} | {} |", ours, off.value == 0.0 ? "0" : fmt::format("{:+.2g}", off.value),
                     off.agrees ? "yes" : "no");
}

/// As "3 of 4".
std::string share_text(const std::vector<double>& values) {
  const auto measured = std::ranges::count_if(values, [](double value) { return std::isfinite(value); });
  return measured > 0 ? fmt::format("{} of {}", std::ranges::count(values, 1.0), measured) : "-";
}

class ExperimentTable {
 public:
  ExperimentTable(const Experiment& experiment, const std::vector<PublishedRun>& runs,
                  const std::vector<std::string>& policies)
      : experiment_(experiment), policies_(policies) {
    for (const PublishedRun& run : runs) {
      if (run.experiment != &experiment) continue;
      groups_[{run.run.backend, run.run.policy}].runs.push_back(&run);
      seeds_ = std::max(seeds_, run.run.seed);
      if (std::ranges::find(engines_, run.run.backend) == engines_.end()) engines_.push_back(run.run.backend);
    }
  }

  std::string text() const {
    std::string text = fmt::format(
        "## {}\n\n{}\n\n{} seeds: `talus bench published {} --policy {} --seeds {}`\n\n| setting | engine | published "
        "|",
        experiment_.title, experiment_.source, seeds_, experiment_.name, fmt::join(policies_, ","), seeds_);
    for (const std::string& policy : policies_) text += fmt::format(" `{}`{} | difference | agrees |", policy, unit());
    text += "\n| --- | --- | ---: |";
    for (std::size_t i = 0; i < policies_.size(); ++i) text += " ---: | ---: | --- |";
    text += "\n";
    for (std::size_t i = 0; i < experiment_.rows.size(); ++i) {
      const Published& published = experiment_.rows[i].published;
      add_lines(text, experiment_.rows[i].name, published, [&](const PublishedGroup& group) {
        const std::vector<double> values = group.values_at(i);
        const MeanWithError ours = mean_of(values, share());
        return policy_cells(share() ? share_text(values) : mean_text(ours), difference(ours, published));
      });
    }
    for (const ExperimentFit& fit : experiment_.fits)
      add_lines(text, fit.name, fit.published, [&](const PublishedGroup& group) {
        const MeanWithError ours = mean_of(group.fits(experiment_, fit), false);
        return policy_cells(mean_text(ours), difference(ours, fit.published));
      });
    if (!experiment_.remark.empty()) text += "\n" + experiment_.remark + "\n";
    return text + "\n";
  }

 private:
  bool share() const { return experiment_.at_least.has_value(); }
  std::string unit() const { return experiment_.unit.empty() ? "" : fmt::format(" [{}]", experiment_.unit); }

  /// `cells`: of the runs of a policy.
  template <typename Cells>
  void add_lines(std::string& text, const std::string& name, const Published& published, const Cells& cells) const {
    for (const std::string& engine : engines_) {
      text += fmt::format("| {} | {} | {} |", name, engine, published_text(published));
      for (const std::string& policy : policies_) text += cells(groups_.at({engine, policy}));
      text += "\n";
    }
  }

  const Experiment& experiment_;
  const std::vector<std::string>& policies_;
  std::vector<std::string> engines_;
  int seeds_ = 0;
  std::map<std::pair<std::string, std::string>, PublishedGroup> groups_;
};

}  // namespace

Difference difference(const MeanWithError& ours, const Published& published) {
  if (published.values.empty() || !std::isfinite(ours.mean)) return {};
  const auto [low, high] = std::ranges::minmax(published.values);
  const double off = ours.mean - std::clamp(ours.mean, low, high);
  const double error = std::isfinite(ours.error) ? ours.error : 0.0;
  return {off, std::abs(off) <= 2.0 * std::hypot(error, published.error)};
}

MeanWithError mean_of(const std::vector<double>& values, bool share) {
  MeanWithError mean = mean_with_error(values);
  const auto n = static_cast<double>(std::ranges::count_if(values, [](double value) { return std::isfinite(value); }));
  if (share && n > 0.0) {
    const double middle = (mean.mean * n + 1.0) / (n + 2.0);
    mean.error = std::sqrt(middle * (1.0 - middle) / (n + 2.0));
  }
  return mean;
}

std::string published_page(const std::vector<PublishedRun>& runs, const std::vector<std::string>& policies) {
  std::vector<const Experiment*> experiments;
  for (const PublishedRun& run : runs)
    if (experiments.empty() || experiments.back() != run.experiment) experiments.push_back(run.experiment);
  std::string text =
      "# Published experiments\n\nWhat others have published beside what talus gives. `talus bench published` writes "
      "this page from the scenes and numbers in\n`scenes/published`. Numbers are means over seeds with their standard "
      "error. They agree where they are within two standard errors of\nboth, or of the published interval; for the "
      "error of a share one success and one failure are added.\n\n";
  for (const Experiment* experiment : experiments) text += ExperimentTable(*experiment, runs, policies).text();
  text.pop_back();
  return text;
}

}  // namespace talus
