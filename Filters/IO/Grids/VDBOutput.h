// Writes a validated .vdb file completely or not at all.

#ifndef VDBOutput_h
#define VDBOutput_h

#include "Base/OpenVDB.h"

#include <string>

namespace activesurface
{

// Writes grids; `metadata` is added to the file and to each grid. compression: OpenVDB's flags. On
// failure, keeps an existing file and throws std::bad_alloc for lack of memory, else FileError.
void WriteVDB(const std::string& file, const openvdb::GridPtrVec& grids,
  const openvdb::MetaMap& metadata, std::uint32_t compression);

}

#endif
