#include "paper/configuration.hpp"

#include <algorithm>
#include <stdexcept>

namespace shortshot_bench::paper {

std::vector<Configuration> known_configurations() {
  using namespace shortshot;
  // SHOT and CSHOT as PCL computes them: what the paper compares with.
  return {
      configuration<PclCshot1344>("cshot1344"),
      configuration<PclShot352>("shot352"),
      configuration<Scsh336>("scsh336"),
      configuration<Scsh696>("scsh696"),
      configuration<Ssh96>("ssh96"),
      configuration<Ssh32>("ssh32"),
      configuration<ShapeColor95>("shapecolor95"),
      configuration<ShapeColor32>("shapecolor32"),
      configuration<RoomColor95>("roomcolor95"),
      configuration<HeightShape96>("heightshape96"),
      configuration<ColorRings27>("colorrings27"),
      // Your own: configuration<Scsh<SphericalGrid<2, 4, 8>, SphericalGrid<2, 2, 4>, 10>>("mine"),
  };
}

std::vector<Configuration> configurations_named(const std::vector<std::string>& names) {
  const std::vector<Configuration> known = known_configurations();
  std::vector<Configuration> found;
  for (const std::string& name : names) {
    const KeptName wanted = kept_name_of(name);
    const auto place =
        std::find_if(known.begin(), known.end(), [&](const auto& c) { return c.name == wanted.descriptor; });
    if (place == known.end()) {
      std::string list;
      for (const Configuration& c : known) list += (list.empty() ? "" : ", ") + c.name;
      throw std::runtime_error("no descriptor \"" + name + "\"; there are " + list);
    }
    found.push_back(*place);
    found.back().name = name;
    found.back().kept = wanted.kept;
  }
  return found;
}

}  // namespace shortshot_bench::paper
