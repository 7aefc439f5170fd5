#include "SavedGrid.h"

#include "NarrowBandGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string>

namespace activesurface
{

namespace
{

constexpr const char* TimeName = "active_pipeline_time";
constexpr const char* HistoryName = "active_history";
constexpr const char* OutsideName = "active_history_outside"; // absent from files of older versions
constexpr const char* OriginName = "active_origin";           // absent if 0
constexpr const char* SpacingName = "active_spacing";         // absent if unknown
constexpr const char* ReachName = "active_reach";             // absent without a domain
constexpr const char* LowName = "active_bounds_low";          // absent without a domain
constexpr const char* HighName = "active_bounds_high";

template <class Value>
Value ReadMetadata(const openvdb::GridBase& grid, const char* name)
{
  const auto metadata = grid.getMetadata<openvdb::TypedMetadata<Value>>(name);
  if (!metadata)
  {
    throw std::runtime_error(std::string("it has no valid ") + name);
  }
  return metadata->value();
}

std::string WriteHistory(const std::vector<HistoryRow>& rows)
{
  std::string text;
  for (const HistoryRow& row : rows)
  {
    char line[256];
    std::snprintf(line, sizeof line, "%a %zu %a %a %a %zu %d %d %lld ", row.Time, row.Substeps,
      row.MaxSpeed, row.Area, row.Volume, row.ActiveVoxels, row.Components, row.Voids,
      row.EulerCharacteristic);
    text += line + row.Event + "\n";
  }
  return text;
}

std::vector<HistoryRow> ReadHistory(const std::string& text)
{
  std::vector<HistoryRow> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    HistoryRow row;
    int end = 0;
    const int read = std::sscanf(line.c_str(), "%la %zu %la %la %la %zu %d %d %lld %n", &row.Time,
      &row.Substeps, &row.MaxSpeed, &row.Area, &row.Volume, &row.ActiveVoxels, &row.Components,
      &row.Voids, &row.EulerCharacteristic, &end);
    if (read != 9)
    {
      throw std::runtime_error("its history is damaged");
    }
    row.Event = line.substr(static_cast<std::size_t>(end));
    rows.push_back(row);
  }
  return rows;
}

std::string WriteOutside(const std::vector<HistoryRow>& rows)
{
  std::string text;
  for (const HistoryRow& row : rows)
  {
    char line[32];
    std::snprintf(line, sizeof line, "%a\n", row.Outside);
    text += line;
  }
  return text;
}

void ReadOutside(const openvdb::GridBase& grid, std::vector<HistoryRow>& rows)
{
  const auto text = grid.getMetadata<openvdb::StringMetadata>(OutsideName);
  std::istringstream lines(text ? text->value() : "");
  for (HistoryRow& row : rows)
  {
    std::string line;
    row.Outside = std::nan("");
    if (text && (!std::getline(lines, line) || std::sscanf(line.c_str(), "%la", &row.Outside) != 1))
    {
      throw std::runtime_error("its history is damaged");
    }
  }
}

// Returns 0 if the grid has no number of this name.
double ReadLength(const openvdb::GridBase& grid, const char* name)
{
  const auto length = grid.getMetadata<openvdb::DoubleMetadata>(name);
  if (length && !(length->value() > 0.0 && std::isfinite(length->value())))
  {
    throw std::runtime_error(std::string("its ") + name + " is damaged");
  }
  return length ? length->value() : 0.0;
}

void ReadDomain(const openvdb::GridBase& grid, SavedState& state)
{
  state.Reach = ReadLength(grid, ReachName);
  if (state.Reach == 0.0)
  {
    return;
  }
  const auto low = ReadMetadata<openvdb::Vec3d>(grid, LowName);
  const auto high = ReadMetadata<openvdb::Vec3d>(grid, HighName);
  for (int axis = 0; axis < 3; ++axis)
  {
    state.Bounds[2 * axis] = low[axis];
    state.Bounds[2 * axis + 1] = high[axis];
    if (!std::isfinite(low[axis]) || !std::isfinite(high[axis]) || low[axis] > high[axis])
    {
      throw std::runtime_error("its bounds are damaged");
    }
  }
}

}

openvdb::FloatGrid::Ptr MakeSavedGrid(const SavedState& state)
{
  openvdb::FloatGrid::Ptr grid = ToGrid(*state.Band);
  grid->setName(SavedGridName);
  if (state.Origin != std::array<double, 3>{})
  {
    const openvdb::Vec3d origin(state.Origin.data());
    grid->transform().postTranslate(origin);
    grid->insertMeta(OriginName, openvdb::Vec3DMetadata(origin));
  }
  grid->insertMeta(TimeName, openvdb::DoubleMetadata(state.Time));
  grid->insertMeta(HistoryName, openvdb::StringMetadata(WriteHistory(state.History)));
  grid->insertMeta(OutsideName, openvdb::StringMetadata(WriteOutside(state.History)));
  if (state.Spacing > 0.0)
  {
    grid->insertMeta(SpacingName, openvdb::DoubleMetadata(state.Spacing));
  }
  if (state.Reach > 0.0)
  {
    const double* bounds = state.Bounds;
    grid->insertMeta(ReachName, openvdb::DoubleMetadata(state.Reach));
    grid->insertMeta(LowName, openvdb::Vec3DMetadata({ bounds[0], bounds[2], bounds[4] }));
    grid->insertMeta(HighName, openvdb::Vec3DMetadata({ bounds[1], bounds[3], bounds[5] }));
  }
  return grid;
}

SavedState ReadSavedGrid(const openvdb::FloatGrid& grid)
{
  SavedState state;
  state.Band = FromGrid(grid);
  if (const auto origin = grid.getMetadata<openvdb::Vec3DMetadata>(OriginName))
  {
    std::copy_n(origin->value().asPointer(), 3, state.Origin.begin());
  }
  state.Time = ReadMetadata<double>(grid, TimeName);
  const std::array<double, 4> numbers = { state.Time, state.Origin[0], state.Origin[1],
    state.Origin[2] };
  if (!std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); }))
  {
    throw std::runtime_error("its time or origin is damaged");
  }
  state.History = ReadHistory(ReadMetadata<std::string>(grid, HistoryName));
  ReadOutside(grid, state.History);
  state.Spacing = ReadLength(grid, SpacingName);
  ReadDomain(grid, state);
  return state;
}

}
