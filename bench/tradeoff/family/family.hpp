// The relatives of ShapeColor95: every combination of these grids of points, of mean colors and of color histograms.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "tradeoff/candidate.hpp"

namespace shortshot_bench::tradeoff {

/// All of them but those that have a name of their own, by the grid of points.
std::vector<Candidate> family();

namespace family_detail {

/// Lists of parts, to be put together.
template <class... Parts>
struct List {};
template <class... A, class... B, class... C>
auto joined(List<A...>, List<B...>, List<C...>)
    -> shortshot::Descriptor<shortshot::MultilinearVoting, A..., B..., C...>;

struct NoPoints {
  using Parts = List<>;
  static std::string name() { return {}; }
};
template <int R, int E, int A>
struct Points {
  using Parts = List<shortshot::HeightPart<shortshot::SphericalGrid<R, E, A>>>;
  static std::string name() { return "h" + std::to_string(R) + "x" + std::to_string(E) + "x" + std::to_string(A); }
};

struct NoMeans {
  using Parts = List<>;
  static std::string name() { return {}; }
};
template <int R, int A>
struct Means {
  using Parts = List<shortshot::ColorMeansPart<shortshot::SphericalGrid<R, 1, A>, 100>>;
  static std::string name() { return "m" + std::to_string(R) + "x" + std::to_string(A); }
};

struct NoRings {
  using Parts = List<>;
  static std::string name() { return {}; }
};
template <int R, int Bins>
struct Rings {
  template <shortshot::LabAxis Axis>
  using Of = shortshot::ColorRingsPart<R, Axis, Bins>;
  using Parts = List<Of<shortshot::LabAxis::L>, Of<shortshot::LabAxis::a>, Of<shortshot::LabAxis::b>>;
  static std::string name() { return "c" + std::to_string(R) + "x" + std::to_string(Bins); }
};

template <class D>
inline constexpr bool has_name =
    std::is_same_v<D, shortshot::ShapeColor95> || std::is_same_v<D, shortshot::ColorRings27>;

template <class P, class M, class C>
void add_member(std::vector<Candidate>& members) {
  if constexpr (!std::is_same_v<P, NoPoints> || !std::is_same_v<M, NoMeans> || !std::is_same_v<C, NoRings>) {
    using D = decltype(joined(typename P::Parts{}, typename M::Parts{}, typename C::Parts{}));
    if constexpr (!has_name<D>) {
      std::string name;
      for (const std::string& part : {P::name(), M::name(), C::name()}) {
        if (!part.empty()) name += (name.empty() ? "" : "-") + part;
      }
      Candidate c = candidate<D>(std::move(name), Kind::relative);
      constexpr int steps = D::size > 100 ? 50 : 40;  // in 1: few values are cut off
      members.push_back(with_nibbles<D, steps>(c));
    }
  }
}

template <class P, class M>
void add_rings(std::vector<Candidate>& members) {
  add_member<P, M, NoRings>(members);
  add_member<P, M, Rings<2, 4>>(members);
  add_member<P, M, Rings<3, 6>>(members);
}

template <class P>
void add_grid(std::vector<Candidate>& members) {
  add_rings<P, NoMeans>(members);
  add_rings<P, Means<2, 4>>(members);
  add_rings<P, Means<3, 8>>(members);
}

}  // namespace family_detail
}  // namespace shortshot_bench::tradeoff
