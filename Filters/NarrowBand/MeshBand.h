/**
 * Distances to triangles on the nodes near them, by OpenVDB's own converter. It takes half a minute
 * to compile, so only this library compiles it.
 */
#ifndef MeshBand_h
#define MeshBand_h

#include "ActiveNarrowBandExport.h"
#include "OpenVDB.h"

#include <cstddef>

namespace activesurface
{

/** Triangles in the coordinates of a lattice [voxels]. */
class ACTIVENARROWBAND_EXPORT LatticeTriangles
{
public:
  virtual ~LatticeTriangles();
  virtual std::size_t GetNumberOfPoints() const = 0;
  virtual std::size_t GetNumberOfTriangles() const = 0;
  virtual openvdb::Vec3d GetCorner(std::size_t triangle, std::size_t corner) const = 0;
};

/** Both have the identity as transform. */
struct MeshBand
{
  static constexpr openvdb::Int32 NoTriangle = -1;

  openvdb::FloatGrid::Ptr Distances; //< [voxels]; + or - the half width beyond it
  openvdb::Int32Grid::Ptr Triangles; //< number of the nearest triangle, where Distances is active
};

/** Up to halfWidth [voxels] on either side. Signed: negative inside of what the triangles enclose,
 * which have to be closed. */
ACTIVENARROWBAND_EXPORT MeshBand MakeMeshBand(
  const LatticeTriangles& mesh, float halfWidth, bool isSigned);

}

#endif
