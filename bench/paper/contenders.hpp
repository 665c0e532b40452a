// What registration compares: a way to describe key points, and the forms in which its rows are kept and compared.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "paper/configuration.hpp"
#include "paper/view.hpp"

namespace shortshot_bench::paper {

struct TimedRows {
  Described rows;
  double microseconds = 0.0;  // on one core, without normals and the index; of all key points
};

/// "shot352" as floats, "shot352-root" as their square roots, "shot352-bshot" as bits: one form of a method's rows.
struct Form {
  std::string name;
  std::function<std::size_t(const Described&)> size_bytes;  // of a row
  std::function<Described(const Described&)> code;          // what is compared, by L2
};

/// Its rows are computed once for all of its forms.
struct Contender {
  std::string method;  // that of its floats is a form's name, too
  bool needs_colors = false;
  std::function<TimedRows(const View&)> describe;  // throws std::runtime_error
  std::vector<Form> forms;
};

/// In the order of the names; forms of one method stand together, where the first of them is named. Throws
/// std::runtime_error for a name that is none, with what there is.
std::vector<Contender> contenders_named(const std::vector<std::string>& names);

/// What is compared if nothing is said; `quick`: a few of them.
std::vector<std::string> registration_names(bool quick);

/// The rows of another program as they are and as square roots, "NAME" and "NAME-root". `peer` is "NAME=PROGRAM"; what
/// the program reads and writes says peer_program.hpp. Throws std::runtime_error if that is not what `peer` is.
Contender peer_contender(const std::string& peer);

}  // namespace shortshot_bench::paper
