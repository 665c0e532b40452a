// The descriptors that golden vectors may hold, by name.
#pragma once

#include <tuple>

#include "shortshot/descriptor/compact.hpp"
#include "shortshot/descriptor/descriptor.hpp"
#include "shortshot/descriptor/spherical_grid.hpp"

namespace shortshot_bench::golden {

template <class D>
struct Named {
  using Descriptor = D;
  const char* name;
};

template <int R, int E, int A>
using Grid = shortshot::SphericalGrid<R, E, A>;

inline constexpr std::tuple named_descriptors = {
    Named<shortshot::Ssh<Grid<1, 1, 8>>>{"ssh8"},
    Named<shortshot::Ssh<Grid<2, 2, 4>>>{"ssh16"},
    Named<shortshot::Ssh32>{"ssh32"},
    Named<shortshot::Ssh<Grid<2, 4, 8>>>{"ssh64"},
    Named<shortshot::Ssh96>{"ssh96"},
    Named<shortshot::Ssh<Grid<8, 4, 8>>>{"ssh256"},
    Named<shortshot::Scsh336>{"scsh336"},
    Named<shortshot::Scsh696>{"scsh696"},
    Named<shortshot::Scsh<Grid<2, 2, 8>, Grid<1, 1, 8>, 10>>{"scsh_32_8_10"},
    Named<shortshot::Scsh<Grid<4, 4, 8>, Grid<2, 2, 8>, 30>>{"scsh_128_32_30"},
    Named<shortshot::PclShot352>{"shot352"},
    Named<shortshot::PclCshot1344>{"cshot1344"},
    Named<shortshot::ShapeColor95>{"shape_color95"},
    Named<shortshot::ShapeColor32>{"shape_color32"},
    Named<shortshot::RoomColor95>{"room_color95"},
    Named<shortshot::HeightShape96>{"height_shape96"},
    Named<shortshot::ColorRings27>{"color_rings27"},
};

}  // namespace shortshot_bench::golden
