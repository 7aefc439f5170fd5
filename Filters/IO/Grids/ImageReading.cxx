#include "Grids/ImageReading.h"

#include "Grids/ArrayValues.h"
#include "Input/AttachedGrid.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <type_traits>

namespace activesurface
{

namespace
{

openvdb::FloatGrid::ConstPtr AsLevelSet(const openvdb::GridBase::Ptr& grid)
{
  if (grid->getGridClass() != openvdb::GRID_LEVEL_SET)
  {
    return nullptr;
  }
  const auto wide = openvdb::gridPtrCast<openvdb::DoubleGrid>(grid);
  return wide ? std::make_shared<openvdb::FloatGrid>(*wide)
              : openvdb::gridPtrCast<openvdb::FloatGrid>(grid);
}

void Place(const ImagePlace& place, vtkImageData* image)
{
  image->SetExtent(const_cast<int*>(place.Extent));
  image->SetOrigin(place.Origin);
  image->SetSpacing(place.Spacing);
  image->SetDirectionMatrix(place.Direction);
}

void CheckSize(const ImagePlace& place, const ImageRequest& request)
{
  if (request.IsDense && place.CountPoints() > static_cast<double>(request.MaximumNumberOfPoints))
  {
    std::ostringstream text;
    constexpr int digits = 15;
    text << std::setprecision(digits) << "The dense image would have " << place.CountPoints()
         << " points, more than MaximumNumberOfPoints (" << request.MaximumNumberOfPoints
         << "); choose a smaller part by Region, raise DownsamplingFactor or "
         << "MaximumNumberOfPoints, or turn OutputDense off.";
    throw std::runtime_error(text.str());
  }
}

void ActivateFirstArray(vtkPointData* arrays)
{
  vtkDataArray* first = arrays->GetArray(0);
  if (first && first->GetNumberOfComponents() == 3)
  {
    arrays->SetVectors(first);
  }
  else if (first)
  {
    arrays->SetScalars(first);
  }
}

template <class Grid>
vtkSmartPointer<vtkDataArray> Fill(const Grid& grid, const int extent[6], int factor)
{
  using Value = typename Grid::ValueType;
  using Traits = openvdb::VecTraits<Value>;
  using Stored = std::conditional_t<Traits::IsVec, Value, StoredNumber<Value>>;
  auto array = MakeArrayOf<typename Traits::ElementType>();
  array->SetNumberOfComponents(Traits::Size);
  const vtkIdType row = vtkIdType(extent[1]) - extent[0] + 1;
  const vtkIdType plane = row * (vtkIdType(extent[3]) - extent[2] + 1);
  array->SetNumberOfTuples(plane * (vtkIdType(extent[5]) - extent[4] + 1));
  auto values = static_cast<Stored*>(array->GetVoidPointer(0));
  tbb::parallel_for(extent[4], extent[5] + 1,
    [&](int z)
    {
      auto reader = grid.getConstUnsafeAccessor();
      Stored* value = values + (vtkIdType(z) - extent[4]) * plane;
      for (int y = extent[2]; y <= extent[3]; ++y)
      {
        for (int x = extent[0]; x <= extent[1]; ++x)
        {
          *value++ = reader.getValue(openvdb::Coord(x * factor, y * factor, z * factor));
        }
      }
    });
  return array;
}

// Calls Fill with the grid's actual type, if this is one of the template's types.
template <class Grid, class... Others>
vtkSmartPointer<vtkDataArray> Dispatch(
  const openvdb::GridBase& grid, const int extent[6], int factor)
{
  if (grid.isType<Grid>())
  {
    return Fill(static_cast<const Grid&>(grid), extent, factor);
  }
  if constexpr (sizeof...(Others) > 0)
  {
    return Dispatch<Others...>(grid, extent, factor);
  }
  throw std::invalid_argument("The grid \"" + grid.getName() + "\" of type " + grid.type() +
    " cannot be read as an image; choose another GridName.");
}

// Returns the values of every `factor`th voxel in an extent. Throws std::invalid_argument for grids
// of other types than numbers and vectors.
vtkSmartPointer<vtkDataArray> MakeImageArray(
  const openvdb::GridBase& grid, const int extent[6], int factor)
{
  using namespace openvdb;
  return Dispatch<FloatGrid, DoubleGrid, Int32Grid, Int64Grid, BoolGrid, MaskGrid, Vec3SGrid,
    Vec3DGrid, Vec3IGrid>(grid, extent, factor);
}

}

void ReadImage(const ChosenGrids& chosen, const ImageRequest& request, vtkImageData* image)
{
  const openvdb::math::Transform& transform = *chosen.Grids.front().Transform;
  const int factor = request.DownsamplingFactor;
  const ImagePlace place = MakeImagePlace(transform, request.Box, factor);
  CheckSize(place, request);
  openvdb::BBoxd part;
  if (request.IsPart)
  {
    openvdb::CoordBBox box = request.Box;
    box.expand(factor);
    part = transform.indexToWorld(box);
  }
  Place(place, image);
  for (const VDBGrid& facts : chosen.Grids)
  {
    const openvdb::GridBase::Ptr grid =
      ReadVDBGrid(chosen.FileName, facts, request.IsPart ? &part : nullptr);
    if (request.IsDense && image->GetNumberOfPoints() > 0)
    {
      const auto array = MakeImageArray(*grid, place.Extent, factor);
      array->SetName(facts.Name.c_str());
      image->GetPointData()->AddArray(array);
    }
    if (&facts == &chosen.Grids.front())
    {
      Attach(image->GetInformation(), AsLevelSet(grid));
    }
  }
  ActivateFirstArray(image->GetPointData());
}

namespace
{

std::string ListNames(const VDBFile& file)
{
  std::string names;
  for (const VDBGrid& grid : file.Grids)
  {
    names += (names.empty() ? "" : ", ") + grid.Name + " (" + grid.GetValueType() + ")";
  }
  return names.empty() ? "none" : names;
}

// Preference of a grid: 0 is best; -1: the grid cannot be read.
int Rank(const VDBGrid& grid)
{
  const auto kind = grid.Metadata->getMetadata<openvdb::StringMetadata>("class");
  const std::string name = kind ? kind->value() : "";
  if (!grid.IsKnown)
  {
    return -1;
  }
  return name == "level set"                       ? 0
    : name == "fog volume"                         ? 1
    : std::string(grid.GetValueType()) == "points" ? 2
                                                   : 3;
}

VDBGrid ChooseBest(const VDBFile& file, const std::string& fileName)
{
  const VDBGrid* best = nullptr;
  for (const VDBGrid& grid : file.Grids)
  {
    if (Rank(grid) >= 0 && (!best || Rank(grid) < Rank(*best)))
    {
      best = &grid;
    }
  }
  if (!best)
  {
    throw std::invalid_argument("The file " + fileName +
      " has no grid that can be read (its grids are: " + ListNames(file) +
      "); choose another file.");
  }
  return *best;
}

const VDBGrid& FindGrid(const VDBFile& file, const std::string& fileName, const std::string& name)
{
  for (const VDBGrid& grid : file.Grids)
  {
    if (grid.Name == name || grid.Name == name + "[0]")
    {
      return grid;
    }
  }
  throw std::invalid_argument("The file " + fileName + " has no grid \"" + name + "\"" +
    (file.Grids.empty() ? " and no other grid; choose another file."
                        : "; choose one of its grids: " + ListNames(file) + "."));
}

std::vector<VDBGrid> Choose(
  const VDBFile& file, const std::string& fileName, const std::vector<std::string>& names)
{
  if (names.empty())
  {
    return { ChooseBest(file, fileName) };
  }
  std::vector<VDBGrid> grids;
  for (const std::string& name : names)
  {
    const VDBGrid& grid = FindGrid(file, fileName, name);
    if (!grid.IsKnown)
    {
      std::ostringstream text;
      text << "The grid \"" << name << "\" of the file " << fileName << " cannot be read: "
           << (grid.Transform ? "its type " + grid.Type + " is not supported" +
                    (grid.GetValueType() != grid.Type ? " in a file of this version" : "")
                              : "its transform is not linear")
           << "; choose another GridName or file.";
      throw std::invalid_argument(text.str());
    }
    grids.push_back(grid);
    const bool isPoints = std::string(grid.GetValueType()) == "points";
    if (names.size() > 1 && (isPoints || *grid.Transform != *grids.front().Transform))
    {
      throw std::invalid_argument("The grid \"" + name +
        "\" cannot be read together with other grids: it holds points, or its transform differs "
        "from that of the first grid. Choose only one grid by GridName.");
    }
  }
  return grids;
}

}

bool ChosenGrids::AreOfPoints() const
{
  return !this->Grids.empty() && std::string(this->Grids.front().GetValueType()) == "points";
}

openvdb::CoordBBox ChosenGrids::FindActiveBox() const
{
  openvdb::CoordBBox box;
  for (const VDBGrid& grid : this->Grids)
  {
    box.expand(grid.ActiveBox);
  }
  return box;
}

ChosenGrids ChooseGrids(const std::string& fileName, const std::vector<std::string>& names)
{
  ChosenGrids chosen;
  chosen.FileName = fileName;
  chosen.File = ValidateVDB(fileName);
  chosen.Grids = Choose(chosen.File, fileName, names);
  return chosen;
}

double ImagePlace::CountPoints() const
{
  double count = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    count *= std::max(0.0, double(this->Extent[2 * axis + 1]) - this->Extent[2 * axis] + 1.0);
  }
  return count;
}

ImagePlace MakeImagePlace(
  const openvdb::math::Transform& transform, const openvdb::CoordBBox& box, int factor)
{
  const openvdb::Mat4d matrix = transform.baseMap()->getAffineMap()->getMat4();
  ImagePlace place;
  openvdb::Vec3d axes[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    axes[axis] = { matrix(axis, 0), matrix(axis, 1), matrix(axis, 2) };
    // Exact for axis-aligned vectors.
    const openvdb::Vec3d size = openvdb::math::Abs(axes[axis]);
    const double length =
      size.sum() == openvdb::math::Max(size[0], size[1], size[2]) ? size.sum() : size.length();
    axes[axis] /= length;
    place.Spacing[axis] = factor * length;
    place.Origin[axis] = matrix(3, axis);
    for (int d = 0; d < 3; ++d)
    {
      place.Direction[3 * d + axis] = axes[axis][d];
    }
    if (!box.empty())
    {
      place.Extent[2 * axis] = static_cast<int>(std::floor(box.min()[axis] / double(factor)));
      place.Extent[2 * axis + 1] = static_cast<int>(std::ceil(box.max()[axis] / double(factor)));
    }
  }
  constexpr double slack = 1e-6;
  const double skew = std::fabs(axes[0].dot(axes[1])) + std::fabs(axes[1].dot(axes[2])) +
    std::fabs(axes[2].dot(axes[0]));
  if (!(skew <= slack))
  {
    throw std::invalid_argument(
      "The chosen grid is sheared, but an image needs axes at right angles. Choose another "
      "GridName, or resample the grid first (vdb_tool, Houdini).");
  }
  return place;
}

openvdb::CoordBBox FindVoxels(const int region[6])
{
  constexpr int farthest = 1 << 30;
  const auto isFar = [](int x) { return x < -farthest || x > farthest; };
  if (std::any_of(region, region + 6, isFar) || region[0] > region[1] || region[2] > region[3] ||
    region[4] > region[5])
  {
    throw std::invalid_argument("IndexRegion is empty, or has an index beyond +-2^30; set minima "
                                "<= maxima within this range.");
  }
  return { { region[0], region[2], region[4] }, { region[1], region[3], region[5] } };
}

openvdb::CoordBBox FindVoxels(const openvdb::math::Transform& transform, const double bounds[6])
{
  openvdb::BBoxd index;
  bool isFinite = true;
  for (int corner = 0; corner < 8; ++corner)
  {
    const openvdb::Vec3d x(
      bounds[corner & 1], bounds[2 + (corner >> 1 & 1)], bounds[4 + (corner >> 2)]);
    const openvdb::Vec3d place = transform.worldToIndex(x);
    constexpr double farthest = 1 << 30;
    isFinite = isFinite && place.isFinite() && openvdb::math::Abs(place).sum() < farthest;
    index.expand(place);
  }
  if (!isFinite || bounds[0] > bounds[1] || bounds[2] > bounds[3] || bounds[4] > bounds[5])
  {
    throw std::invalid_argument("WorldRegion is empty, not finite or too far from the grid; set "
                                "finite minima <= maxima near the grid.");
  }
  return { openvdb::Coord::floor(index.min()), openvdb::Coord::ceil(index.max()) };
}

}
