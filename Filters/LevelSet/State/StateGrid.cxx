#include "State/StateGrid.h"

#include "Base/OpenVDB.h"
#include "Leaves/LeafFaces.h"
#include "Leaves/LeafTable.h"

#include <openvdb/math/Transform.h>

#include <algorithm>
#include <cmath>
#include <openvdb/tree/ValueAccessor.h>
#include <stdexcept>

namespace activesurface
{

namespace
{

constexpr const char* Names[] = { "active_voxel_size", "active_time", "active_start_area",
  "active_start_volume", "active_box_size", "active_paper_scheme" };
constexpr const char* WithoutGhosts = "active_without_ghosts"; // present only without ghosts

/** Grids with smaller voxels get a transform of voxel size 1, because OpenVDB rejects voxels below
 * about 1e-5. */
constexpr double SmallestVoxel = 1e-4;

double GetNumber(const openvdb::FloatGrid& grid, const char* name)
{
  const auto number = grid.getMetadata<openvdb::DoubleMetadata>(name);
  if (!number || !std::isfinite(number->value()))
  {
    throw std::runtime_error(
      std::string("the number ") + name + " of the saved state is missing or not finite.");
  }
  return number->value();
}

}

openvdb::FloatGrid::Ptr MakeStateGrid(
  const openvdb::FloatTree& potential, const StateNumbers& numbers)
{
  auto grid = openvdb::FloatGrid::create(potential.background());
  auto tree = std::make_shared<openvdb::FloatTree>(potential);
  const float background = numbers.Background;
  for (auto leaf = tree->beginLeaf(); leaf; ++leaf)
  {
    for (auto value = leaf->beginValueOff(); value; ++value)
    {
      if (!numbers.HasGhosts && std::fabs(*value) < background)
      {
        leaf->setValueOn(value.pos());
      }
      else
      {
        value.setValue(*value < 0.f ? -background : background);
      }
    }
  }
  grid->setTree(tree);
  grid->setName("potential");
  grid->setTransform(openvdb::math::Transform::createLinearTransform(
    numbers.VoxelSize >= SmallestVoxel ? numbers.VoxelSize : 1.0));
  const double values[] = { numbers.VoxelSize, numbers.Time, numbers.StartArea, numbers.StartVolume,
    numbers.BoxSize, numbers.Paper ? 1.0 : 0.0 };
  for (int i = 0; i < 6; ++i)
  {
    grid->insertMeta(Names[i], openvdb::DoubleMetadata(values[i]));
  }
  if (!numbers.HasGhosts)
  {
    grid->insertMeta(WithoutGhosts, openvdb::BoolMetadata(true));
  }
  return grid;
}

StateNumbers ReadStateGrid(const openvdb::FloatGrid& grid)
{
  StateNumbers numbers;
  numbers.VoxelSize = GetNumber(grid, Names[0]);
  numbers.Time = GetNumber(grid, Names[1]);
  numbers.StartArea = GetNumber(grid, Names[2]);
  numbers.StartVolume = GetNumber(grid, Names[3]);
  numbers.BoxSize = GetNumber(grid, Names[4]);
  numbers.Paper = GetNumber(grid, Names[5]) != 0.0;
  numbers.HasGhosts = !grid.getMetadata<openvdb::BoolMetadata>(WithoutGhosts);
  for (auto value = grid.cbeginValueOn(); value; ++value)
  {
    if (!std::isfinite(*value))
    {
      throw std::runtime_error(
        "a value of the saved potential is not finite; the file is damaged.");
    }
  }
  CheckTree(grid.tree());
  return numbers;
}

namespace
{

/** Returns true if a coordinate of an origin is beyond +-2^30 nodes. No surface gets so far, and
 * coordinates of neighbours might overflow. */
bool IsTooFar(const openvdb::Coord& origin)
{
  constexpr int farthest = 1 << 30;
  return std::any_of(origin.data(), origin.data() + 3,
    [](int coordinate) { return coordinate < -farthest || coordinate > farthest; });
}

}

void CheckTree(const openvdb::FloatTree& tree)
{
  const openvdb::FloatGrid::ConstAccessor recent(tree);
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf)
  {
    if (IsTooFar(leaf->origin()))
    {
      RefuseState();
    }
    const LeafMask inside = InsideNodes(leaf->buffer().data());
    for (int face = 0; face < 6; ++face)
    {
      const int axis = face / 2, sign = face % 2 ? 1 : -1;
      openvdb::Coord next = leaf->origin();
      next[axis] += sign * 8;
      if (recent.probeConstLeaf(next))
      {
        continue;
      }
      const bool isInside = recent.getValue(next) < 0.f;
      if (TouchesFace(isInside ? LeafMask::All().Without(inside) : inside, axis, sign))
      {
        RefuseState();
      }
    }
  }
}

void RefuseState()
{
  throw std::runtime_error("the saved state is damaged.");
}

}
