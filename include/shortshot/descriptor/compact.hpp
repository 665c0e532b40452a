// shortshot/descriptor/compact.hpp: compact descriptors. They find more than the published ones in a fraction of the
// bytes: one pass of soft votes in SHOT's frame, nothing learned.
//
// What they are made of: cells are slices of height over the tangent plane; every vote is shared among all cells around
// it (MultilinearVoting); colors are compared with the mean of the neighborhood's, along L, a and b and with their
// signs; square roots keep crowded cells from deciding alone; and each kind of part has a length of its own. They are
// to be stored in four bits a value: the bytes in their names. Best in a frame whose z axis is turned to the camera
// (Support::viewpoint); without a viewpoint it is SHOT's own.
//
// The formulas below speak of neighbors within the radius, W of them, copies of the key point left out. In the frame
// one lies at (x, y, z) and at the distance d:
//
//     u = d / radius                          along the radius: shells, from the key point outwards
//     e = 1/2 - z / radius, cut off to 0..1   along the height: slices, from half a radius above the tangent plane down
//     a = (atan2(y, x) + pi) / (2 pi)         along the azimuth: sectors, from -x counter-clockwise
//     dL, da, db                              its color (CIELAB, PublishedLab) less the mean of all within the radius,
//                                             where the key point and its copies count too
//
// On an axis of n cells a place from 0 to 1, times n, is t. Cell i = floor(t) (n - 1 at most) has the share f + 1/2 of
// the vote if f = t - i is at most 1/2, and cell i - 1 has the rest; else 3/2 - f, and cell i + 1 has the rest.
// Azimuths go around; beyond the other axes' ends the rest stays in cell i. The share w of a cell (r, e, a) of a grid
// of R x E x A cells, or of a bin in it, is the product over all axes: those of one neighbor add up to 1. A sum without
// bounds is over the neighbors.
#ifndef SHORTSHOT_DESCRIPTOR_COMPACT_HPP
#define SHORTSHOT_DESCRIPTOR_COMPACT_HPP

#include "../config.hpp"
#include "conventions.hpp"
#include "descriptor.hpp"
#include "finish_rules.hpp"
#include "signals.hpp"
#include "spherical_grid.hpp"
#include "voting.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Where points are: the roots of the shares that cells have of all points. Length 1. R E A values:
///
///     value[r + R (e + E a)] = sqrt(sum w / W)
template <class Grid>
using HeightPart = Part<Grid, Occupancy, LinearRadius, HeightCells, RootOfShares<1000>>;

/// Where colors are: how each cell's mean color differs from the neighborhood's. Length 0.7 at most, less where there
/// is little contrast, and a hundredth of q's range is taken for noise. 3 R E A values, k = 0, 1, 2 for q = dL / 100,
/// da / 60, db / 60:
///
///     m[c][k] = (sum w q[k]) / (sum w + 0.3 W / (R E A))      c = r + R (e + E a)
///     value[k + 3 c] = 0.7 sign(m) (sqrt(|m| + 0.01) - 0.1) / sqrt(FloorPercent / 100 + sum of all |m|)
template <class Grid, int FloorPercent>
using ColorMeansPart = CellMeans<Grid, HeightCells, SignedRoots<700, FloorPercent, 10>, 30, ColorOffset<LabAxis::L>,
                                 ColorOffset<LabAxis::a>, ColorOffset<LabAxis::b>>;

/// The same for rooms, where near things hide far ones: what is above the mean and what is below, apart. 6 R E A
/// values, value[k + 6 c], k = 0 to 5 for q = max(0, dL) / 100, max(0, -dL) / 100, max(0, da) / 60 and so on.
template <class Grid, int FloorPercent>
using ColorExcessPart = CellMeans<Grid, HeightCells, SignedRoots<700, FloorPercent, 10>, 30, ColorExcess<LabAxis::L, 1>,
                                  ColorExcess<LabAxis::L, -1>, ColorExcess<LabAxis::a, 1>, ColorExcess<LabAxis::a, -1>,
                                  ColorExcess<LabAxis::b, 1>, ColorExcess<LabAxis::b, -1>>;

/// Which colors there are, in rings around the key point and whatever the azimuth: the roots of a histogram along one
/// axis of CIELAB. All three together have the length 1.5. Rings * Bins values; the place along the bins is
/// 1/2 + dL / 80, 1/2 + da / 60 or 1/2 + db / 60, cut off to 0..1:
///
///     value[bin + Bins ring] = 0.866 sqrt(sum w / W)
template <int Rings, LabAxis Axis, int Bins>
using ColorRingsPart =
    Part<SphericalGrid<Rings, 1, 1>, ColorOffset<Axis, Bins>, LinearRadius, HeightCells, RootOfShares<866>>;

/// Shape and color in 95 bytes (190 values), the one to begin with: 2 x 4 x 8 cells of points | 3 x 8 mean colors |
/// histograms of L, a and b in 3 rings of 6 bins. In this and all others the whole is divided by its length.
///
///     0..63     r + 2 (e + 4 a)            points
///     64..135   64 + k + 3 (r + 3 a)       mean colors
///     136..153  136 + bin + 6 ring         L; 154..171 a; 172..189 b
using ShapeColor95 =
    Descriptor<MultilinearVoting, HeightPart<SphericalGrid<2, 4, 8>>, ColorMeansPart<SphericalGrid<3, 1, 8>, 100>,
               ColorRingsPart<3, LabAxis::L, 6>, ColorRingsPart<3, LabAxis::a, 6>, ColorRingsPart<3, LabAxis::b, 6>>;

/// The same in 32 bytes (64 values): 2 x 4 mean colors | histograms in 2 rings of 4 bins | 1 x 4 x 4 cells of points.
///
///     0..23     k + 3 (r + 2 a)            mean colors
///     24..31    24 + bin + 4 ring          L; 32..39 a; 40..47 b
///     48..63    48 + e + 4 a               points
using ShapeColor32 =
    Descriptor<MultilinearVoting, ColorMeansPart<SphericalGrid<2, 1, 4>, 49>, ColorRingsPart<2, LabAxis::L, 4>,
               ColorRingsPart<2, LabAxis::a, 4>, ColorRingsPart<2, LabAxis::b, 4>, HeightPart<SphericalGrid<1, 4, 4>>>;

/// For rooms, 95 bytes (190 values, none of them negative): 2 x 4 x 8 cells of points | 2 x 8 mean excesses |
/// histograms in 2 rings of 5 bins.
///
///     0..63     r + 2 (e + 4 a)            points
///     64..159   64 + k + 6 (r + 2 a)       mean excesses
///     160..169  160 + bin + 5 ring         L; 170..179 a; 180..189 b
using RoomColor95 =
    Descriptor<MultilinearVoting, HeightPart<SphericalGrid<2, 4, 8>>, ColorExcessPart<SphericalGrid<2, 1, 8>, 100>,
               ColorRingsPart<2, LabAxis::L, 5>, ColorRingsPart<2, LabAxis::a, 5>, ColorRingsPart<2, LabAxis::b, 5>>;

/// For cameras without color, 96 bytes (192 values): 3 x 8 x 8 cells of points, r + 3 (e + 8 a).
using HeightShape96 = Descriptor<MultilinearVoting, HeightPart<SphericalGrid<3, 8, 8>>>;

/// Colors alone in 27 bytes (54 values): histograms in 3 rings of 6 bins, of L from bin + 6 ring on, of a from 18, of b
/// from 36. It needs no frame (needs_frame), and no turn changes it; a change of light does.
using ColorRings27 = Descriptor<MultilinearVoting, ColorRingsPart<3, LabAxis::L, 6>, ColorRingsPart<3, LabAxis::a, 6>,
                                ColorRingsPart<3, LabAxis::b, 6>>;

static_assert(ShapeColor95::size == 190 && ShapeColor32::size == 64 && RoomColor95::size == 190 &&
                  HeightShape96::size == 192 && ColorRings27::size == 54,
              "two values a byte");

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

#endif  // SHORTSHOT_DESCRIPTOR_COMPACT_HPP
