#include "Simulation/StateFile.h"

#include "FileReplacement.h"
#include "SavedGrid.h"
#include "VDBFile.h"

#include <openvdb/io/File.h>

#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

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

openvdb::GridBase::Ptr FindSavedGrid(const std::string& file)
{
  const VDBFile content = LookThroughVDB(file);
  for (const VDBGrid& grid : content.Grids)
  {
    if (grid.Name == SavedGridName)
    {
      return ReadVDBGrid(file, grid);
    }
  }
  throw std::runtime_error(std::string("it has no grid ") + SavedGridName);
}

}

// A row to a line, numbers in hexadecimal so that none is rounded; the event at the end.
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

void WriteState(const std::string& file, const SavedState& state)
{
  try
  {
    FileReplacement replacement(file);
    openvdb::io::File out(replacement.GetTemporaryName());
    out.write(openvdb::GridCPtrVec{
      MakeSavedGrid({ state.Band, state.Time, WriteHistory(state.History) }) });
    out.close();
    LookThroughVDB(replacement.GetTemporaryName()); // OpenVDB does not tell of a full disk
    replacement.Finish();
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error("The state cannot be written to " + file + ": " + error.what() +
      "; check that the folder exists, may be written to and has room.");
  }
}

SavedState ReadState(const std::string& file)
{
  try
  {
    const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(FindSavedGrid(file));
    if (!grid)
    {
      throw std::runtime_error("its grid potential is not one of floats");
    }
    const SavedBand saved = ReadSavedGrid(*grid);
    return { saved.Band, saved.Time, RowsOf(saved.History) };
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error("The file " + file + " holds no state of a surface: " + error.what() +
      "; it has to be one that SaveState, or a vtkActiveVDBWriter with WriteState, has written.");
  }
}

}
