#include "tools/recognize/run.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "shortshot/shortshot.hpp"
#include "tools/input/read_input.hpp"
#include "tools/io/input_error.hpp"
#include "tools/picture/marks.hpp"
#include "tools/recognize/objects.hpp"

namespace shortshot_bench {
namespace {

void require_of(const std::string& file, shortshot::Status status) {
  if (status != shortshot::Status::ok) throw InputError::about(file, shortshot::message(status));
}

shortshot::Recognizer load_model(const std::string& file) {
  shortshot::Recognizer recognizer;
  require_of(file, shortshot::load(file, shortshot::layout_of<ObjectDescriptor>(), recognizer));
  return recognizer;
}

/// Runs work(); what is thrown then names the file.
template <class Work>
void about(const std::string& file, const Work& work) {
  try {
    work();
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError::about(file, error.what());
  }
}

void print(const shortshot::Recognizer& recognizer, const std::vector<Recognized>& all, std::size_t keypoints) {
  for (const Recognized& r : all) {
    const shortshot::Hypothesis& h = r.hypothesis;
    std::printf("  %-20s score %.1f, %zu of %zu key points, at %.3g %.3g %.3g; by chance 10^%.1f with as many\n",
                recognizer.class_name(h.object_class).c_str(), static_cast<double>(h.score), r.voters.size(), keypoints,
                static_cast<double>(h.center.x), static_cast<double>(h.center.y), static_cast<double>(h.center.z),
                r.log10_expected);
  }
}

void draw(const picture::NamedCloud& cloud, const shortshot::Features<ObjectDescriptor>& features,
          const std::string& verdict, const Recognized* best, const RecognizeCommand& command) {
  picture::MarkedCloud marked;
  for (const shortshot::KeyPoint& key : features.keypoints) marked.dots.push_back(key.position);
  std::size_t all = 0;
  if (best != nullptr) {
    const std::vector<std::uint32_t> shown = picture::thinned(best->voters, command.width / 40);
    all = best->voters.size();
    for (const std::uint32_t row : shown) marked.marks.push_back(features.keypoints[row].position);
    marked.targets.assign(shown.size(), best->hypothesis.center);
  }
  marked.title = verdict;
  marked.legend = "dots: key points";
  if (best != nullptr) {
    std::array<char, 120> text{};
    std::snprintf(text.data(), text.size(), ": %zu of %zu key points voted for it (by chance: 10^%.0f such objects)",
                  all, features.size(), best->log10_expected);
    marked.title += text.data();
    marked.legend += "; green: " + std::to_string(marked.marks.size()) + " of those that voted; cross: the center " +
                     "that they voted for";
  }
  draw_marked(cloud, marked, command.width).write_png(command.out);
  std::printf("written: %s\n", command.out.c_str());
}

}  // namespace

void run_learn(const RecognizeCommand& command) {
  const bool is_new = !std::filesystem::exists(command.model);
  shortshot::Recognizer recognizer = is_new ? shortshot::Recognizer{} : load_model(command.model);
  for (std::size_t i = 0; i < command.clouds.size(); ++i) {
    RgbdCloud cloud = read_input(command.clouds[i], command.input);
    print_notes(cloud);
    cloud.is_whole = command.is_whole;
    about(command.clouds[i], [&] {
      if (is_new && i == 0) {
        const float radius = command.radius > 0.0f ? command.radius : suggested_radius(cloud);
        recognizer.set_options(recognizer_options(radius));
      }
      learn(recognizer, cloud, command.name, command.threads);
    });
  }
  require_of(command.model, shortshot::save(recognizer, command.model));
  std::printf("%s: %zu objects, %zu descriptors within %g\n", command.model.c_str(), recognizer.class_count(),
              recognizer.codeword_count(), static_cast<double>(radius_of(recognizer)));
}

bool run_recognize(const RecognizeCommand& command) {
  const shortshot::Recognizer recognizer = load_model(command.model);
  const std::string& file = command.clouds.front();
  if (!command.quiet) keep_input(file, command.out);
  const RgbdCloud cloud = read_input(file, command.input);
  shortshot::Features<ObjectDescriptor> features;
  std::vector<Recognized> all;
  about(file, [&] {
    features = describe_object(cloud, radius_of(recognizer), command.threads);
    all = recognize_objects(recognizer, features, command.threads);
  });
  const Recognized* const best = all.empty() ? nullptr : &all.front();
  const bool is_known = best != nullptr && best->log10_expected < std::log10(command.expected);
  const std::string name = is_known ? recognizer.class_name(best->hypothesis.object_class) : "none of these";
  if (command.quiet) {
    if (is_known) std::printf("%s\n", name.c_str());
    return is_known;
  }
  print_notes(cloud);
  std::printf("%s: %zu key points within %g\n", file.c_str(), features.size(),
              static_cast<double>(radius_of(recognizer)));
  print(recognizer, all, features.size());
  std::printf("%s\n", name.c_str());
  draw({name_of_input(file), cloud}, features, name, is_known ? best : nullptr, command);
  return is_known;
}

}  // namespace shortshot_bench
