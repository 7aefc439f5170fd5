#include "Grid/LevelSetSamples.h"

#include "Base/LatticeCell.h"
#include "Base/LatticeShape.h"
#include "Base/OpenVDB.h"
#include "Base/StaticShutdown.h"
#include "Base/Trilinear.h"
#include "Grid/InsideMask.h"

#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace activesurface
{

LevelSetSamples::LevelSetSamples(const openvdb::FloatGrid::ConstPtr& grid, const ImageLevel& level)
  : Grid(grid)
  , IsoValue(level.IsoValue)
  , Sign(level.InvertInside ? -1.0 : 1.0)
  , ToIndex(grid->transform().baseMap()->getAffineMap()->getMat4().inverse())
  , Box(grid->evalActiveVoxelBoundingBox())
{
  if (this->Box.empty())
  {
    throw std::invalid_argument(
      "The level set is empty: it has no active voxels; choose another grid.");
  }
  if (!std::isfinite(level.IsoValue))
  {
    throw std::invalid_argument("IsoValue has to be a finite number.");
  }
}

LevelSetSamples::~LevelSetSamples()
{
  ReleaseUnlessExiting(std::move(this->Grid));
}

double LevelSetSamples::Evaluate(const double x[3], double* gradient) const
{
  const openvdb::Vec3d place = this->ToIndex.transform(openvdb::Vec3d(x[0], x[1], x[2]));
  const bool isFinite = std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
  if (gradient)
  {
    std::fill_n(gradient, 3, isFinite ? 0.0 : std::numeric_limits<double>::quiet_NaN());
  }
  if (!isFinite)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (IsBeyond(this->Box, place.asPointer()))
  {
    return this->Sign * (this->Grid->background() - this->IsoValue);
  }
  const LatticeCell cell(place.asPointer());
  // An accessor that is not registered with the tree is cheap to construct, in any thread.
  const openvdb::tree::ValueAccessor<const openvdb::FloatTree, false> grid(this->Grid->tree());
  double corner[CornersOfCell], rise[3];
  for (int c = 0; c < CornersOfCell; ++c)
  {
    corner[c] = this->Sign * (grid.getValue(cell.Corner(c)) - this->IsoValue);
  }
  const double value = Trilinear(corner, cell.Fraction, rise);
  for (int d = 0; gradient && d < 3; ++d)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      gradient[d] += rise[axis] * this->ToIndex(d, axis);
    }
  }
  return value;
}

bool LevelSetSamples::GetBounds(double bounds[6]) const
{
  const openvdb::BBoxd box = this->Grid->transform().indexToWorld(this->Box);
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] = box.min()[axis];
    bounds[2 * axis + 1] = box.max()[axis];
  }
  return true;
}

bool LevelSetSamples::FindShape(double level, LatticeShape& shape) const
{
  const auto isInside = [this, level](float value)
  { return this->Sign * (value - this->IsoValue) < level; };
  if (isInside(this->Grid->background()))
  {
    return false;
  }
  FindInside(this->Grid->tree(), isInside, shape.Inside);
  const openvdb::math::Mat4d toWorld = this->ToIndex.inverse();
  shape.Origin = toWorld.transform(openvdb::Vec3d(0.0));
  for (int axis = 0; axis < 3; ++axis)
  {
    openvdb::Vec3d unit(0.0);
    unit[axis] = 1.0;
    shape.Axis[axis] = toWorld.transform(unit) - shape.Origin;
  }
  return true;
}

}
