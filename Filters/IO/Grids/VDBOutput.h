// A .vdb file that is written whole, checked, or not at all.

#ifndef VDBOutput_h
#define VDBOutput_h

#include "OpenVDB.h"

#include <string>

namespace activesurface
{

// compression: OpenVDB's flags. The metadata are those of the file and of each grid. Throws
// FileError; a file that was there before then is still.
void WriteVDB(const std::string& file, const openvdb::GridPtrVec& grids,
  const openvdb::MetaMap& metadata, std::uint32_t compression);

}

#endif
