#include "tools/plot/gnuplot.hpp"

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "tools/io/binary_file.hpp"

namespace shortshot_bench {
namespace {

bool run_gnuplot(const std::string& script) {
  // A shell that finds no gnuplot ends at once; writing to it must be an error, not the end of this program.
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  FILE* const gnuplot = popen("gnuplot", "w");
  if (gnuplot == nullptr) throw std::runtime_error("cannot start gnuplot");
  const bool written = std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
  const bool done = pclose(gnuplot) == 0;
  std::signal(SIGPIPE, before);
  return written && done;
}

/// gnuplot does not notice when the disk is full.
bool is_complete(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string svg(std::istreambuf_iterator<char>(file), {});
  return svg.find("</svg>") != std::string::npos;
}

}  // namespace

std::string quoted_for_gnuplot(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c == '\n' || c == '\r' ? ' ' : c);
  return quoted + "'";
}

void draw_svg(const std::string& path, const std::string& script) {
  const std::string unfinished = path + ".tmp";
  BinaryFile(unfinished).close();  // where gnuplot cannot open a file it goes on and draws to stdout
  const bool done = run_gnuplot("set output " + quoted_for_gnuplot(unfinished) +
                                "\nstyle = " + quoted_for_gnuplot(SHORTSHOT_PLOT_STYLE) + '\n' + script);
  if (!done || !is_complete(unfinished)) {
    std::filesystem::remove(unfinished);
    throw std::runtime_error("gnuplot (Debian: gnuplot-nox) failed");
  }
  std::filesystem::rename(unfinished, path);
}

}  // namespace shortshot_bench
