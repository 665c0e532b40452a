#include "tools/recognize/options.hpp"

#include <CLI/CLI.hpp>

#include "tools/input/options.hpp"
#include "tools/io/threads_option.hpp"

namespace shortshot_bench {

bool parse_recognize_options(int argc, const char* const* argv, RecognizeCommand& command, int& exit_code) {
  CLI::App app("Learns objects from clouds that show one each, and recognizes them.");
  app.name("recognize");
  app.require_subcommand(1);
  CLI::App* const learn = app.add_subcommand("learn", "adds views of an object to a model, or begins one");
  learn->add_option("model", command.model, "file of the model")->required();
  learn->add_option("name", command.name, "of the object")->required();
  learn
      ->add_option("clouds", command.clouds,
                   "PCD or PLY files, or DEPTH.png,COLOR.png, each with the object alone, in color")
      ->required();
  learn
      ->add_option("--radius", command.radius,
                   "support radius of a new model, in the clouds' unit [suggested by the first cloud]")
      ->check(finite_and_positive);
  learn->add_flag("--whole", command.is_whole,
                  "each cloud shows the object from all sides; frames look outwards, in place of at a camera");
  CLI::App* const recognize = app.add_subcommand(
      "recognize", "says which object a cloud shows, and draws it: exit code 0, 1 for none of these, 2 for bad input");
  recognize->add_option("model", command.model, "file of the model")->required();
  recognize->add_option("cloud", command.clouds, "PCD or PLY file, or DEPTH.png,COLOR.png, in color")
      ->required()
      ->expected(1);
  recognize
      ->add_option("--expected", command.expected,
                   "an object is what chance would find less often than that in a cloud without any")
      ->check(finite_and_positive)
      ->capture_default_str();
  recognize->add_option("--out", command.out, "PNG file of the picture")->capture_default_str();
  recognize->add_option("--width", command.width, "of the picture, in pixels")
      ->check(CLI::Range(400, 8000))
      ->capture_default_str();
  recognize->add_flag("--quiet", command.quiet, "the name alone, or nothing, and no picture");
  for (CLI::App* const verb : {learn, recognize}) {
    add_input_options(*verb, command.input);
    add_threads_option(*verb, command.threads);
  }
  command.input.drop_zeros = true;
  exit_code = 0;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? 0 : 2;
    return false;
  }
  command.learns = learn->parsed();
  return true;
}

}  // namespace shortshot_bench
