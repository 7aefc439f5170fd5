/**
 * Reads metadata of a .vdb file after validating the sizes of the metadata, because OpenVDB's
 * reader trusts these sizes.
 */
#ifndef VDBMetadata_h
#define VDBMetadata_h

#include "Base/OpenVDB.h"

#include <cstdint>

namespace activesurface
{

class ByteSource;

struct VDBMetadata
{
  openvdb::MetaMap::Ptr Values;
  /** True if the metadata have the table of leaf sizes for delayed loading. */
  bool HasLeafSizes = false;
  bool HasPackedSizes = false;
  std::uint64_t NumberOfLeaves = 0;
};

/** Reads metadata from the current position. Throws if the metadata are damaged. */
VDBMetadata ReadMetadata(ByteSource& source);

}

#endif
