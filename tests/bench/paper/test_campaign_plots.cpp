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

/// An error for each pair, one line for each descriptor: categories below, a gap, a descriptor that never matched.
Plot errors_of_pairs() {
  Plot plot;
  plot.title = "T_diff of the pairs' poses";
  plot.x = {"pair", false, automatic, automatic, category_ticks({"mug-desk", "box-desk", "mug-shelf"})};
  plot.y = {"T_diff", true, 1e-3};
  plot.series = {{"CSHOT", {0, 1, 2}, {0.01, no_number, 0.02}},
                 {"SCSH_336 <&>", {0, 1, 2}, {0.012, 0.0, 0.5}},
                 {"never", {0, 1, 2}, {no_number, no_number, no_number}}};
  return plot;
}

/// Accuracies of classes and instances against bins, with bytes on further axes.
Plot accuracies() {
  Plot plot;
  plot.title = "Accuracy";
  plot.x.label = "bins h";
  plot.y = {"accuracy", false, 0.0, 1.0};
  plot.second_x = {"bytes", false, automatic, automatic, {{10, "1K"}, {20, "2K"}}};
  plot.second_y.label = "bytes per descriptor";
  plot.series = {{"n_c 16, class", {10, 20}, {0.7, 0.8}, 1},
                 {"n_c 16, instance", {10, 20}, {0.6, 0.7}, 1, true},
                 {"bytes", {10, 20}, {1024, 2048}, 0, false, true}};
  return plot;
}

bool gnuplot_is_there() {
  if (std::system("gnuplot --version > /dev/null 2>&1") == 0) return true;
  MESSAGE("skipped: no gnuplot (Debian: gnuplot-nox)");
  return false;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("gnuplot is told of categories, ranges, scales, gaps and names") {
  CHECK(plot_script(errors_of_pairs()) ==
        "name = 'plot'\nwidth = 900\nheight = 480\nload style\n"
        "set termoption noenhanced\nset title 'T_diff of the pairs'' poses'\nset border 3\n"
        "set xlabel 'pair'\nset xrange [*:*]\nset xtics ('mug-desk' 0, 'box-desk' 1, 'mug-shelf' 2)\n"
        "set ylabel 'T_diff'\nset logscale y\nset yrange [0.001:*]\nset ytics\n"
        "$data << END\n0 0.01\n1 NaN\n2 0.02\n\n\n0 0.012\n1 NaN\n2 0.5\n\n\n0 NaN\n1 NaN\n2 NaN\n\n\nEND\n"
        "plot $data index 0 using 1:2 axes x1y1 with linespoints linetype 1 title 'CSHOT', \\\n"
        "  $data index 1 using 1:2 axes x1y1 with linespoints linetype 2 title 'SCSH_336 <&>', \\\n"
        "  keyentry with linespoints linetype 3 title 'never'\n");
}

TEST_CASE("gnuplot is told of second axes, colors and dashes") {
  const std::string script = plot_script(accuracies());
  CHECK(contains(script, "set border 15\n"));
  CHECK(contains(script, "set x2label 'bytes'\nset x2range [*:*]\nset x2tics ('1K' 10, '2K' 20)\nset link x2\n"));
  CHECK(contains(script, "set y2label 'bytes per descriptor'\nset y2range [*:*]\nset y2tics\n"));
  CHECK(contains(script, "set yrange [0:1]\n"));
  CHECK(contains(script, "axes x1y1 with linespoints linetype 1 dashtype 2 title 'n_c 16, instance'"));
  CHECK(contains(script, "axes x1y2 with linespoints linetype 3 dashtype 3 title 'bytes'"));
}

TEST_CASE("many long names below an axis are turned") {
  Plot plot = errors_of_pairs();
  plot.x.ticks = category_ticks(std::vector<std::string>(20, "mug on desk"));
  CHECK(contains(plot_script(plot), "set xtics rotate by 45 right ('mug on desk' 0, "));
}

TEST_CASE("text cannot end the string that it stands in") {
  CHECK(quoted_for_gnuplot("it's\nset output") == "'it''s set output'");
}

TEST_CASE("what cannot be drawn is refused") {
  Plot plot = errors_of_pairs();
  plot.series[1].ys.pop_back();
  CHECK_THROWS_WITH_AS(plot_script(plot), "plot 'T_diff of the pairs' poses': 'SCSH_336 <&>' has not as many ys as xs",
                       std::invalid_argument);
  plot.series = {{"never", {0, 1}, {no_number, 0.0}}};
  CHECK_THROWS_WITH_AS(plot_script(plot), "plot 'T_diff of the pairs' poses': there is nothing to draw",
                       std::invalid_argument);
  plot.series.clear();
  CHECK_THROWS_AS(plot_script(plot), std::invalid_argument);
}

TEST_CASE("an SVG is drawn: with all names, without date and path, the same each time") {
  if (!gnuplot_is_there()) return;
  const TemporaryDirectory directory;
  for (const Plot& plot : {errors_of_pairs(), accuracies()}) {
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
  CHECK(contains(read_bytes(directory.file("a.svg")), "n_c 16, instance"));
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
