// The SCSH family of the paper's section VI-C: every configuration of these grids and histograms below CSHOT's size.
#pragma once

#include <utility>
#include <vector>

#include "paper/configuration.hpp"

namespace shortshot_bench::paper {

/// One configuration, named n_g-n_c-h as in figure 5.
struct FamilyMember {
  int shape_cells;  // n_g
  int color_cells;  // n_c
  int bins;         // h
  Configuration configuration;
};

/// All of them, by color grid, shape grid and bins.
std::vector<FamilyMember> family();

namespace family_detail {

template <class ShapeGrid, class ColorGrid, int Bins>
void add_member(std::vector<FamilyMember>& members) {
  using D = shortshot::Scsh<ShapeGrid, ColorGrid, Bins>;
  if constexpr (D::size < shortshot::Cshot1344::size) {
    constexpr int n_g = ShapeGrid::cells;
    constexpr int n_c = ColorGrid::cells;
    members.push_back({n_g, n_c, Bins,
                       configuration<D>(std::to_string(n_g) + '-' + std::to_string(n_c) + '-' + std::to_string(Bins))});
  }
}

template <class ShapeGrid, class ColorGrid, int... Bins>
void add_members(std::vector<FamilyMember>& members, std::integer_sequence<int, Bins...>) {
  (add_member<ShapeGrid, ColorGrid, Bins>(members), ...);
}

using AllBins = std::integer_sequence<int, 5, 10, 15, 20, 25, 30, 35>;

/// The histograms of figure 5 on one color grid; and for the two configurations of table I the other shape grids.
template <class ColorGrid>
void add_color_grid(std::vector<FamilyMember>& members) {
  using shortshot::SphericalGrid;
  add_members<SphericalGrid<3, 4, 8>, ColorGrid>(members, AllBins{});
  constexpr int bins_of_table = ColorGrid::cells == 16 ? 15 : ColorGrid::cells == 24 ? 25 : 0;
  if constexpr (bins_of_table != 0) {
    using Bins = std::integer_sequence<int, bins_of_table>;
    add_members<SphericalGrid<2, 2, 4>, ColorGrid>(members, Bins{});
    add_members<SphericalGrid<2, 2, 8>, ColorGrid>(members, Bins{});
    add_members<SphericalGrid<2, 4, 8>, ColorGrid>(members, Bins{});
    add_members<SphericalGrid<4, 4, 8>, ColorGrid>(members, Bins{});
    add_members<SphericalGrid<4, 6, 8>, ColorGrid>(members, Bins{});
  }
}

}  // namespace family_detail
}  // namespace shortshot_bench::paper
