#include "Grids/VDBOutput.h"

#include "Base/OpenVDB.h"
#include "Common/FileError.h"
#include "FileReplacement.h"
#include "VDBFile.h"

#include "vtkErrorCode.h"

#include <openvdb/io/File.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>

namespace activesurface
{

namespace
{

FileReplacement MakeReplacement(const std::string& file)
{
  try
  {
    return FileReplacement(file);
  }
  catch (const std::runtime_error& error)
  {
    throw FileError(vtkErrorCode::CannotOpenFileError,
      "The file " + file + " cannot be written: " + error.what() + ".");
  }
}

void CheckCanBeMade(const std::string& file, const std::string& temporary)
{
  errno = 0;
  const bool isMade = std::ofstream(temporary, std::ios::binary).is_open();
  if (!isMade)
  {
    throw FileError(vtkErrorCode::CannotOpenFileError,
      "The file " + file + " cannot be written: " + std::strerror(errno) +
        "; check the file's name, and that its folder exists and may be written to.");
  }
}

}

void WriteVDB(const std::string& file, const openvdb::GridPtrVec& grids,
  const openvdb::MetaMap& metadata, std::uint32_t compression)
{
  FileReplacement replacement = MakeReplacement(file);
  CheckCanBeMade(file, replacement.GetTemporaryName());
  for (const openvdb::GridBase::Ptr& grid : grids)
  {
    grid->insertMeta(metadata);
  }
  try
  {
    openvdb::io::File out(replacement.GetTemporaryName());
    out.setCompression(compression);
    out.write(grids, metadata);
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
    throw FileError(vtkErrorCode::OutOfDiskSpaceError,
      "The file " + file +
        " cannot be written as a whole; check the disk's space and the folder's permissions. (" +
        error.what() + ")");
  }
}

}
