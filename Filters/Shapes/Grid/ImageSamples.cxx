#include "Grid/ImageSamples.h"

#include "Base/LatticeShape.h"
#include "Base/Trilinear.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace activesurface
{

namespace
{

vtkDataArray* FirstArrayOfOneComponent(vtkPointData* data)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    if (array && array->GetNumberOfComponents() == 1)
    {
      return array;
    }
  }
  return nullptr;
}

vtkDataArray* FindPixels(vtkImageData* image, const std::string& name)
{
  vtkPointData* data = image->GetPointData();
  vtkDataArray* array = name.empty() ? data->GetScalars() : data->GetArray(name.c_str());
  if (!array && name.empty())
  {
    array = FirstArrayOfOneComponent(data);
  }
  const std::string called =
    name.empty() ? "The image's active point array" : "The image's point array \"" + name + "\"";
  if (!array)
  {
    throw std::invalid_argument(name.empty()
        ? "The image has no numeric point array of one component; add one, or convert cell data "
          "to point data (vtkCellDataToPointData)."
        : called + " is missing, or does not hold numbers; check ScalarArrayName.");
  }
  if (array->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(called + " has " + std::to_string(array->GetNumberOfComponents()) +
      " components, where one number per pixel is needed; set ScalarArrayName to another array.");
  }
  if (array->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    throw std::invalid_argument(called + " has " + std::to_string(array->GetNumberOfTuples()) +
      " values for " + std::to_string(image->GetNumberOfPoints()) + " pixels; each needs one.");
  }
  return array;
}

void CheckExtent(const int extent[6])
{
  const bool isEmpty = extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5];
  if (isEmpty)
  {
    throw std::invalid_argument("The image is empty: it has no pixels; connect another image.");
  }
  if (extent[0] == extent[1] || extent[2] == extent[3] || extent[4] == extent[5])
  {
    throw std::invalid_argument(
      "The image is flat; connect an image of at least two pixels along each axis.");
  }
}

// Accepts axes that are orthogonal within a tolerance, because scanners round their matrices.
bool AreOrthogonal(const double axis[3][3])
{
  constexpr double tolerance = 1e-3;
  bool areOrthogonal = true;
  for (int i = 0; i < 3; ++i)
  {
    const double* a = axis[i];
    const double* b = axis[(i + 1) % 3];
    areOrthogonal = areOrthogonal &&
      std::fabs(vtkMath::Dot(a, b)) <= tolerance * vtkMath::Norm(a) * vtkMath::Norm(b);
  }
  return areOrthogonal;
}

}

ImageSamples::ImageSamples(vtkImageData* image, const ImageLevel& level)
  : IsoValue(level.IsoValue)
  , Sign(level.InvertInside ? -1.0 : 1.0)
  , Beyond(level.Beyond)
{
  if (!std::isfinite(level.IsoValue))
  {
    throw std::invalid_argument("IsoValue has to be a finite number.");
  }
  image->GetExtent(this->Extent);
  CheckExtent(this->Extent);
  this->Pixels = FindPixels(image, level.ArrayName);
  this->ReadAxes(image);
}

ImageSamples::~ImageSamples() = default;

void ImageSamples::ReadAxes(vtkImageData* image)
{
  const double* spacing = image->GetSpacing();
  image->GetOrigin(this->Origin);
  double columns[3][3];
  double farthest = 0.0;
  double finest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int d = 0; d < 3; ++d)
    {
      this->Axis[axis][d] = image->GetDirectionMatrix()->GetElement(d, axis) * spacing[axis];
      columns[d][axis] = this->Axis[axis][d];
    }
    this->Spacing[axis] = vtkMath::Norm(this->Axis[axis]);
    const int last =
      std::max(std::abs(this->Extent[2 * axis]), std::abs(this->Extent[2 * axis + 1]));
    farthest += std::fabs(this->Origin[axis]) + this->Spacing[axis] * last;
    finest = std::min(finest, this->Spacing[axis]);
  }
  if (!std::isfinite(farthest) || !(finest > 0.0) || !AreOrthogonal(this->Axis))
  {
    throw std::invalid_argument("The image has no position in space: its origin or spacing is not "
                                "finite, a spacing is 0, or axes are not orthogonal; fix them.");
  }
  vtkMath::Invert3x3(columns, this->Inverse);
  constexpr double roundings = 32.0;
  this->Slack = roundings * std::numeric_limits<double>::epsilon() * (1.0 + farthest / finest);
}

void ImageSamples::Locate(const double x[3], double place[3]) const
{
  constexpr double farthest = 1e150; // squares stay finite
  double from[3];
  for (int d = 0; d < 3; ++d)
  {
    from[d] = std::min(std::max(x[d] - this->Origin[d], -farthest), farthest);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    place[axis] = vtkMath::Dot(this->Inverse[axis], from);
  }
}

double ImageSamples::Evaluate(const double x[3], double* gradient) const
{
  if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
  {
    const double none = std::numeric_limits<double>::quiet_NaN();
    if (gradient)
    {
      std::fill_n(gradient, 3, none);
    }
    return none;
  }
  double place[3], excess[3];
  this->Locate(x, place);
  bool isOutside = false;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double nearest = std::min(
      std::max(place[axis], double(this->Extent[2 * axis])), double(this->Extent[2 * axis + 1]));
    excess[axis] = place[axis] - nearest;
    isOutside = isOutside || std::fabs(excess[axis]) > this->Slack;
    place[axis] = nearest;
  }
  if (!isOutside)
  {
    return this->Interpolate(place, gradient);
  }
  if (this->Beyond < 0.0)
  {
    return this->DistanceToBox(excess, gradient);
  }
  std::fill_n(gradient, gradient ? 3 : 0, 0.0);
  return this->Beyond;
}

// Returns a distance [length]. excess: offset from the nearest point of the box [pixels].
double ImageSamples::DistanceToBox(const double excess[3], double* gradient) const
{
  double away[3] = { 0.0, 0.0, 0.0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int d = 0; d < 3; ++d)
    {
      away[d] += excess[axis] * this->Axis[axis][d];
    }
  }
  const double distance = std::hypot(away[0], away[1], away[2]);
  for (int d = 0; gradient && d < 3; ++d)
  {
    gradient[d] = distance > 0.0 ? away[d] / distance : 0.0;
  }
  return distance;
}

// place: lattice coordinates within the extent.
double ImageSamples::Interpolate(const double place[3], double* gradient) const
{
  vtkIdType lower = 0;
  vtkIdType stride[3], step = 1;
  double t[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const int first = this->Extent[2 * axis], last = this->Extent[2 * axis + 1];
    const int pixel = std::min(static_cast<int>(std::floor(place[axis])), last - 1);
    t[axis] = place[axis] - pixel;
    stride[axis] = step;
    lower += step * (vtkIdType(pixel) - first);
    step *= vtkIdType(last) - first + 1;
  }
  double corner[CornersOfCell];
  for (int c = 0; c < CornersOfCell; ++c)
  {
    const vtkIdType pixel =
      lower + (c >> 2) * stride[0] + (c >> 1 & 1) * stride[1] + (c & 1) * stride[2];
    corner[c] = this->Sign * (this->Pixels->GetComponent(pixel, 0) - this->IsoValue);
  }
  double rise[3];
  const double value = Trilinear(corner, t, rise);
  for (int d = 0; gradient && d < 3; ++d)
  {
    gradient[d] =
      rise[0] * this->Inverse[0][d] + rise[1] * this->Inverse[1][d] + rise[2] * this->Inverse[2][d];
  }
  return value;
}

double ImageSamples::GetSample(const int pixel[3]) const
{
  vtkIdType id = 0;
  for (int axis = 2; axis >= 0; --axis)
  {
    const vtkIdType first = this->Extent[2 * axis], last = this->Extent[2 * axis + 1];
    id = id * (last - first + 1) + (pixel[axis] - first);
  }
  return this->Sign * (this->Pixels->GetComponent(id, 0) - this->IsoValue);
}

// Samples the crossings of the surface with lines of pixels along each axis: one of skip^2 lines,
// at most about 4 million pixels. The area of a crossing is |n_axis| (n: unit normal) times the
// cross-section of a pixel: over all lines of all axes, the areas add up to the surface's area, as
// n has length 1. If lines or crossings are left out, only ratios of areas are meaningful.
SurfaceSample ImageSamples::SampleSurface() const
{
  constexpr double mostPixels = 4e6;
  double pixels = 3.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    pixels *= double(this->Extent[2 * axis + 1]) - this->Extent[2 * axis] + 1.0;
  }
  const int skip = std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / mostPixels))));
  SurfaceGatherer surface;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const double area = this->Spacing[b] * this->Spacing[c];
    int pixel[3];
    for (pixel[b] = this->Extent[2 * b]; pixel[b] <= this->Extent[2 * b + 1]; pixel[b] += skip)
    {
      for (pixel[c] = this->Extent[2 * c]; pixel[c] <= this->Extent[2 * c + 1]; pixel[c] += skip)
      {
        this->SampleLine(axis, pixel, area, surface);
      }
    }
  }
  SurfaceSample sample;
  sample.Points = std::move(surface.Points);
  sample.Detail = std::min({ this->Spacing[0], this->Spacing[1], this->Spacing[2] });
  return sample;
}

void ImageSamples::SampleLine(int axis, int pixel[3], double area, SurfaceGatherer& surface) const
{
  pixel[axis] = this->Extent[2 * axis];
  double before = this->GetSample(pixel);
  while (++pixel[axis] <= this->Extent[2 * axis + 1])
  {
    const double value = this->GetSample(pixel);
    const bool crosses = std::isfinite(before - value) && (before < 0.0) != (value < 0.0);
    if (crosses && surface.WantsNext())
    {
      double place[3] = { double(pixel[0]), double(pixel[1]), double(pixel[2]) };
      place[axis] -= value / (value - before);
      SurfacePoint point;
      this->Interpolate(place, point.Normal.data());
      vtkMath::Normalize(point.Normal.data());
      for (int d = 0; d < 3; ++d)
      {
        point.Place[d] = this->Origin[d] + place[0] * this->Axis[0][d] +
          place[1] * this->Axis[1][d] + place[2] * this->Axis[2][d];
      }
      point.Area =
        area * std::fabs(vtkMath::Dot(point.Normal.data(), this->Axis[axis])) / this->Spacing[axis];
      surface.Add(point);
    }
    before = value;
  }
}

bool ImageSamples::GetBounds(double bounds[6]) const
{
  for (int d = 0; d < 3; ++d)
  {
    bounds[2 * d] = bounds[2 * d + 1] = this->Origin[d];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double first = this->Extent[2 * axis] * this->Axis[axis][d];
      const double last = this->Extent[2 * axis + 1] * this->Axis[axis][d];
      bounds[2 * d] += std::min(first, last);
      bounds[2 * d + 1] += std::max(first, last);
    }
  }
  return true;
}

// Returns false if no pixel of the block is inside.
bool ImageSamples::FillBlock(double level, const openvdb::Coord& origin, PixelMask& inside) const
{
  bool isAny = false;
  int first[3], last[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    first[axis] = std::max(origin[axis], this->Extent[2 * axis]);
    last[axis] = std::min(origin[axis] + 7, this->Extent[2 * axis + 1]);
  }
  int pixel[3];
  for (pixel[0] = first[0]; pixel[0] <= last[0]; ++pixel[0])
  {
    for (pixel[1] = first[1]; pixel[1] <= last[1]; ++pixel[1])
    {
      for (pixel[2] = first[2]; pixel[2] <= last[2]; ++pixel[2])
      {
        if (this->GetSample(pixel) < level)
        {
          inside.setOn((pixel[0] & 7) << 6 | (pixel[1] & 7) << 3 | (pixel[2] & 7));
          isAny = true;
        }
      }
    }
  }
  return isAny;
}

// Space beyond the image is outside. Blocks that are entirely inside become leaves, not tiles.
bool ImageSamples::FindShape(double level, LatticeShape& shape) const
{
  using Leaf = openvdb::MaskTree::LeafNodeType;
  std::vector<openvdb::Coord> origins;
  for (int x = this->Extent[0] & ~7; x <= this->Extent[1]; x += 8)
  {
    for (int y = this->Extent[2] & ~7; y <= this->Extent[3]; y += 8)
    {
      for (int z = this->Extent[4] & ~7; z <= this->Extent[5]; z += 8)
      {
        origins.emplace_back(x, y, z);
      }
    }
  }
  std::vector<PixelMask> masks(origins.size());
  std::vector<char> isUsed(origins.size());
  tbb::parallel_for(std::size_t(0), origins.size(),
    [&](std::size_t i) { isUsed[i] = this->FillBlock(level, origins[i], masks[i]); });
  for (std::size_t i = 0; i < origins.size(); ++i)
  {
    if (isUsed[i])
    {
      auto leaf = new Leaf(origins[i]); // owned by the tree from addLeaf on
      leaf->setValueMask(masks[i]);
      shape.Inside.addLeaf(leaf);
    }
  }
  shape.Origin = openvdb::Vec3d(this->Origin);
  for (int axis = 0; axis < 3; ++axis)
  {
    shape.Axis[axis] = openvdb::Vec3d(this->Axis[axis]);
  }
  return true;
}

}
