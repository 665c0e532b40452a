// Recognition of labeled views: key points whose nearest neighbor is of the right instance, and the Hough vote.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "paper/recognition.hpp"
#include "tradeoff/candidate.hpp"
#include "tradeoff/items.hpp"

namespace shortshot_bench::tradeoff {

/// A candidate in all of its formats on the test views of a task: of a view's key points, those whose nearest neighbor
/// among the training views' belongs to the same instance.
std::vector<Item> count_right_instances(const paper::RecognitionTask& task, const paper::Views& views,
                                        const std::string& measure, const Candidate& candidate);

/// The same for the instance that the recognizer names: 1 of 1 if it is the right one.
std::vector<Item> count_hough_instances(const paper::RecognitionTask& task, const paper::Views& views,
                                        const std::string& measure, const Candidate& candidate);

}  // namespace shortshot_bench::tradeoff
