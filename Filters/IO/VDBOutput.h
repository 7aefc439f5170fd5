// A .vdb file that is written whole, checked, or not at all.

#ifndef VDBOutput_h
#define VDBOutput_h

#include <openvdb/openvdb.h>

#include <stdexcept>
#include <string>

namespace activesurface
{

// What is wrong with a file, and as which of vtkErrorCode's numbers.
class FileError : public std::runtime_error
{
public:
  FileError(unsigned long code, const std::string& sentence)
    : std::runtime_error(sentence)
    , Code(code)
  {
  }
  const unsigned long Code;
};

// compression: OpenVDB's flags. The metadata are those of the file and of each grid. Throws
// FileError; a file that was there before then is still.
void WriteVDB(const std::string& file, const openvdb::GridPtrVec& grids,
  const openvdb::MetaMap& metadata, std::uint32_t compression);

}

#endif
