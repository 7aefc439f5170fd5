#include "State/StateGrid.h"

#include "Base/OpenVDB.h"
#include "State/SavedTree.h"

#include <openvdb/math/Transform.h>

#include <cmath>
#include <stdexcept>

namespace activesurface
{

namespace
{

constexpr const char* Names[] = { "active_voxel_size", "active_time", "active_start_area",
  "active_start_volume", "active_box_size", "active_paper_scheme" };
constexpr const char* WithoutGhosts = "active_without_ghosts"; // present only without ghosts

/** Grids with smaller voxels get a transform of voxel size 1: OpenVDB refuses voxels below about
 * 1e-5. */
constexpr double SmallestVoxel = 1e-4;

double GetNumber(const openvdb::FloatGrid& grid, const char* name)
{
  const auto number = grid.getMetadata<openvdb::DoubleMetadata>(name);
  if (!number || !std::isfinite(number->value()))
  {
    throw std::runtime_error(std::string("The grid is no saved state of a surface: ") + name +
      " is missing, or not a finite number.");
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
        "The saved potential is not finite everywhere; the file is damaged.");
    }
  }
  CheckTree(grid.tree());
  return numbers;
}

}
