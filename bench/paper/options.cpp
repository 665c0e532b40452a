#include "paper/options.hpp"

#include <CLI/CLI.hpp>

#include "paper/contenders.hpp"
#include "paper/kept_frames.hpp"
#include "tools/io/finite_and_positive.hpp"

namespace shortshot_bench::paper {
namespace {

CLI::App* add_experiment(CLI::App& app, const std::string& name, const std::string& what, PaperOptions& options,
                         std::string& shard) {
  CLI::App* const command = app.add_subcommand(name, what);
  command->add_option("DATA", options.data, "folders of data sets, or folders that hold such folders")->required();
  command->add_option("--out", options.out, "folder of the results; what it holds already is not done again")
      ->default_str("paper-" + name);
  command->add_option("--seed", options.seed, "of everything that is drawn at random")->capture_default_str();
  command->add_option("--threads", options.threads, "0: as many as there are cores")->capture_default_str();
  command->add_option("--shard", shard, "k/n: do the k-th of n shares of the work only; then merge the folders")
      ->check(campaign::refusal_of_shard);
  command->add_option("--radius", options.radius_m, "meters, of supports and frames (the protocol's)")
      ->check(finite_and_positive);
  command->add_option("--leaf", options.leaf_m, "meters: one key point in each voxel of this size (the protocol's)")
      ->check(finite_and_positive);
  command->add_option("--normal-radius", options.normal_radius_m, "meters, of SHOT's normals (the protocol's)")
      ->check(finite_and_positive);
  command->add_option("--scale", options.scale, "meters in a unit of clouds, motions and meshes: 0.001 for millimeters")
      ->check(finite_and_positive)
      ->capture_default_str();
  command->add_flag("--quick", options.quick, "a small part of the data, to see that all works");
  command->add_flag("--check", options.check, "exit 1 if a figure is outside of the bands in bench/paper/bands.json");
  return command;
}

}  // namespace

bool parse_options(int argc, const char* const* argv, PaperOptions& options, int& exit_code) {
  CLI::App app("The experiments of the paper, on data of your own or on public data sets. bench/paper/README.md");
  app.name("paper");
  app.require_subcommand(1);
  std::string shard = "1/1";
  std::vector<unsigned> kept_percentages;
  CLI::App* const matching = add_experiment(app, "matching", "key-point matching (section VI-A)", options, shard);
  CLI::App* const registration = add_experiment(app, "registration", "poses from matches, PR curves", options, shard);
  CLI::App* const recognition = add_experiment(app, "recognition", "object recognition (VI-B)", options, shard);
  add_experiment(app, "ablation", "sizes of SCSH (VI-C)", options, shard);
  for (CLI::App* const command : {matching, registration, recognition}) {
    command->add_option("--descriptor", options.descriptors, "those to compare, the baseline first (all; quick: a few)")
        ->delimiter(',');
  }
  for (CLI::App* const command : {matching, recognition}) {
    command
        ->add_option("--keep-frames", kept_percentages,
                     "each also with these percentages of the key points only: those with the surest frames, and as "
                     "many at random")
        ->delimiter(',')
        ->check(CLI::Range(1, 99));
  }
  for (CLI::App* const command : {matching, registration}) {
    command->add_option("--tolerance", options.tolerance_m, "meters by which a correct match and an inlier may miss")
        ->check(finite_and_positive);
  }
  registration->add_option("--peer", options.peers,
                           "NAME=PROGRAM: what another program makes of key points (bench/paper/peer_program.hpp)");
  matching->add_flag("--all-of-target", options.all_of_target,
                     "--keep-frames leaves out key points of the source only");
  recognition->add_option("--up", options.up, "the axis of meshes that points up")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->capture_default_str();
  CLI::App* const merge = app.add_subcommand("merge", "bring the results of shards together, and report on them");
  merge->add_option("FOLDER", options.data, "folders of results")->required();
  merge->add_option("--out", options.out, "folder of all results")->required();
  merge->add_flag("--check", options.check, "as above");
  exit_code = 0;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? 0 : 2;
    return false;
  }
  options.command = app.get_subcommands().front()->get_name();
  if (options.out.empty()) options.out = "paper-" + options.command;
  options.shard = campaign::parse_shard(shard);
  if (options.descriptors.empty() && options.command == "registration") {
    options.descriptors = registration_names(options.quick);
  } else if (options.descriptors.empty()) {
    options.descriptors = {"cshot1344", "shot352", "scsh336", "scsh696", "ssh96", "ssh32"};
    if (options.quick) options.descriptors = {"cshot1344", "scsh336", "ssh96"};
  }
  options.descriptors = with_kept_frames(options.descriptors, kept_percentages);
  return true;
}

}  // namespace shortshot_bench::paper
