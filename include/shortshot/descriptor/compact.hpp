// shortshot/descriptor/compact.hpp: compact descriptors. They find more than the published ones in a fraction of the
// bytes: one pass of soft votes in SHOT's frame, nothing learned.
//
// What they are made of: cells are slices of height over the tangent plane; every vote is shared among all cells around
// it (MultilinearVoting); colors are compared with the mean of the neighborhood's, along L, a and b and with their
// signs; square roots keep crowded cells from deciding alone; and each kind of part has a length of its own. They are
// to be stored in four bits a value: the bytes in their names. Best in a frame whose z axis is turned to the camera
// (Support::viewpoint); without a viewpoint it is SHOT's own.
#pragma once

#include "../config.hpp"
#include "conventions.hpp"
#include "descriptor.hpp"
#include "finish_rules.hpp"
#include "signals.hpp"
#include "spherical_grid.hpp"
#include "voting.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Where points are: the roots of the shares that cells have of all points. Length 1.
template <class Grid>
using HeightPart = Part<Grid, Occupancy, LinearRadius, HeightCells, RootOfShares<1000>>;

/// Where colors are: how each cell's mean color differs from the neighborhood's. Length 0.6 at most, less where there
/// is little contrast.
template <class Grid, int FloorPercent>
using ColorMeansPart = CellMeans<Grid, HeightCells, SignedRoots<600, FloorPercent>, 30, ColorOffset<LabAxis::L>,
                                 ColorOffset<LabAxis::a>, ColorOffset<LabAxis::b>>;

/// The same for rooms, where near things hide far ones: what is above the mean and what is below, apart.
template <class Grid, int FloorPercent>
using ColorExcessPart = CellMeans<Grid, HeightCells, SignedRoots<600, FloorPercent>, 30, ColorExcess<LabAxis::L, 1>,
                                  ColorExcess<LabAxis::L, -1>, ColorExcess<LabAxis::a, 1>, ColorExcess<LabAxis::a, -1>,
                                  ColorExcess<LabAxis::b, 1>, ColorExcess<LabAxis::b, -1>>;

/// Which colors there are, in rings around the key point and whatever the azimuth: the roots of a histogram along one
/// axis of CIELAB. All three together have the length 1.5.
template <int Rings, LabAxis Axis, int Bins>
using ColorRingsPart =
    Part<SphericalGrid<Rings, 1, 1>, ColorOffset<Axis, Bins>, LinearRadius, HeightCells, RootOfShares<866>>;

/// Shape and color in 95 bytes (190 values), the one to begin with: 2 x 4 x 8 cells of points | 3 x 8 mean colors |
/// histograms of L, a and b in 3 rings of 6 bins.
using ShapeColor95 =
    Descriptor<MultilinearVoting, HeightPart<SphericalGrid<2, 4, 8>>, ColorMeansPart<SphericalGrid<3, 1, 8>, 100>,
               ColorRingsPart<3, LabAxis::L, 6>, ColorRingsPart<3, LabAxis::a, 6>, ColorRingsPart<3, LabAxis::b, 6>>;

/// The same in 32 bytes (64 values): 2 x 4 mean colors | histograms in 2 rings of 4 bins | 1 x 4 x 4 cells of points.
using ShapeColor32 =
    Descriptor<MultilinearVoting, ColorMeansPart<SphericalGrid<2, 1, 4>, 49>, ColorRingsPart<2, LabAxis::L, 4>,
               ColorRingsPart<2, LabAxis::a, 4>, ColorRingsPart<2, LabAxis::b, 4>, HeightPart<SphericalGrid<1, 4, 4>>>;

/// For rooms, 95 bytes (190 values, none of them negative): 2 x 4 x 8 cells of points | 2 x 8 mean excesses |
/// histograms in 2 rings of 5 bins.
using RoomColor95 =
    Descriptor<MultilinearVoting, HeightPart<SphericalGrid<2, 4, 8>>, ColorExcessPart<SphericalGrid<2, 1, 8>, 100>,
               ColorRingsPart<2, LabAxis::L, 5>, ColorRingsPart<2, LabAxis::a, 5>, ColorRingsPart<2, LabAxis::b, 5>>;

/// For cameras without color, 96 bytes (192 values): 3 x 8 x 8 cells of points.
using HeightShape96 = Descriptor<MultilinearVoting, HeightPart<SphericalGrid<3, 8, 8>>>;

/// Colors alone in 27 bytes (54 values): histograms in 3 rings of 6 bins. No turn of the frame changes it; a change of
/// light does.
using ColorRings27 = Descriptor<MultilinearVoting, ColorRingsPart<3, LabAxis::L, 6>, ColorRingsPart<3, LabAxis::a, 6>,
                                ColorRingsPart<3, LabAxis::b, 6>>;

static_assert(ShapeColor95::size == 190 && ShapeColor32::size == 64 && RoomColor95::size == 190 &&
                  HeightShape96::size == 192 && ColorRings27::size == 54,
              "two values a byte");

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot
