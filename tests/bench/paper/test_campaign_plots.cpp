// Plots: what gnuplot is told, and that it draws it.

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "cloud_file_samples.hpp"
#include "paper/campaign/plot.hpp"
#include "tools/plot/gnuplot.hpp"

namespace test_campaign_plots {
namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::campaign;
using cloud_file_test::read_bytes;
using cloud_file_test::TemporaryDirectory;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// An error for each pair, points for each descriptor: a gap, a descriptor that never matched.
Plot errors_of_pairs() {
  Plot plot;
  plot.title = "T_diff of the pairs' poses";
  plot.x = axis_of_numbers("pair", 3);
  plot.y = {"T_diff", true};
  plot.series = {{"CSHOT", {1, 2, 3}, {0.01, no_number, 0.02}, Marks::points},
                 {"SCSH_336 <&>", {1, 2, 3}, {0.012, 0.0, 0.5}, Marks::points},
                 {"never", {1, 2, 3}, {no_number, no_number, no_number}, Marks::points}};
  return plot;
}

/// Accuracies against bins, with bytes above.
Plot accuracies() {
  Plot plot;
  plot.title = "Accuracy";
  plot.x.label = "bins h";
  plot.y = {"accuracy", false, 0.0, 1.0};
  plot.second_x.ticks = {{10, "1K"}, {20, "2K"}};
  plot.series = {{"n_c = 16", {10, 20}, {0.7, 0.8}},
                 {"n_c = 24", {10, 20}, {0.6, 0.7}, Marks::steps, 8},
                 {"CSHOT", {10, 20}, {0.9, 0.9}, Marks::line}};
  return plot;
}

/// Shares with intervals of descriptors, of which none comes before another.
Plot shares_of_descriptors() {
  Plot plot;
  plot.title = "Shares";
  plot.y = axis_of_names({"SHOT", "SCSH"});
  plot.series = {{"found", {0.5, 0.6}, {0, 1}, Marks::intervals, 0, {0.4, 0.5}, {0.6, 0.9}},
                 {"right", {0.1, 0.2}, {0, 1}, Marks::points},
                 {"sure", {0.1, 0.2}, {0, 1}, Marks::points}};
  return plot;
}

bool gnuplot_is_there() {
  if (std::system("gnuplot --version > /dev/null 2>&1") == 0) return true;
  MESSAGE("skipped: no gnuplot (Debian: gnuplot-nox)");
  return false;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("gnuplot is told of numbers, ranges that fit, gaps and names") {
  CHECK(plot_script(errors_of_pairs()) ==
        "name = 'plot'\nwidth = 800\nheight = 500\nload style\nset termoption noenhanced\n"
        "set xrange [0.5:3.5]\nset xtics ('1' 1, '2' 2, '3' 3)\n"
        "set logscale y 10; set yrange [0.00855148:0.584694]; set ytics (0.01, 0.02, 0.05, 0.1, 0.2, 0.5); \n"
        "$data << END\n1 0.01\n2 NaN\n3 0.02\n\n\n1 0.012\n2 NaN\n3 0.5\n\n\n1 NaN\n2 NaN\n3 NaN\n\n\nEND\n"
        "set multiplot layout 1,1 title 'T_diff of the pairs'' poses'\nset xlabel 'pair'\nset ylabel 'T_diff'\n"
        "plot $data index 0 using 1:2 with points linetype 1 title 'CSHOT', \\\n"
        "  $data index 1 using 1:2 with points linetype 2 title 'SCSH_336 <&>', \\\n"
        "  keyentry with points linetype 3 title 'never'\nunset multiplot\n");
}

TEST_CASE("gnuplot is told of second axes, styles and steps") {
  const std::string script = plot_script(accuracies());
  CHECK(contains(script, "set border 7\nset x2range [*:*]\nset x2tics ('1K' 10, '2K' 20)\nset link x2\n"));
  CHECK(contains(script, "set yrange [0:1]\n"));
  CHECK(contains(script, "index 0 using 1:2 with linespoints linetype 1 title 'n_c = 16'"));
  CHECK(contains(script, "index 1 using 1:2 with steps linetype 8 title 'n_c = 24'"));
  CHECK(contains(script, "index 2 using 1:2 with lines linetype 3 title 'CSHOT'"));
}

TEST_CASE("in panels each series stands before all others, in one style") {
  Plot plot = accuracies();
  plot.in_panels = true;
  const std::string script = plot_script(plot);
  CHECK(contains(script, "set multiplot layout 1,3 title 'Accuracy' "));
  CHECK(contains(script,
                 "set title 'n_c = 24' offset 0,-0.5\n"
                 "plot $data index 0 using 1:2 with linespoints linetype 9 notitle, \\\n"
                 "  $data index 2 using 1:2 with lines linetype 9 notitle, \\\n"
                 "  $data index 1 using 1:2 with steps linetype 1 notitle\n"));
  plot.series.resize(1);
  CHECK(contains(plot_script(plot), "set multiplot layout 1,1 title 'Accuracy' "));
}

TEST_CASE("no line joins what has no order") {
  const std::string script = plot_script(shares_of_descriptors());
  CHECK(contains(script, "set yrange [1.5:-0.5]\nset ytics ('SHOT' 0, 'SCSH' 1)\n"));
  CHECK(contains(script, "0.6 1 0.5 0.9\n"));
  CHECK(contains(script, "index 0 using 1:2:3:4 with xerrorbars linetype 1 "));
  CHECK(!contains(script, "with line"));
  for (const Plot& unordered : {shares_of_descriptors(), errors_of_pairs()}) {
    for (const Marks marks : {Marks::line_with_points, Marks::line, Marks::steps}) {
      Plot plot = unordered;
      plot.series[1].marks = marks;
      CHECK_THROWS_WITH_AS(plot_script(plot), doctest::Contains("' would join what has no order"),
                           std::invalid_argument);
    }
  }
}

TEST_CASE("of many numbers a few round ones are ticks") {
  const auto ticks = [](std::size_t count) {
    std::string text;
    for (const Tick& tick : axis_of_numbers("pair", count).ticks) text += tick.text + ' ';
    return text;
  };
  CHECK(ticks(1) == "1 ");
  CHECK(ticks(6) == "1 2 3 4 5 6 ");
  CHECK(ticks(7) == "2 4 6 ");
  CHECK(ticks(30) == "5 10 15 20 25 30 ");
  CHECK(ticks(153) == "50 100 150 ");
}

TEST_CASE("text cannot end the string that it stands in") {
  CHECK(quoted_for_gnuplot("it's\nset output") == "'it''s set output'");
}

TEST_CASE("what cannot be drawn is refused") {
  Plot plot = errors_of_pairs();
  plot.series[1].ys.pop_back();
  CHECK_THROWS_WITH_AS(plot_script(plot), "plot 'T_diff of the pairs' poses': 'SCSH_336 <&>' has not as many ys as xs",
                       std::invalid_argument);
  plot.series = {{"never", {0, 1}, {no_number, 0.0}, Marks::points}};
  CHECK_THROWS_WITH_AS(plot_script(plot), "plot 'T_diff of the pairs' poses': there is nothing to draw",
                       std::invalid_argument);
  plot.series.clear();
  CHECK_THROWS_AS(plot_script(plot), std::invalid_argument);
  plot = shares_of_descriptors();
  plot.series[0].highs.pop_back();
  CHECK_THROWS_WITH_AS(plot_script(plot), "plot 'Shares': 'found' has not a bar for each point", std::invalid_argument);
}

TEST_CASE("an SVG is drawn: with all names, without date and path, the same each time") {
  if (!gnuplot_is_there()) return;
  const TemporaryDirectory directory;
  Plot panels = errors_of_pairs();
  panels.in_panels = true;
  for (const Plot& plot : {errors_of_pairs(), shares_of_descriptors(), panels, accuracies()}) {
    write_svg(plot, directory.file("a.svg"));
    write_svg(plot, directory.file("b.svg"));
    const std::string svg = read_bytes(directory.file("a.svg"));
    CHECK(svg == read_bytes(directory.file("b.svg")));
    CHECK(contains(svg, "<svg"));
    CHECK(contains(svg, "</svg>"));
    CHECK(!contains(svg, directory.file("")));
    CHECK(contains(svg, plot.y.label));
    CHECK(contains(svg, plot.series[0].name));
    CHECK(contains(svg, plot.series[2].name));
    CHECK(!contains(svg, "<&>"));
  }
  CHECK(contains(read_bytes(directory.file("a.svg")), "n_c = 24"));
  CHECK(!std::filesystem::exists(directory.file("a.svg.tmp")));
}

TEST_CASE("a plot that gnuplot cannot write is an error and leaves nothing") {
  const TemporaryDirectory directory;
  CHECK_THROWS_AS(write_svg(accuracies(), directory.file("no folder/a.svg")), InputError);
  if (!gnuplot_is_there()) return;
  CHECK_THROWS_AS(draw_svg(directory.file("a.svg"), "no command of gnuplot\n"), std::runtime_error);
  CHECK_THROWS_AS(draw_svg(directory.file("a.svg"), "print 'nothing drawn'\n"), std::runtime_error);
  CHECK(std::filesystem::is_empty(directory.file("")));
}

}  // namespace test_campaign_plots
