#include "paper/registration_plots.hpp"

#include "paper/campaign/plot.hpp"

namespace shortshot_bench::paper {
namespace {

constexpr std::size_t fewest_accepted = 20;  // a curve begins there: below, its precision is chance

/// Of the rows as they are: more curves could not be told apart.
campaign::Plot plot_of_curves(const RegistrationSet& set) {
  constexpr int colors = 8;
  campaign::Plot plot;
  plot.title = set.name + ": nearest neighbors, by the ratio of their distance to that of the second nearest";
  plot.x.label = "1 - precision";
  plot.y.label = "recall";
  plot.x.min = plot.y.min = 0.0;
  plot.x.max = 1.0;
  plot.height = 560;
  for (const FormResults& form : set.forms) {
    if (!form.is_method()) continue;
    const RatioCurve curve = curve_of(form);
    const auto number = static_cast<int>(plot.series.size());
    campaign::Series& series = plot.series.emplace_back();
    series.name = form.name;
    series.color = number % colors + 1;
    series.dashed = number >= colors;
    for (std::size_t step = 1; step < ratio_steps; step += 2) {
      if (curve.accepted[step] < fewest_accepted) continue;
      series.xs.push_back(1.0 - curve.precision(step));
      series.ys.push_back(curve.recall(step));
    }
  }
  return plot;
}

/// A column for each form, in which the three recalls stand side by side.
campaign::Plot plot_of_recalls(const RegistrationSet& set) {
  std::vector<std::string> names;
  for (const FormResults& form : set.forms) names.push_back(form.name);
  campaign::Plot plot;
  plot.title = set.name + ": poses near the true one, with 95 % intervals";
  plot.x.label = "descriptor";
  plot.x.min = -0.6;
  plot.x.max = static_cast<double>(names.size()) - 0.4;
  plot.x.ticks = campaign::category_ticks(names);
  plot.y.label = "share of all poses";
  plot.y.min = 0.0;
  plot.y.max = 1.0;
  plot.width = 1200;
  plot.height = 560;
  const std::pair<const char*, const PairFigure*> recalls[] = {{"15 degrees, 30 cm", &pair_figures::within_30cm},
                                                               {"5 degrees, 10 cm", &pair_figures::within_10cm},
                                                               {"5 degrees, 2 cm", &pair_figures::within_2cm}};
  double shift = -0.22;
  for (const auto& [name, figure] : recalls) {
    campaign::Series& series = plot.series.emplace_back();
    series.name = std::string("within ") + name;
    for (std::size_t i = 0; i < set.forms.size(); ++i) {
      const campaign::Interval interval = mean_of(set, set.forms[i], *figure);
      series.xs.push_back(static_cast<double>(i) + shift);
      series.ys.push_back(interval.value);
      series.lows.push_back(interval.low);
      series.highs.push_back(interval.high);
    }
    shift += 0.22;
  }
  return plot;
}

}  // namespace

std::vector<std::string> draw_registration(const RegistrationSet& set, const std::string& prefix,
                                           const std::string& directory) {
  std::vector<std::string> files;
  const auto draw = [&](const campaign::Plot& plot, const char* name) {
    files.push_back(prefix + name);
    campaign::write_svg(plot, directory + "/" + files.back());
  };
  draw(plot_of_curves(set), "precision_recall.svg");
  draw(plot_of_recalls(set), "registration_recall.svg");
  return files;
}

}  // namespace shortshot_bench::paper
