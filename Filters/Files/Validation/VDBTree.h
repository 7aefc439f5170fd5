/**
 * Validates the topology of a .vdb tree without building the tree. Every size field is checked
 * against the file, because OpenVDB's reader trusts these fields. Collects the active bounding box.
 */
#ifndef VDBTree_h
#define VDBTree_h

#include "Base/OpenVDB.h"

#include <array>
#include <cstdint>
#include <vector>

namespace activesurface
{

class ByteSource;

/** Storage of the values of a tree in a file. */
struct VDBFormat
{
  enum Leaves
  {
    Values,
    Bools,
    Masks,
    Points
  };
  Leaves Kind = Values;
  std::uint32_t ValueSize = 0;   //< bytes, in memory
  std::uint32_t StoredSize = 0;  //< bytes in the file; fewer for half floats
  std::uint32_t Compression = 0; //< OpenVDB's flags
};

/** Compression scheme and bytes of a leaf's values, as in OpenVDB's table for delayed loading. */
struct VDBLeafSize
{
  std::int8_t Scheme = 0;
  std::int64_t Bytes = 0;
};

struct VDBTree
{
  struct Leaf
  {
    openvdb::Coord Origin;
    std::array<std::uint64_t, 8> Active;
  };

  std::uint64_t ActiveVoxels = 0; //< including active tiles
  std::uint64_t ActiveTiles = 0;
  std::uint64_t NumberOfLeaves = 0;
  openvdb::CoordBBox ActiveBox;   //< empty if nothing is active
  std::vector<Leaf> Leaves;       //< in the order of the file
  std::vector<VDBLeafSize> Sizes; //< of leaves that contain values
};

/** Reads from the beginning of the topology. Throws if the tree is damaged. */
VDBTree ValidateTopology(ByteSource& source, const VDBFormat& format);

/** Validates the buffers of leaves, which follow the topology, except buffers of points. Sets
 * tree.Sizes if the leaves contain values. Throws like ValidateTopology. */
void ValidateBuffers(ByteSource& source, const VDBFormat& format, VDBTree& tree);

/**
 * Skips a Blosc buffer of `stored` bytes. Throws unless the header of the buffer declares `stored`
 * and `unpacked` bytes. If `unpacked` is less than 128, the header may declare 128 bytes, because
 * OpenVDB pads short data.
 */
void SkipBlosc(ByteSource& source, std::uint64_t stored, std::uint64_t unpacked);

}

#endif
