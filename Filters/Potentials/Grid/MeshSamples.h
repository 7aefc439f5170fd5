// The distance to a mesh as samples on a lattice.

#ifndef MeshSamples_h
#define MeshSamples_h

#include "GridSamples.h"
#include "MeshTriangles.h"
#include "OpenVDB.h"

namespace activesurface
{

struct MeshMeasure
{
  double VoxelSize = 0.0; // 0: longest side of the mesh / 64
  double Reach = 0.0;     // 0: diagonal of the mesh / 8
  double Thickness = 0.0; // of the shell that a mesh which is not closed becomes; 0: none
  double MaximumNumberOfVoxels = 0.0;
};

class MeshSamples : public GridSamples
{
public:
  // Throws std::invalid_argument for a mesh without polygons, and for measures that are not finite
  // or that the lattice cannot hold; std::runtime_error beyond the maximum number of voxels.
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
  double HalfShell = 0.0;                // voxels; taken off the distance
  openvdb::FloatGrid::ConstPtr Distance; // of MakeMeshDistance or MakeOpenMeshDistance
  openvdb::CoordBBox Leaves;             // holds all that is nearer than Reach, and all inside
  std::array<double, 6> Bounds;
  SurfaceSample Surface; // none of an open mesh that is no shell
};

}

#endif
