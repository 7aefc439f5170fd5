#include "Surface/PotentialImage.h"

#include "Base/OpenVDB.h"
#include "Leaves/CentralGradient.h"
#include "Leaves/LeafTable.h"
#include "NarrowBandGrid.h"
#include "Surface/SkinDistance.h"

#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

/** Returns u divided by its central gradient norm: a distance of first order [voxels]. */
float DistanceAt(
  const openvdb::tree::ValueAccessor<const PotentialTree>& potential, const openvdb::Coord& node)
{
  const float value = potential.getValue(node);
  if (!potential.isValueOn(node))
  {
    return value < 0.f ? -HalfWidth : HalfWidth;
  }
  const float square = CentralGradientSquare<float>(
    node, [&potential](const openvdb::Coord& next) { return potential.getValue(next); });
  // Where the gradient vanishes, on a medial axis, the quotient would be infinite or NaN.
  const float distance = square > 0.f ? value / std::sqrt(square) : value;
  return std::min(std::max(distance, -HalfWidth), HalfWidth);
}

void WritePlane(
  const PotentialTree& tree, const int extent[6], int z, float voxelSize, float* distances)
{
  openvdb::tree::ValueAccessor<const PotentialTree> potential(tree);
  for (int y = extent[2]; y <= extent[3]; ++y)
  {
    for (int x = extent[0]; x <= extent[1]; ++x)
    {
      *distances++ = voxelSize * DistanceAt(potential, openvdb::Coord(x, y, z));
    }
  }
}

}

void WriteDistances(const NarrowBand& band, const int extent[6], float* distances)
{
  const std::size_t plane =
    (std::size_t(extent[1] - extent[0]) + 1) * (std::size_t(extent[3] - extent[2]) + 1);
  band.Run(
    [&]
    {
      tbb::parallel_for(extent[4], extent[5] + 1,
        [&](int z)
        {
          WritePlane(GetPotential(band)->tree(), extent, z, static_cast<float>(band.GetVoxelSize()),
            distances + std::size_t(z - extent[4]) * plane);
        });
    });
}

}
