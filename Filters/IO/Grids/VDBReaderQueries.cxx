// What a vtkActiveVDBReader knows and tells of its file.

#include "Grids/GridChoice.h"
#include "Grids/VDBReaderState.h"

#include <algorithm>

using activesurface::VDBGrid;

namespace
{

std::string GetText(const openvdb::MetaMap* metadata, const std::string& name)
{
  const auto value = metadata ? (*metadata)[name] : nullptr;
  return value ? value->str() : "";
}

}

int vtkActiveVDBReader::GetNumberOfGrids()
{
  return static_cast<int>(this->Internal->File.Grids.size());
}

// In voxels, of what Region says.
openvdb::CoordBBox vtkActiveVDBReader::Internals::FindBox(const vtkActiveVDBReader* reader) const
{
  if (reader->Region == INDEX)
  {
    return activesurface::FindVoxels(reader->IndexRegion);
  }
  if (reader->Region == WORLD)
  {
    return activesurface::FindVoxels(*this->Chosen.front().Transform, reader->WorldRegion);
  }
  openvdb::CoordBBox box;
  for (const VDBGrid& grid : this->Chosen)
  {
    box.expand(grid.ActiveBox);
  }
  return box;
}

vtkStringArray* vtkActiveVDBReader::GetGridNames()
{
  vtkStringArray* names = this->Internal->Names;
  names->SetNumberOfValues(0);
  for (const VDBGrid& grid : this->Internal->File.Grids)
  {
    names->InsertNextValue(grid.Name);
  }
  return names;
}

const char* vtkActiveVDBReader::GetGridName(int i)
{
  const VDBGrid* grid = this->Internal->Find(i);
  return grid ? grid->Name.c_str() : "";
}

const char* vtkActiveVDBReader::GetGridType(int i)
{
  const VDBGrid* grid = this->Internal->Find(i);
  return grid ? grid->GetValueType() : "";
}

const char* vtkActiveVDBReader::GetGridClass(int i)
{
  const VDBGrid* grid = this->Internal->Find(i);
  const auto kind = grid ? grid->Metadata->getMetadata<openvdb::StringMetadata>("class") : nullptr;
  return kind ? kind->value().c_str() : grid ? "unknown" : "";
}

bool vtkActiveVDBReader::GetGridIsHalfFloat(int i)
{
  const VDBGrid* grid = this->Internal->Find(i);
  return grid && grid->IsHalf;
}

bool vtkActiveVDBReader::GetGridIsInstance(int i)
{
  const VDBGrid* grid = this->Internal->Find(i);
  return grid && !grid->Parent.empty();
}

vtkIdType vtkActiveVDBReader::GetGridActiveVoxels(int i)
{
  const VDBGrid* grid = this->Internal->Find(i);
  return grid ? static_cast<vtkIdType>(grid->ActiveVoxels) : 0;
}

void vtkActiveVDBReader::GetGridBox(int i, int box[6])
{
  const VDBGrid* grid = this->Internal->Find(i);
  const bool isEmpty = !grid || grid->ActiveBox.empty();
  for (int axis = 0; axis < 3; ++axis)
  {
    box[2 * axis] = isEmpty ? 0 : grid->ActiveBox.min()[axis];
    box[2 * axis + 1] = isEmpty ? -1 : grid->ActiveBox.max()[axis];
  }
}

void vtkActiveVDBReader::GetGridVoxelSize(int i, double size[3])
{
  const VDBGrid* grid = this->Internal->Find(i);
  const bool isKnown = grid && grid->Transform;
  const openvdb::Vec3d voxel = isKnown ? grid->Transform->voxelSize() : openvdb::Vec3d(0.0);
  std::copy_n(voxel.asPointer(), 3, size);
}

std::string vtkActiveVDBReader::GetMetadata(const std::string& name)
{
  return GetText(this->Internal->File.Metadata.get(), name);
}

std::string vtkActiveVDBReader::GetAllMetadata()
{
  const auto metadata = this->Internal->File.Metadata;
  return metadata ? metadata->str() : "";
}

std::string vtkActiveVDBReader::GetGridMetadata(int i, const std::string& name)
{
  const VDBGrid* grid = this->Internal->Find(i);
  return grid ? GetText(grid->Metadata.get(), name) : "";
}

std::string vtkActiveVDBReader::GetAllGridMetadata(int i)
{
  const VDBGrid* grid = this->Internal->Find(i);
  return grid ? grid->Metadata->str() : "";
}
