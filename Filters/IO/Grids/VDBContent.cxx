#include "Grids/VDBContent.h"

#include "Base/LatticeOrigin.h"
#include "Grids/ImageGrids.h"
#include "Grids/SkinBand.h"
#include "Grids/SkinGrids.h"
#include "Input/MeshTriangles.h"
#include "NarrowBand.h"
#include "SavedGrid.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <string>

namespace activesurface
{

namespace
{

constexpr double VoxelsAcross = 64.0;

void CheckIsClosed(const MeshTriangles& mesh)
{
  if (mesh.Defects.BrokenPolygons > 0)
  {
    throw std::invalid_argument(
      mesh.Defects.Describe() + " A mesh with such polygons is not written; fix the mesh.");
  }
  if (mesh.Triangles.empty())
  {
    throw std::invalid_argument(
      "The input has no polygons of three or more different points, so there is no surface to "
      "write; connect a closed mesh.");
  }
  if (!mesh.Defects.IsClosed())
  {
    throw std::invalid_argument(
      "The mesh is not closed, so it has no inside: " + std::to_string(mesh.Defects.OddEdges) +
      " edges belong to one polygon, or to another odd number of polygons. Merge the points of "
      "seams (vtkCleanPolyData with Tolerance > 0), close holes by vtkFillHolesFilter, or make a "
      "shell of it by a vtkActiveImplicitSurface with MeshThickness > 0.");
  }
}

double FindLongestSide(const MeshTriangles& mesh)
{
  const std::array<double, 6> bounds = mesh.GetBounds();
  return std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
}

void CheckActiveVoxels(const LatticeMesh& mesh)
{
  constexpr double most = 2147483648.0; // 2^31
  double area = 0.0;
  for (const auto& corners : mesh.Triangles)
  {
    const openvdb::Vec3d &a = mesh.Points[corners[0]], &b = mesh.Points[corners[1]],
                         &c = mesh.Points[corners[2]];
    area += 0.5 * (b - a).cross(c - a).length();
  }
  const double voxels = 2.0 * HalfWidth * area;
  if (!(voxels <= most))
  {
    std::ostringstream text;
    text << "The surface's grid would have about " << voxels
         << " active voxels, more than 2^31; enlarge VoxelSize.";
    throw std::invalid_argument(text.str());
  }
}

// Returns the triangles of ReadTriangles on a lattice; points keep their indices. An automatic
// voxelSize becomes a 64th of the longest side of the mesh's bounds. origin: receives the world
// position of the lattice's node (0, 0, 0).
LatticeMesh ReadClosedMesh(vtkPolyData* data, double& voxelSize, std::array<double, 3>& origin)
{
  const MeshTriangles read = ReadTriangles(data);
  CheckIsClosed(read);
  const double side = FindLongestSide(read);
  if (!(voxelSize > 0.0) && voxelSize != Automatic)
  {
    throw std::invalid_argument("VoxelSize has to be > 0, or -1, automatic.");
  }
  voxelSize = voxelSize > 0.0 ? voxelSize : side / VoxelsAcross;
  CheckGridVoxel(voxelSize);
  constexpr double mostVoxels = 1 << 20;
  if (!(side / voxelSize <= mostVoxels))
  {
    throw std::invalid_argument("The mesh is more than a million voxels long; enlarge VoxelSize.");
  }
  const std::array<double, 6> bounds = read.GetBounds();
  for (int axis = 0; axis < 3; ++axis)
  {
    origin[axis] = FindLatticeOrigin(bounds[2 * axis], bounds[2 * axis + 1], voxelSize);
  }
  LatticeMesh mesh;
  const openvdb::Vec3d offset(origin.data());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    mesh.Points.push_back((openvdb::Vec3d(data->GetPoint(i)) - offset) / voxelSize);
  }
  for (const MeshTriangles::Triangle& corners : read.Origins)
  {
    mesh.Triangles.push_back({ corners[0], corners[1], corners[2] });
  }
  CheckActiveVoxels(mesh);
  return mesh;
}

class Content
{
public:
  explicit Content(const VDBChoice& choice)
    : Choice(choice)
  {
  }

  void Add(vtkDataObject* data, const std::shared_ptr<const AttachedState>& attached);

  openvdb::GridPtrVec Grids;

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

  const VDBChoice& Choice;
};

void Content::Add(vtkDataObject* data, const std::shared_ptr<const AttachedState>& attached)
{
  auto mesh = vtkPolyData::SafeDownCast(data);
  auto image = vtkImageData::SafeDownCast(data);
  if (this->Choice.State && !attached)
  {
    throw std::invalid_argument(
      "The input carries no state for WriteState; connect an output of a vtkActiveImplicitSurface, "
      "without filters in between, and update this output again if its last update was stopped.");
  }
  if (attached)
  {
    vtkPointData* own = mesh ? mesh->GetPointData() : nullptr;
    this->AddSkin(*attached->Skin, attached->WholeArrays ? attached->WholeArrays.Get() : own);
    this->MoveBy(attached->State.Origin);
    this->AddState(*attached);
  }
  else if (mesh)
  {
    this->AddMesh(mesh);
  }
  else if (image)
  {
    this->AddImage(image);
  }
  else
  {
    throw std::invalid_argument(
      "The input is neither a vtkPolyData nor a vtkImageData; connect a skin, a closed mesh or an "
      "image.");
  }
}

void Content::Add(const openvdb::GridBase::Ptr& grid)
{
  const std::string name = grid->getName();
  const bool isTaken = (this->Choice.State && name == SavedGridName) ||
    std::any_of(this->Grids.begin(), this->Grids.end(),
      [&name](const openvdb::GridBase::Ptr& other) { return other->getName() == name; });
  if (isTaken)
  {
    throw std::invalid_argument("The file would have two grids \"" + name +
      "\"; give the point arrays different names, none of them \"" + name +
      "\", or turn WritePointArrays off (in active-surface skin, leave out --pass-target-arrays).");
  }
  grid->setSaveFloatAsHalf(this->Choice.HalfFloat);
  this->Grids.push_back(grid);
}

void Content::AddState(const AttachedState& attached)
{
  if (this->Choice.State && !attached.IsAtStep)
  {
    throw std::invalid_argument(
      "WriteState needs the skin at one of its time steps, with EvolutionMode TRANSIENT: between "
      "two steps, or in a steady state, there is no state to resume from.");
  }
  if (this->Choice.State)
  {
    this->Grids.push_back(MakeSavedGrid(attached.State));
  }
}

void Content::AddSkin(const NarrowBand& band, vtkPointData* arrays)
{
  CheckGridVoxel(band.GetVoxelSize());
  const LatticeMesh mesh = MakeSkinMesh(band);
  band.Run([&] { this->AddSurface(mesh, MakeSkinBand(band, mesh), band.GetVoxelSize(), arrays); });
}

void Content::AddMesh(vtkPolyData* data)
{
  if (data->GetNumberOfPoints() == 0)
  {
    throw std::invalid_argument(
      "There is no surface to write: the input is empty, or its last update was stopped; check the "
      "input, and update it again.");
  }
  double voxelSize = this->Choice.VoxelSize;
  std::array<double, 3> origin;
  const LatticeMesh mesh = ReadClosedMesh(data, voxelSize, origin);
  this->AddSurface(mesh, MakeMeshBand(mesh, HalfWidth, true), voxelSize, data->GetPointData());
  this->MoveBy(origin);
}

void Content::AddSurface(
  const LatticeMesh& mesh, const MeshBand& band, double voxelSize, vtkPointData* arrays)
{
  const openvdb::FloatGrid::Ptr surface = MakeSurfaceGrid(band, voxelSize);
  this->Add(surface);
  if (this->Choice.Density)
  {
    this->Add(MakeDensityGrid(*surface));
  }
  this->AddArrays(mesh, band, arrays);
  for (const openvdb::GridBase::Ptr& grid : this->Grids)
  {
    grid->setTransform(surface->transform().copy());
  }
}

void Content::AddArrays(const LatticeMesh& mesh, const MeshBand& band, vtkPointData* arrays)
{
  if (this->Choice.Velocity)
  {
    vtkDataArray* velocity = arrays ? arrays->GetArray("Velocity") : nullptr;
    if (!velocity || velocity->GetNumberOfComponents() != 3)
    {
      throw std::invalid_argument(
        "WriteVelocity needs a skin or mesh with the point array \"Velocity\" of three components: "
        "for a skin, turn on the filter's ComputeVelocity, and connect its output port 0.");
    }
    const openvdb::GridBase::Ptr grid = MakeArrayGrid(velocity, mesh, band);
    grid->setName("v");
    grid->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
    this->Add(grid);
  }
  for (int i = 0; this->Choice.PointArrays && arrays && i < arrays->GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* array = arrays->GetArray(i))
    {
      this->Add(MakeArrayGrid(array, mesh, band));
    }
  }
}

void Content::MoveBy(const std::array<double, 3>& offset)
{
  for (const openvdb::GridBase::Ptr& grid : this->Grids)
  {
    if (offset != std::array<double, 3>{})
    {
      grid->transform().postTranslate(openvdb::Vec3d(offset.data()));
    }
  }
}

void Content::AddImage(vtkImageData* image)
{
  if (this->Choice.Density || this->Choice.Velocity)
  {
    throw std::invalid_argument("WriteDensity and WriteVelocity need a surface, but the input is "
                                "an image; turn both off (WritePointArrays writes the arrays).");
  }
  vtkPointData* arrays = image->GetPointData();
  vtkDataArray* scalars = arrays->GetScalars() ? arrays->GetScalars() : arrays->GetArray(0);
  if (!scalars || image->GetNumberOfPoints() == 0)
  {
    throw std::invalid_argument(
      "The image is empty, or has no numeric point array; connect an image with an array.");
  }
  this->Add(MakeImageGrid(image, scalars, this->Choice.Kind));
  for (int i = 0; this->Choice.PointArrays && i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = arrays->GetArray(i);
    if (array && array != scalars)
    {
      this->Add(MakeImageGrid(image, array, openvdb::GRID_UNKNOWN));
    }
  }
}

}

openvdb::GridPtrVec MakeGrids(vtkDataObject* data,
  const std::shared_ptr<const AttachedState>& attached, const VDBChoice& choice)
{
  Content content(choice);
  content.Add(data, attached);
  return content.Grids;
}

}
