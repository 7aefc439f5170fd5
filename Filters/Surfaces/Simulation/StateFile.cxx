#include "Simulation/StateFile.h"

#include "Base/OpenVDB.h"
#include "FileReplacement.h"
#include "SavedGrid.h"
#include "VDBFile.h"

#include <openvdb/io/File.h>

#include <new>
#include <stdexcept>

namespace activesurface
{

namespace
{

/** Returns the text of an error without its final period. */
std::string ReasonOf(const std::exception& error)
{
  std::string reason = error.what();
  reason.erase(reason.find_last_not_of('.') + 1);
  return reason;
}

openvdb::GridBase::Ptr FindSavedGrid(const std::string& file)
{
  const VDBFile content = ValidateVDB(file);
  for (const VDBGrid& grid : content.Grids)
  {
    if (grid.Name == SavedGridName)
    {
      return ReadVDBGrid(file, grid);
    }
  }
  throw std::runtime_error(std::string("it has no grid named ") + SavedGridName);
}

}

void WriteState(const std::string& file, const SavedState& state)
{
  if (!state.Band)
  {
    throw std::runtime_error("There is no state of a time step to save; update the filter first, "
                             "with EvolutionMode TRANSIENT.");
  }
  try
  {
    FileReplacement replacement(file);
    openvdb::io::File out(replacement.GetTemporaryName());
    out.write(openvdb::GridCPtrVec{ MakeSavedGrid(state) });
    out.close();
    ValidateVDB(replacement.GetTemporaryName()); // OpenVDB does not report a full disk
    replacement.Finish();
  }
  catch (const std::bad_alloc&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error("The state cannot be written to " + file + ": " + ReasonOf(error) +
      ". Check the file's name, that its folder exists and may be written to, and that the disk is "
      "not full.");
  }
}

SavedState ReadState(const std::string& file)
{
  try
  {
    const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(FindSavedGrid(file));
    if (!grid)
    {
      throw std::runtime_error("the values of its grid are not floats");
    }
    return ReadSavedGrid(*grid);
  }
  catch (const std::bad_alloc&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error("No state of a surface can be loaded from " + file + ": " +
      ReasonOf(error) +
      "; load a file that SaveState, or a vtkActiveVDBWriter with WriteState, has written.");
  }
}

}
