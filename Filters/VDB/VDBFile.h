/**
 * A .vdb file, looked through before OpenVDB reads it.
 *
 * OpenVDB's reader believes a file: a bit that is flipped may make it ask for any amount of memory,
 * loop for hours or read beyond its arrays. So each size in the file is compared with what is there
 * first, down to the last leaf, in a walk that builds nothing; it reads all masks, and passes over
 * the values. A file that passes is read without fault, though its values may be any. Memory then
 * is within a few hundred times the size of the file.
 */
#ifndef VDBFile_h
#define VDBFile_h

#include "vtkActiveVDBModule.h"

#include <openvdb/openvdb.h>

#include <cstdint>
#include <string>
#include <vector>

namespace activesurface
{

/** A grid of a file. */
struct VDBGrid
{
  std::string Name;       //< several of one name have their number behind it: name[1]
  std::string UniqueName; //< as OpenVDB has it
  std::string Type;       //< of the tree
  bool IsHalf = false;
  std::string Parent; //< unique name of the grid whose tree this one shares; else empty
  openvdb::MetaMap::Ptr Metadata;
  openvdb::math::Transform::Ptr Transform; //< null if it is not linear
  bool IsKnown = false;                    //< whether it can be read
  bool CanBeClipped = false;               //< whether leaves may be left out

  ///@{
  /** 0, and empty, if it is not known, or the trees were not walked through. */
  std::uint64_t ActiveVoxels = 0;
  std::uint64_t NumberOfLeaves = 0;
  openvdb::CoordBBox ActiveBox;
  ///@}

  /** The value's type: float, double, int32, int64, bool, vec3s, vec3d, vec3i, mask, points. */
  const char* GetValueType() const;
};

struct VDBFile
{
  openvdb::MetaMap::Ptr Metadata;
  std::vector<VDBGrid> Grids;
};

/**
 * What is in a file; without the trees it is known from its first bytes alone, where it was written
 * with OpenVDB's io::File. Throws std::runtime_error, with a sentence that names the file, for one
 * that is missing, damaged, or of before OpenVDB 2 (version 222 of the format).
 */
VTKACTIVEVDB_EXPORT VDBFile LookThroughVDB(const std::string& file, bool trees = true);

/**
 * A grid of a file that was looked through with its trees, in memory as a whole or, where it can be
 * clipped, with the leaves that meet a box [world] alone. Throws std::runtime_error.
 */
VTKACTIVEVDB_EXPORT openvdb::GridBase::Ptr ReadVDBGrid(
  const std::string& file, const VDBGrid& grid, const openvdb::BBoxd* box = nullptr);

}

#endif
