// Converts a data object to the grids that a vtkActiveVDBWriter writes.

#ifndef VDBContent_h
#define VDBContent_h

#include "AttachedData.h"
#include "OpenVDB.h"

#include <memory>

class vtkDataObject;
class vtkImageData;
class vtkPointData;
class vtkPolyData;

namespace activesurface
{

struct LatticeMesh;
struct MeshBand;

struct VDBChoice
{
  bool State = false;
  bool Density = false;
  bool Velocity = false;
  bool PointArrays = false;
  bool HalfFloat = false;
  openvdb::GridClass Kind = openvdb::GRID_UNKNOWN; // of an image's scalars
  double VoxelSize = 0.0;                          // of a mesh; 0: a 64th of its size
};

class VDBContent
{
public:
  explicit VDBContent(const VDBChoice& choice)
    : Choice(choice)
  {
  }

  // Throws std::invalid_argument, with a sentence, for data that cannot become the chosen grids.
  // attached: to the data, or gathered from all ranks; may be null.
  void Add(vtkDataObject* data, const std::shared_ptr<const AttachedState>& attached);

  const openvdb::GridPtrVec& GetGrids() const { return this->Grids; }

private:
  void AddState(const AttachedState& attached);
  void AddSkin(const NarrowBand& band, vtkPointData* arrays);
  void AddMesh(vtkPolyData* mesh);
  void AddSurface(
    const LatticeMesh& mesh, const MeshBand& band, double voxelSize, vtkPointData* arrays);
  void AddArrays(const LatticeMesh& mesh, const MeshBand& band, vtkPointData* arrays);
  // Translates all grids added so far.
  void MoveBy(const std::array<double, 3>& offset);
  void AddImage(vtkImageData* image);
  void Add(const openvdb::GridBase::Ptr& grid);

  VDBChoice Choice;
  openvdb::GridPtrVec Grids;
};

}

#endif
