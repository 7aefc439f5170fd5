#include "NarrowBandGrid.h"

#include "BandState.h"

namespace activesurface
{

openvdb::FloatGrid::ConstPtr GetPotential(const NarrowBand& band)
{
  return band.GetState().Potential;
}

openvdb::FloatGrid::Ptr ToGrid(const NarrowBand& band)
{
  const BandState& state = band.GetState();
  return MakeStateGrid(state.Potential->tree(), state.GetNumbers());
}

std::unique_ptr<NarrowBand> FromGrid(const openvdb::FloatGrid& grid)
{
  const StateNumbers numbers = ReadStateGrid(grid);
  auto band = std::make_unique<NarrowBand>(numbers.VoxelSize);
  BandState& state = band->GetState();
  state.SetNumbers(numbers);
  band->Run([&] { state.Restore(std::make_shared<openvdb::FloatTree>(grid.tree())); });
  return band;
}

}
