#include "Grids/VDBContent.h"

#include "Grids/ClosedMesh.h"
#include "Grids/ImageGrids.h"
#include "Grids/LatticeMesh.h"
#include "Grids/SkinBand.h"
#include "Grids/SkinGrids.h"
#include "NarrowBand.h"
#include "SavedGrid.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>

namespace activesurface
{

void VDBContent::Add(vtkDataObject* data, const std::shared_ptr<const AttachedState>& attached)
{
  auto mesh = vtkPolyData::SafeDownCast(data);
  auto image = vtkImageData::SafeDownCast(data);
  if (this->Choice.State && !attached)
  {
    throw std::invalid_argument("WriteState needs an output of a vtkActiveImplicitSurface, from "
                                "the filter itself; the input carries no state.");
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
    throw std::invalid_argument("The input is neither a vtkPolyData nor a vtkImageData.");
  }
}

void VDBContent::Add(const openvdb::GridBase::Ptr& grid)
{
  const std::string name = grid->getName();
  const bool isTaken = (this->Choice.State && name == SavedGridName) ||
    std::any_of(this->Grids.begin(), this->Grids.end(),
      [&name](const openvdb::GridBase::Ptr& other) { return other->getName() == name; });
  if (isTaken)
  {
    throw std::invalid_argument("The file would have two grids \"" + name +
      "\"; rename the point array, or switch off WritePointArrays.");
  }
  grid->setSaveFloatAsHalf(this->Choice.HalfFloat);
  this->Grids.push_back(grid);
}

void VDBContent::AddState(const AttachedState& attached)
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

void VDBContent::AddSkin(const NarrowBand& band, vtkPointData* arrays)
{
  const LatticeMesh mesh = MakeSkinMesh(band);
  band.Run([&] { this->AddSurface(mesh, MakeSkinBand(band, mesh), band.GetVoxelSize(), arrays); });
}

void VDBContent::AddMesh(vtkPolyData* data)
{
  if (data->GetNumberOfPoints() == 0)
  {
    throw std::invalid_argument(
      "The input is empty, or its last update was stopped: there is no surface to write.");
  }
  double voxelSize = this->Choice.VoxelSize;
  std::array<double, 3> origin;
  const LatticeMesh mesh = ReadClosedMesh(data, voxelSize, origin);
  this->AddSurface(mesh, MakeMeshBand(mesh, HalfWidth, true), voxelSize, data->GetPointData());
  this->MoveBy(origin);
}

void VDBContent::AddSurface(
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

void VDBContent::AddArrays(const LatticeMesh& mesh, const MeshBand& band, vtkPointData* arrays)
{
  if (this->Choice.Velocity)
  {
    vtkDataArray* velocity = arrays ? arrays->GetArray("Velocity") : nullptr;
    if (!velocity || velocity->GetNumberOfComponents() != 3)
    {
      throw std::invalid_argument(
        "WriteVelocity needs a skin with the point array \"Velocity\" of three components: switch "
        "on the filter's ComputeVelocity, and connect its output port 0.");
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

void VDBContent::MoveBy(const std::array<double, 3>& offset)
{
  for (const openvdb::GridBase::Ptr& grid : this->Grids)
  {
    if (offset != std::array<double, 3>{})
    {
      grid->transform().postTranslate(openvdb::Vec3d(offset.data()));
    }
  }
}

void VDBContent::AddImage(vtkImageData* image)
{
  if (this->Choice.Density || this->Choice.Velocity)
  {
    throw std::invalid_argument("WriteDensity and WriteVelocity need a surface, not an image; its "
                                "own arrays are written by WritePointArrays.");
  }
  vtkPointData* arrays = image->GetPointData();
  vtkDataArray* scalars = arrays->GetScalars() ? arrays->GetScalars() : arrays->GetArray(0);
  if (!scalars || image->GetNumberOfPoints() == 0)
  {
    throw std::invalid_argument("The image is empty, or has no point array of numbers.");
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
