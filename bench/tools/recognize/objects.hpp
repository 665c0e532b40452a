// Objects that are learned from clouds, each of which shows one, and recognized in others; and how sure that is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shortshot/shortshot.hpp"
#include "tools/io/rgbd_cloud.hpp"
#include "tools/match/chance.hpp"

namespace shortshot_bench {

using ObjectDescriptor = shortshot::ShapeColor95;

/// The supports of a model's descriptors, which its file does not say otherwise: four thirds of the votes' bandwidth,
/// as by default.
float radius_of(const shortshot::Recognizer& recognizer);
shortshot::RecognizerOptions recognizer_options(float radius);

/// For a first view: what is suggested for it. Throws std::runtime_error with the library's words.
float suggested_radius(const RgbdCloud& cloud);

/// Throws std::runtime_error with the library's words, also for a cloud without colors.
shortshot::Features<ObjectDescriptor> describe_object(const RgbdCloud& cloud, float radius, unsigned threads);

/// Learns a view of an object, whose center is the mean of its points. Throws likewise.
void learn(shortshot::Recognizer& recognizer, const RgbdCloud& cloud, const std::string& name, unsigned threads);

/// A hypothesis, and those who voted for it: rows of the features, whose votes are within the bandwidth of its center.
struct Recognized {
  shortshot::Hypothesis hypothesis{};
  std::vector<std::uint32_t> voters;
  Agreement at;                 // of the key points that vote
  double log10_expected = 0.0;  // hypotheses with as many, that chance would find
};

/// What the recognizer says, densest first, with how sure it is. If all votes were wrong, each key point would be
/// matched with any of the codewords; from its frame and theirs follows how often that is a vote for the hypothesis. Of
/// key points within a radius of each other one counts: see Places. Throws likewise.
std::vector<Recognized> recognize_objects(const shortshot::Recognizer& recognizer,
                                          const shortshot::Features<ObjectDescriptor>& features, unsigned threads);

}  // namespace shortshot_bench
