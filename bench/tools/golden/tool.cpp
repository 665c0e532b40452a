#include "tool.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <ostream>

#include "case.hpp"
#include "compare.hpp"
#include "tools/io/folder_name.hpp"
#include "tools/io/input_error.hpp"

namespace shortshot_bench::golden {
namespace {

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 0, ' ');
}

constexpr std::size_t case_width = 14;
constexpr std::size_t array_width = 16;

void print_header(std::ostream& out) {
  out << padded("case", case_width) << ' ' << padded("array", array_width)
      << "   rows  largest |d|  largest L2  beyond  verdict\n";
}

const char* verdict_of(const Result& result) {
  if (result.broken) return "BROKEN";
  return result.explained ? "explained" : "ok";
}

void print_row(const std::string& case_name, const Result& result, std::ostream& out) {
  out << padded(case_name, case_width) << ' ' << padded(result.array, array_width);
  if (result.rows == 0) {
    out << "      0            -           -       -  not checked: " << (result.note.empty() ? "no rows" : result.note)
        << '\n';
    return;
  }
  char numbers[96];
  std::snprintf(numbers, sizeof numbers, " %6zu  %11.3g %11.3g %7zu  ", result.rows, result.largest, result.largest_l2,
                result.beyond);
  out << numbers << verdict_of(result) << (result.note.empty() ? "" : "; ") << result.note << '\n';
}

void print_deviations(const Case& c, const Result& result, std::ostream& out) {
  for (const Deviation& deviation : result.deviations) {
    out << "    row " << deviation.row;
    if (deviation.row < c.keypoint_kind.size()) out << " (" << c.keypoint_kind[deviation.row] << ')';
    out << ": " << deviation.what << '\n';
  }
}

// What the folders add up to.
struct Summary {
  std::vector<std::string> broken;     // "case/array"
  std::vector<std::string> unchecked;  // each array once
  bool any_folder = false;
  bool any_error = false;
};

void run_folder(const std::string& path, bool verbose, std::ostream& out, Summary& summary) {
  const Case c = read_case(path);
  const Report report = compare(c);
  const std::string name = folder_name(path);
  for (const Result& result : report.results) {
    print_row(name, result, out);
    if (verbose) print_deviations(c, result, out);
    if (result.broken) summary.broken.push_back(name + "/" + result.array);
  }
  for (const std::string& array : report.unchecked) {
    const bool listed = std::count(summary.unchecked.begin(), summary.unchecked.end(), array) > 0;
    if (!listed) summary.unchecked.push_back(array);
  }
  if (report.is_empty()) {
    throw InputError::at_line((std::filesystem::path(path) / "case.json").string(), 1, "nothing to check");
  }
}

void print_list(const char* title, const std::vector<std::string>& words, std::ostream& out) {
  if (words.empty()) return;
  out << title;
  for (std::size_t i = 0; i < words.size(); ++i) out << (i == 0 ? " " : ", ") << words[i];
  out << '\n';
}

void run_path(const std::string& path, bool verbose, std::ostream& out, std::ostream& err, Summary& summary) {
  std::error_code failed;
  const std::filesystem::file_status status = std::filesystem::status(path, failed);
  if (std::filesystem::is_directory(status)) {
    summary.any_folder = true;
    run_folder(path, verbose, out, summary);
  } else if (std::filesystem::exists(status)) {
    out << std::filesystem::path(path).filename().string() << ": not a folder, skipped\n";
  } else {
    summary.any_error = true;
    err << path << ": there is no such folder\n";
  }
}

}  // namespace

ExitCode run(const std::vector<std::string>& paths, bool verbose, std::ostream& out, std::ostream& err) {
  Summary summary;
  print_header(out);
  for (const std::string& path : paths) {
    try {
      run_path(path, verbose, out, err, summary);
    } catch (const std::exception& error) {  // memory may run out as well
      summary.any_error = true;
      err << error.what() << '\n';
    }
  }
  print_list("not checked yet:", summary.unchecked, out);
  print_list("tolerance broken:", summary.broken, out);
  if (!summary.any_folder && !summary.any_error) err << "nothing to check: no folder given\n";
  out.flush();
  if (summary.any_error || !summary.any_folder || !out) return bad_input;
  return summary.broken.empty() ? within_tolerance : beyond_tolerance;
}

}  // namespace shortshot_bench::golden
