/**
 * Validates a .vdb file before OpenVDB reads it.
 *
 * OpenVDB's reader trusts the file: a flipped bit may make the reader allocate any amount of
 * memory, loop for hours or read beyond its arrays. Validation checks every size field first, down
 * to the last leaf. Validation builds no tree: it reads all masks and skips the values. OpenVDB
 * then reads the file without these faults, or throws, whatever the values are. The memory needed
 * is at most a few hundred times the file size.
 */
#ifndef VDBFile_h
#define VDBFile_h

#include "ActiveFilesExport.h"
#include "Base/OpenVDB.h"

#include <cstdint>
#include <string>
#include <vector>

namespace activesurface
{

/** A grid of a file. */
struct ACTIVEFILES_EXPORT VDBGrid
{
  std::string Name;       //< grids of equal name have an index: name[1]
  std::string UniqueName; //< in OpenVDB's form
  std::string Type;       //< of the tree
  bool IsHalf = false;
  std::string Parent; //< unique name of the grid whose tree this one shares; otherwise empty
  openvdb::MetaMap::Ptr Metadata;
  openvdb::math::Transform::Ptr Transform; //< null if it is not linear
  bool IsKnown = false;                    //< true if the grid can be read
  bool CanBeClipped = false;               //< true if leaves may be skipped

  ///@{
  /** 0, or empty, if the grid's type is unknown or its tree was not validated. */
  std::uint64_t ActiveVoxels = 0;
  std::uint64_t NumberOfLeaves = 0;
  openvdb::CoordBBox ActiveBox;
  ///@}

  /** Value type (float, double, int32, int64, bool, vec3s, vec3d, vec3i, mask, points), or the type
   * of the tree if the value type is unknown. */
  const char* GetValueType() const;
};

struct VDBFile
{
  openvdb::MetaMap::Ptr Metadata;
  std::vector<VDBGrid> Grids;
};

/**
 * Validates a file and lists its grids. If `trees` is false, skips the trees of a file that has the
 * offsets of its grids, as OpenVDB's io::File writes them. Throws std::runtime_error, with the name
 * of the file, for a file that cannot be read: for example, a file that is missing or damaged, or
 * whose format is older than version 222 or newer than the library's.
 */
ACTIVEFILES_EXPORT VDBFile ValidateVDB(const std::string& file, bool trees = true);

/**
 * Reads a grid of a file that was validated with its trees. If a box [world] is given and the grid
 * can be clipped, reads only the leaves that meet the box, and sets voxels outside the box to the
 * background. Throws std::runtime_error if the grid cannot be read.
 */
ACTIVEFILES_EXPORT openvdb::GridBase::Ptr ReadVDBGrid(
  const std::string& file, const VDBGrid& grid, const openvdb::BBoxd* box = nullptr);

}

#endif
