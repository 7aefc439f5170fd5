#include "Grids/GridChoice.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace activesurface
{

namespace
{

std::string ListNames(const VDBFile& file)
{
  std::string names;
  for (const VDBGrid& grid : file.Grids)
  {
    names += (names.empty() ? "" : ", ") + grid.Name + " (" + grid.GetValueType() + ")";
  }
  return names.empty() ? "none" : names;
}

// Preference of a grid: the lowest is best; negative for grids that cannot be read.
int Rank(const VDBGrid& grid)
{
  const auto kind = grid.Metadata->getMetadata<openvdb::StringMetadata>("class");
  const std::string name = kind ? kind->value() : "";
  if (!grid.IsKnown)
  {
    return -1;
  }
  return name == "level set"                       ? 0
    : name == "fog volume"                         ? 1
    : std::string(grid.GetValueType()) == "points" ? 2
                                                   : 3;
}

VDBGrid ChooseBest(const VDBFile& file)
{
  const VDBGrid* best = nullptr;
  for (const VDBGrid& grid : file.Grids)
  {
    if (Rank(grid) >= 0 && (!best || Rank(grid) < Rank(*best)))
    {
      best = &grid;
    }
  }
  if (!best)
  {
    throw std::invalid_argument(
      "The file has no grid that can be read; its grids are: " + ListNames(file) + ".");
  }
  return *best;
}

const VDBGrid& FindGrid(const VDBFile& file, const std::string& name)
{
  for (const VDBGrid& grid : file.Grids)
  {
    if (grid.Name == name || grid.Name == name + "[0]")
    {
      return grid;
    }
  }
  throw std::invalid_argument(
    "The file has no grid \"" + name + "\"; its grids are: " + ListNames(file) + ".");
}

std::vector<VDBGrid> Choose(const VDBFile& file, const std::vector<std::string>& names)
{
  if (names.empty())
  {
    return { ChooseBest(file) };
  }
  std::vector<VDBGrid> grids;
  for (const std::string& name : names)
  {
    const VDBGrid& grid = FindGrid(file, name);
    if (!grid.IsKnown)
    {
      throw std::invalid_argument("The grid \"" + name + "\" cannot be read: it is of the type " +
        grid.Type + (grid.Transform ? "." : ", and placed by no linear transform."));
    }
    grids.push_back(grid);
    const bool isPoints = std::string(grid.GetValueType()) == "points";
    if (names.size() > 1 && (isPoints || *grid.Transform != *grids.front().Transform))
    {
      throw std::invalid_argument("The grid \"" + name +
        "\" cannot be read together with others: they have to be volumes of one transform.");
    }
  }
  return grids;
}

}

bool ChosenGrids::AreOfPoints() const
{
  return !this->Grids.empty() && std::string(this->Grids.front().GetValueType()) == "points";
}

openvdb::CoordBBox ChosenGrids::FindActiveBox() const
{
  openvdb::CoordBBox box;
  for (const VDBGrid& grid : this->Grids)
  {
    box.expand(grid.ActiveBox);
  }
  return box;
}

ChosenGrids ChooseGrids(const std::string& fileName, const std::vector<std::string>& names)
{
  ChosenGrids chosen;
  chosen.FileName = fileName;
  chosen.File = ValidateVDB(fileName);
  chosen.Grids = Choose(chosen.File, names);
  return chosen;
}

double ImagePlace::CountPoints() const
{
  double count = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    count *= std::max(0.0, double(this->Extent[2 * axis + 1]) - this->Extent[2 * axis] + 1.0);
  }
  return count;
}

ImagePlace MakeImagePlace(
  const openvdb::math::Transform& transform, const openvdb::CoordBBox& box, int factor)
{
  const openvdb::Mat4d matrix = transform.baseMap()->getAffineMap()->getMat4();
  ImagePlace place;
  openvdb::Vec3d axes[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    axes[axis] = { matrix(axis, 0), matrix(axis, 1), matrix(axis, 2) };
    // Exact for axis-aligned vectors.
    const openvdb::Vec3d size = openvdb::math::Abs(axes[axis]);
    const double length =
      size.sum() == openvdb::math::Max(size[0], size[1], size[2]) ? size.sum() : size.length();
    axes[axis] /= length;
    place.Spacing[axis] = factor * length;
    place.Origin[axis] = matrix(3, axis);
    for (int d = 0; d < 3; ++d)
    {
      place.Direction[3 * d + axis] = axes[axis][d];
    }
    if (!box.empty())
    {
      place.Extent[2 * axis] = static_cast<int>(std::floor(box.min()[axis] / double(factor)));
      place.Extent[2 * axis + 1] = static_cast<int>(std::ceil(box.max()[axis] / double(factor)));
    }
  }
  constexpr double slack = 1e-6;
  const double skew = std::fabs(axes[0].dot(axes[1])) + std::fabs(axes[1].dot(axes[2])) +
    std::fabs(axes[2].dot(axes[0]));
  if (!(skew <= slack))
  {
    throw std::invalid_argument(
      "The grid is sheared: its axes are not at right angles, as those of "
      "an image have to be. Resample it (vdb_tool, Houdini) first.");
  }
  return place;
}

openvdb::CoordBBox FindVoxels(const int region[6])
{
  constexpr int farthest = 1 << 30;
  const auto isFar = [](int x) { return x < -farthest || x > farthest; };
  if (std::any_of(region, region + 6, isFar) || region[0] > region[1] || region[2] > region[3] ||
    region[4] > region[5])
  {
    throw std::invalid_argument("IndexRegion is empty, or beyond 2^30.");
  }
  return { { region[0], region[2], region[4] }, { region[1], region[3], region[5] } };
}

openvdb::CoordBBox FindVoxels(const openvdb::math::Transform& transform, const double bounds[6])
{
  openvdb::BBoxd index;
  bool isFinite = true;
  for (int corner = 0; corner < 8; ++corner)
  {
    const openvdb::Vec3d x(
      bounds[corner & 1], bounds[2 + (corner >> 1 & 1)], bounds[4 + (corner >> 2)]);
    const openvdb::Vec3d place = transform.worldToIndex(x);
    constexpr double farthest = 1 << 30;
    isFinite = isFinite && place.isFinite() && openvdb::math::Abs(place).sum() < farthest;
    index.expand(place);
  }
  if (!isFinite || bounds[0] > bounds[1] || bounds[2] > bounds[3] || bounds[4] > bounds[5])
  {
    throw std::invalid_argument("WorldRegion is empty, not finite or too far from the grid.");
  }
  return { openvdb::Coord::floor(index.min()), openvdb::Coord::ceil(index.max()) };
}

}
