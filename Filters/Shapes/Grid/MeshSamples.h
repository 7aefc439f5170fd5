// Samples of the distance to a mesh on a lattice.

#ifndef MeshSamples_h
#define MeshSamples_h

#include "Base/Automatic.h"
#include "Base/OpenVDB.h"
#include "Grid/GridSamples.h"
#include "Input/MeshTriangles.h"

namespace activesurface
{

struct MeshMeasure
{
  double VoxelSize = Automatic; // automatic: longest side of the mesh's bounds / 64
  double Reach = Automatic;     // automatic: diagonal of the mesh's bounds / 8
  double Thickness = 0.0;       // of the shell around an open mesh; 0: no shell
  double MaximumNumberOfVoxels = 0.0;
};

class MeshSamples : public GridSamples
{
public:
  // Throws std::invalid_argument for a mesh without valid polygons, with 2^31 triangles or more, or
  // 10^9 voxels or more from the origin, and for invalid values of `measure`. Throws
  // std::runtime_error if the distances need more than MaximumNumberOfVoxels.
  MeshSamples(const MeshTriangles& mesh, const MeshMeasure& measure);
  ~MeshSamples() override;

  double Evaluate(const double x[3], double* gradient) const override;
  bool GetBounds(double bounds[6]) const override;
  bool FindShape(double level, LatticeShape& shape) const override;
  SurfaceSample SampleSurface() const override { return this->Surface; }

private:
  void Measure(const MeshMeasure& measure);
  void Thicken(double thickness);

  double VoxelSize = 0.0;
  double Reach = 0.0;                    // voxels
  double HalfShell = 0.0;                // voxels; subtracted from the distance
  openvdb::FloatGrid::ConstPtr Distance; // of MakeMeshDistance or MakeOpenMeshDistance
  openvdb::CoordBBox Leaves;             // contains all nodes nearer than Reach, and the inside
  std::array<double, 6> Bounds;
  SurfaceSample Surface; // empty for an open mesh without a shell
};

}

#endif
