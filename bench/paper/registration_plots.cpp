#include "paper/registration_plots.hpp"

#include "paper/campaign/plot.hpp"

namespace shortshot_bench::paper {
namespace {

constexpr std::size_t fewest_accepted = 20;  // a curve begins there: below, its precision is chance

/// Of the floats as they are.
campaign::Plot plot_of_curves(const RegistrationSet& set) {
  campaign::Plot plot;
  plot.title = set.name + ": precision and recall of nearest neighbors, by distance ratio";
  plot.x.label = "1 - precision";
  plot.y.label = "recall";
  plot.y.min = 0.0;
  plot.in_panels = true;
  for (const FormResults& form : set.forms) {
    if (!form.is_method()) continue;
    const RatioCurve curve = curve_of(form);
    campaign::Series& series = plot.series.emplace_back();
    series.name = form.name;
    series.marks = campaign::Marks::line;
    for (std::size_t step = 1; step < ratio_steps; step += 2) {
      if (curve.accepted[step] < fewest_accepted) continue;
      series.xs.push_back(1.0 - curve.precision(step));
      series.ys.push_back(curve.recall(step));
    }
  }
  return plot;
}

/// A row for each form, in which the three recalls stand below each other. They have no order, so nothing joins them.
campaign::Plot plot_of_recalls(const RegistrationSet& set) {
  constexpr int row_height = 28;
  constexpr double row_shift = 0.24;
  std::vector<std::string> names;
  for (const FormResults& form : set.forms) names.push_back(form.name);
  campaign::Plot plot;
  plot.title = set.name + ": poses near the true one, with 95 % intervals";
  plot.x.label = "share of all poses";
  plot.y = campaign::axis_of_names(names);
  plot.height = 170 + row_height * static_cast<int>(names.size());
  const std::pair<const char*, const PairFigure*> recalls[] = {{"15 degrees, 30 cm", &pair_figures::within_30cm},
                                                               {"5 degrees, 10 cm", &pair_figures::within_10cm},
                                                               {"5 degrees, 2 cm", &pair_figures::within_2cm}};
  double shift = -row_shift;
  for (const auto& [name, figure] : recalls) {
    campaign::Series& series = plot.series.emplace_back();
    series.name = std::string("within ") + name;
    series.marks = campaign::Marks::intervals;
    for (std::size_t i = 0; i < set.forms.size(); ++i) {
      const campaign::Interval interval = mean_of(set, set.forms[i], *figure);
      series.xs.push_back(interval.value);
      series.ys.push_back(static_cast<double>(i) + shift);
      series.lows.push_back(interval.low);
      series.highs.push_back(interval.high);
    }
    shift += row_shift;
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
