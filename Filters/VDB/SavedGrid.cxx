#include "SavedGrid.h"

#include <stdexcept>

namespace activesurface
{

namespace
{

constexpr const char* TimeName = "active_pipeline_time";
constexpr const char* HistoryName = "active_history";

template <class Value>
Value ReadMetadata(const openvdb::GridBase& grid, const char* name)
{
  const auto metadata = grid.getMetadata<openvdb::TypedMetadata<Value>>(name);
  if (!metadata)
  {
    throw std::runtime_error(std::string("it has no ") + name);
  }
  return metadata->value();
}

}

openvdb::FloatGrid::Ptr MakeSavedGrid(const SavedBand& state)
{
  openvdb::FloatGrid::Ptr grid = state.Band->ToGrid();
  grid->setName(SavedGridName);
  grid->insertMeta(TimeName, openvdb::DoubleMetadata(state.Time));
  grid->insertMeta(HistoryName, openvdb::StringMetadata(state.History));
  return grid;
}

SavedBand ReadSavedGrid(const openvdb::FloatGrid& grid)
{
  SavedBand state;
  state.Band = NarrowBand::FromGrid(grid);
  state.Time = ReadMetadata<double>(grid, TimeName);
  state.History = ReadMetadata<std::string>(grid, HistoryName);
  return state;
}

}
