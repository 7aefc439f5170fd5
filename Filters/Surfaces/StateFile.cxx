#include "StateFile.h"

#include <openvdb/io/File.h>

#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

constexpr const char* GridName = "potential";
constexpr const char* TimeName = "active_pipeline_time";
constexpr const char* HistoryName = "active_history";

// A row to a line, numbers in hexadecimal so that none is rounded; the event at the end.
std::string TextOf(const std::vector<HistoryRow>& rows)
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

std::vector<HistoryRow> RowsOf(const std::string& text)
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

void WriteState(const std::string& file, const SavedState& state)
{
  const std::string temporary = file + ".part";
  try
  {
    const openvdb::FloatGrid::Ptr grid = state.Band->ToGrid();
    grid->insertMeta(TimeName, openvdb::DoubleMetadata(state.Time));
    grid->insertMeta(HistoryName, openvdb::StringMetadata(TextOf(state.History)));
    openvdb::io::File out(temporary);
    out.write(openvdb::GridCPtrVec{ grid });
    out.close();
    if (std::rename(temporary.c_str(), file.c_str()) != 0)
    {
      throw std::runtime_error("it cannot be renamed");
    }
  }
  catch (const std::exception& error)
  {
    std::remove(temporary.c_str());
    throw std::runtime_error("The state cannot be written to " + file + ": " + error.what() +
      "; check that the folder exists, may be written to and has room.");
  }
}

SavedState ReadState(const std::string& file)
{
  try
  {
    openvdb::initialize();
    openvdb::io::File in(file);
    in.open(false); // all at once: the file may change later
    const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(in.readGrid(GridName));
    if (!grid)
    {
      throw std::runtime_error("its grid potential is not one of floats");
    }
    SavedState state;
    state.Band = NarrowBand::FromGrid(*grid);
    state.Time = ReadMetadata<double>(*grid, TimeName);
    state.History = RowsOf(ReadMetadata<std::string>(*grid, HistoryName));
    return state;
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error("The file " + file + " holds no state of a surface: " + error.what() +
      "; it has to be one that SaveState has written.");
  }
}

}
