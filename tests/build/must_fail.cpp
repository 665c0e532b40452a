// Configurations that cannot work. CASE 0 is what does work; every other one must be refused by a message that says
// what is supported. The library is included by the command line.
#include <array>

namespace {

using shortshot::Workspace;
template <int R, int E, int A>
using Grid = shortshot::SphericalGrid<R, E, A>;

struct FloatPoint {
  float x, y, z;
};
struct DoublePoint {
  double x, y, z;
};

}  // namespace

#if CASE == 0
constexpr std::array<FloatPoint, 1> kept_points{};
static_assert(Grid<1, 4, 8>::cells == 32, "");
static_assert(shortshot::ColorDistance<1>::bins == 1, "");
static_assert(shortshot::Shot<Grid<2, 2, 8>, 1>::size == 64, "");
static_assert(sizeof(Workspace<5>) == 100, "");
static_assert(sizeof(shortshot::LogRadius<1, 2>) == 1, "");
static_assert(sizeof(shortshot::StaticGrid<1, 1>) > 0, "");
shortshot::CloudView view() { return shortshot::view_of(kept_points); }
#elif CASE == 1
static_assert(Grid<0, 4, 8>::cells == 0, "");
#elif CASE == 2
static_assert(shortshot::ColorDistance<0>::bins == 0, "");
#elif CASE == 3
Workspace<0> workspace;
#elif CASE == 4
static_assert(sizeof(shortshot::LogRadius<2, 1>) == 1, "");
#elif CASE == 5
shortshot::CloudView view(const std::array<DoublePoint, 2>& cloud) { return shortshot::view_of(cloud); }
#elif CASE == 6
shortshot::CloudView view() { return shortshot::view_of(std::array<FloatPoint, 2>{}); }
#elif CASE == 7
shortshot::StaticGrid<0, 8> grid;
#elif CASE == 8
static_assert(Grid<2000, 1, 1>::cells == 2000, "");
#elif CASE == 9
static_assert(shortshot::Descriptor<shortshot::PublishedVoting>::size == 0, "");
#elif CASE == 10
static_assert(shortshot::Ssh<Grid<64, 64, 64>>::size == 262144, "");
#elif CASE == 11
shortshot::GridIndex<int> grid;
#elif CASE == 12
static_assert(Grid<1024, 1024, 1024>::cells > 0, "");
#elif CASE == 13
template <class Rule>
using ColorPart = shortshot::Part<Grid<1, 1, 4>, shortshot::ColorDistance<5, Rule>>;
using TwoRules =
    shortshot::Descriptor<shortshot::PublishedVoting, ColorPart<shortshot::PublishedLab>, ColorPart<shortshot::PclLab>>;
static_assert(TwoRules::size == 40, "");
#elif CASE == 14
shortshot::Status wrong_rule(const shortshot::Neighborhood& n, const shortshot::CloudView& cloud, float* out) {
  return shortshot::describe<shortshot::Scsh336>(n, shortshot::RgbColors<shortshot::PclLab>{cloud, {}}, {}, 0.1f, out);
}
#elif CASE == 15
shortshot::Status no_colors(const shortshot::Neighborhood& n, float* out) {
  return shortshot::describe<shortshot::Scsh336>(n, shortshot::sources(), {}, 0.1f, out);
}
#elif CASE == 16
shortshot::Status no_executor(const shortshot::CloudView& cloud, shortshot::Features<shortshot::Ssh32>& out) {
  const std::vector<int> keypoints;
  return shortshot::extract(cloud, shortshot::BruteSearch{cloud}, keypoints, 0.1f, out, 2.0f);
}
#elif CASE == 17
shortshot::Extractor<shortshot::Scsh336, shortshot::Rgb> extractor;
#elif CASE == 18
static_assert(shortshot::Shot<Grid<2, 2, 8>, 0>::size == 32, "");
#elif CASE == 19
template <class Cells>
using CellsPart = shortshot::Part<Grid<2, 2, 8>, shortshot::NormalCosine<10>, shortshot::LinearRadius, Cells>;
using TwoConventions =
    shortshot::Descriptor<shortshot::ShotVoting, CellsPart<shortshot::ShotCells>, CellsPart<shortshot::PublishedCells>>;
static_assert(TwoConventions::size > 0, "");
#elif CASE == 20
shortshot::Status no_normals(const shortshot::Neighborhood& n, float* out) {
  return shortshot::describe<shortshot::Shot352>(n, shortshot::sources(), {}, 0.1f, out);
}
#elif CASE == 21
struct NamelessVoting : shortshot::PublishedVoting {
  static constexpr int name = 0;
};
std::string text() { return shortshot::layout_of<shortshot::Ssh<Grid<2, 2, 8>, NamelessVoting>>(); }
#elif CASE == 22
template <int Bins>
struct Unmeasured : shortshot::extend::Signal<Bins> {  // nothing says where its values come from
  static constexpr const char* name = "unmeasured";
};
static_assert(shortshot::Part<Grid<2, 2, 8>, Unmeasured<15>>::size > 0, "");
#elif CASE == 23
template <int Bins>
struct Tinted
    : shortshot::extend::Signal<Bins, shortshot::CloudNormals, shortshot::RgbColors<shortshot::PublishedLab>> {
  static constexpr const char* name = "tinted";
  template <class At, class Normals>
  static shortshot::extend::simd::F32 measure(const At& at, const Normals& normals);  // one source of its two
};
static_assert(shortshot::Part<Grid<2, 2, 8>, Tinted<15>>::size > 0, "");
#elif CASE == 24
struct Loud {};
static_assert(shortshot::Part<Grid<2, 2, 8>, Loud>::size > 0, "");
#elif CASE == 25
struct Temperatures {
  static shortshot::Status status() { return shortshot::Status::ok; }
};
template <int Bins>
struct Warmth : shortshot::extend::Signal<Bins, Temperatures> {
  static constexpr const char* name = "warmth";
  template <class At>
  static shortshot::extend::simd::F32 measure(const At&, const Temperatures&) {
    return shortshot::extend::simd::all(0.5f);
  }
};
using D = shortshot::Descriptor<shortshot::PublishedVoting, shortshot::Part<Grid<2, 2, 8>, Warmth<15>>>;
shortshot::Status no_source(const shortshot::CloudView& cloud, shortshot::Features<D>& out) {
  return shortshot::extract(cloud, shortshot::BruteSearch{cloud}, std::vector<int>{0}, 0.1f, out);
}
#elif CASE == 26
struct Undecided {  // splits, and never combines
  static constexpr const char* name = "undecided";
  static constexpr int weight_bits = 2;
  static shortshot::extend::Share split(const shortshot::extend::Axis&, shortshot::extend::simd::I32,
                                        const shortshot::extend::VoteUnit&);
};
static_assert(shortshot::Ssh<Grid<2, 2, 8>, Undecided>::size > 0, "");
#elif CASE == 27
struct Blind {  // does not say over which cloud it searches
  static shortshot::Status status() { return shortshot::Status::ok; }
  template <class Neighbors>
  shortshot::Status gather(const shortshot::Point&, shortshot::Radius, Neighbors&) const;
};
shortshot::Status wrong_search(const shortshot::CloudView& cloud, float* out) {
  Workspace<5> workspace;
  return shortshot::describe_at<shortshot::Ssh32>(cloud, Blind{}, 0, 0.1f, workspace, out);
}
#elif CASE == 28
shortshot::NanoflannSearch search(shortshot::CloudView{});
#elif CASE == 29
shortshot::CloudView eigen_view(const std::array<float, 3>& matrix) { return shortshot::view_eigen(matrix); }
#elif CASE == 30
struct MuteRows {  // says how far apart two rows are, but not in what unit
  std::size_t count;
  const shortshot::Status* status;
  static bool fits(const MuteRows&) { return true; }
  static int compare(std::size_t, const MuteRows&, std::size_t) { return 0; }
};
shortshot::Status wrong_rows(const MuteRows& rows, std::vector<shortshot::Match>& out) {
  return shortshot::nearest(rows, rows, 1, out);
}
#elif CASE == 31
static_assert(shortshot::Descriptor<shortshot::MultilinearVoting,
                                    shortshot::Part<Grid<1, 1, 1>, shortshot::ColorOffset<shortshot::LabAxis::L, 4>>,
                                    shortshot::Part<Grid<1, 1, 1>, shortshot::ColorDistance<4>>>::compares_with_mean,
              "");
#elif CASE == 32
static_assert(shortshot::CellMeans<Grid<2, 1, 4>, shortshot::HeightCells, shortshot::SignedRoots<600, 100>, 30,
                                   shortshot::ColorDistance<1>>::size > 0,
              "");
#endif
