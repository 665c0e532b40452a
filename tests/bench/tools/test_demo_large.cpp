// What the demo does where it takes long: it says what it is busy with, and --check asks brute force for a sample.

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "shortshot/shortshot.hpp"
#include "tools/demo/options.hpp"
#include "tools/demo/run.hpp"
#include "tools/demo/sampled_brute.hpp"
#include "tools/demo/slow_stage.hpp"
#include "tools/io/view_of_cloud.hpp"
#include "tools/scene/tabletop.hpp"

namespace test_demo_large {

using namespace shortshot_bench;

TEST_CASE("a slow stage says what it is, a fast one nothing") {
  std::atomic<int> said{0};
  std::string line;
  const auto say = [&](const std::string& text) {
    line = text;
    ++said;
  };
  { const SlowStage fast("fast", std::chrono::hours(1), say); }
  CHECK(said == 0);
  {
    const SlowStage slow("counting sheep", std::chrono::milliseconds(0), say);
    while (said == 0) std::this_thread::yield();
  }
  CHECK(said == 1);
  CHECK(line == "... counting sheep: 0 s");
}

TEST_CASE("brute force is asked for all neighborhoods of small clouds, and for few of large ones") {
  CHECK(brute_share(19200, 20200) == 1);
  CHECK(brute_share(307200, 5000) == 1);
  const std::size_t whole_frame = brute_share(307200, 310000);
  CHECK(whole_frame > 40);
  CHECK(307200 * (310000 / whole_frame) < (std::size_t{1} << 32));
}

TEST_CASE("a sampled search asks brute force for its share, and finds what both find") {
  TabletopOptions options;
  options.width = 160;
  options.height = 120;
  const RgbdCloud scene = make_tabletop(options);
  const shortshot::CloudView view = view_of_cloud(scene);
  const SampledBruteSearch search(view, 0.04f, 10);
  std::size_t sampled = 0;
  for (std::size_t i = 0; i < view.size; ++i) sampled += search.is_sampled(shortshot::point(view, i)) ? 1 : 0;
  CHECK(sampled > view.size / 14);
  CHECK(sampled < view.size / 7);

  DemoOptions demo;
  const DemoResult all = run_demo(scene, demo);
  demo.search = "brute";
  demo.brute_share = 10;
  CHECK(run_demo(scene, demo).values == all.values);
  demo.descriptor = "shot352";
  demo.brute_share = 3;
  const std::vector<float> of_brute = run_demo(scene, demo).values;
  demo.search = "grid";
  CHECK(run_demo(scene, demo).values == of_brute);
}

}  // namespace test_demo_large
