#include "Grids/GridFacts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace activesurface
{

namespace
{

// Returns NaN if there is no "time" of type double or float.
double GetTime(const openvdb::MetaMap& metadata)
{
  if (const auto number = metadata.getMetadata<openvdb::DoubleMetadata>("time"))
  {
    return number->value();
  }
  const auto number = metadata.getMetadata<openvdb::FloatMetadata>("time");
  return number ? number->value() : std::nan("");
}

}

std::vector<double> ReadTimes(const std::vector<std::string>& files)
{
  if (files.empty())
  {
    throw std::invalid_argument("FileName is not set; set it to the .vdb file to read.");
  }
  std::vector<double> times;
  for (const std::string& name : files)
  {
    const VDBFile file = ValidateVDB(name, false);
    const double time = GetTime(*file.Metadata);
    times.push_back(
      std::isnan(time) && !file.Grids.empty() ? GetTime(*file.Grids.front().Metadata) : time);
  }
  return times;
}

const char* GetGridClass(const VDBGrid* grid)
{
  const auto kind = grid ? grid->Metadata->getMetadata<openvdb::StringMetadata>("class") : nullptr;
  return kind ? kind->value().c_str() : grid ? "unknown" : "";
}

void GetActiveBox(const VDBGrid* grid, int box[6])
{
  const bool isEmpty = !grid || grid->ActiveBox.empty();
  for (int axis = 0; axis < 3; ++axis)
  {
    box[2 * axis] = isEmpty ? 0 : grid->ActiveBox.min()[axis];
    box[2 * axis + 1] = isEmpty ? -1 : grid->ActiveBox.max()[axis];
  }
}

void GetVoxelSize(const VDBGrid* grid, double size[3])
{
  const bool isKnown = grid && grid->Transform;
  const openvdb::Vec3d voxel = isKnown ? grid->Transform->voxelSize() : openvdb::Vec3d(0.0);
  std::copy_n(voxel.asPointer(), 3, size);
}

std::string GetMetadata(const openvdb::MetaMap* metadata, const std::string& name)
{
  const auto value = metadata ? (*metadata)[name] : nullptr;
  return value ? value->str() : "";
}

std::string GetAllMetadata(const openvdb::MetaMap* metadata)
{
  return metadata ? metadata->str() : "";
}

}
