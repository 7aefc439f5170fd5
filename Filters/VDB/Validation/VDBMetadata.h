/**
 * Reads metadata of a .vdb file after validating their sizes, which OpenVDB's reader trusts.
 */
#ifndef VDBMetadata_h
#define VDBMetadata_h

#include "OpenVDB.h"

#include <cstdint>

namespace activesurface
{

class ByteSource;

struct VDBMetadata
{
  openvdb::MetaMap::Ptr Values;
  /** Of the table of leaf sizes for delayed loading, if it is there. */
  bool HasLeafSizes = false;
  bool HasPackedSizes = false;
  std::uint64_t NumberOfLeaves = 0;
};

/** From here on. Throws std::runtime_error for what is damaged. */
VDBMetadata ReadMetadata(ByteSource& source);

}

#endif
