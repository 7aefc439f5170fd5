/**
 * Distances of nodes to nearby triangles, by OpenVDB's converter. Of the product's libraries, only
 * this one compiles the converter, because the compilation needs half a minute.
 */
#ifndef MeshBand_h
#define MeshBand_h

#include "ActiveLevelSetExport.h"
#include "Base/OpenVDB.h"

#include <cstddef>

namespace activesurface
{

/** Triangles in the coordinates of a lattice [voxels]. */
class ACTIVELEVELSET_EXPORT LatticeTriangles
{
public:
  virtual ~LatticeTriangles();
  virtual std::size_t GetNumberOfPoints() const = 0;
  virtual std::size_t GetNumberOfTriangles() const = 0;
  virtual openvdb::Vec3d GetCorner(std::size_t triangle, std::size_t corner) const = 0;
};

/** Distances and nearest triangles. The transform of both grids is the identity. */
struct MeshBand
{
  static constexpr openvdb::Int32 NoTriangle = -1;

  openvdb::FloatGrid::Ptr Distances; //< [voxels], clamped to +-halfWidth
  openvdb::Int32Grid::Ptr Triangles; //< number of the nearest triangle, where Distances is active
};

/** Computes distances up to halfWidth [voxels] on either side. Signed distances are negative
 * inside, and need a closed mesh. */
ACTIVELEVELSET_EXPORT MeshBand MakeMeshBand(
  const LatticeTriangles& mesh, float halfWidth, bool isSigned);

}

#endif
