#include "Grid/LabelSamples.h"

#include "Grid/ImageSamples.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArrayRange.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

namespace
{

// Width of the margin around the label's box [pixels]. Points beyond the margin have the distance
// LabelMargin - 1/2.
constexpr int LabelMargin = 4;

using Box = std::array<int, 6>;

std::size_t GetLength(const Box& box, std::size_t axis)
{
  const int pixels = box[2 * axis + 1] - box[2 * axis] + 1;
  return pixels > 0 ? static_cast<std::size_t>(pixels) : 0;
}

std::size_t CountPixels(const Box& box)
{
  return GetLength(box, 0) * GetLength(box, 1) * GetLength(box, 2);
}

// Calls visit(x, y, z, i) for each pixel of a box. i: index in an image whose extent is the box.
template <class Visit>
void ForEachPixel(const Box& box, Visit&& visit)
{
  std::size_t i = 0;
  for (int z = box[4]; z <= box[5]; ++z)
  {
    for (int y = box[2]; y <= box[3]; ++y)
    {
      for (int x = box[0]; x <= box[1]; ++x)
      {
        visit(x, y, z, i++);
      }
    }
  }
}

// Finds which pixels of an image are above the level, their number and their box.
struct FindLabel
{
  Box Extent;
  double Level;
  std::vector<unsigned char> Inside;
  std::size_t Count = 0;
  Box Bounds = { 1, 0, 1, 0, 1, 0 };

  template <class Array>
  void operator()(Array* array)
  {
    const auto values = vtk::DataArrayValueRange<1>(array);
    this->Inside.resize(CountPixels(this->Extent));
    ForEachPixel(this->Extent,
      [&](int x, int y, int z, std::size_t i)
      {
        if (static_cast<double>(values[static_cast<vtkIdType>(i)]) > this->Level)
        {
          this->Inside[i] = 1;
          this->Include({ x, y, z });
        }
      });
  }

private:
  void Include(const std::array<int, 3>& pixel)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      int &low = this->Bounds[2 * axis], &high = this->Bounds[2 * axis + 1];
      low = this->Count == 0 ? pixel[axis] : std::min(low, pixel[axis]);
      high = this->Count == 0 ? pixel[axis] : std::max(high, pixel[axis]);
    }
    ++this->Count;
  }
};

// Exceeds every squared distance [pixels^2] in images of up to 13,000 pixels along each axis. Twice
// this number does not overflow.
constexpr std::int32_t Unknown = 1 << 29;

// Sets each squares[i] to the least line[j] + (i - j)^2 over all j.
void SpreadSquares(std::vector<std::int32_t>& line, std::vector<std::int32_t>& squares)
{
  const auto size = static_cast<std::int32_t>(line.size());
  squares = line;
  for (std::int32_t i = 0; i < size; ++i)
  {
    std::int32_t& least = squares[static_cast<std::size_t>(i)];
    for (std::int32_t d = 1; d < size && d * d < least; ++d)
    {
      for (const std::int32_t j : { i - d, i + d })
      {
        least =
          j >= 0 && j < size ? std::min(least, line[static_cast<std::size_t>(j)] + d * d) : least;
      }
    }
  }
}

// Calls SpreadSquares for all lines of an image along an axis. box: extent of the image.
void SpreadAlong(std::size_t axis, const Box& box, std::vector<std::int32_t>& squares)
{
  const std::size_t size = GetLength(box, axis);
  const std::size_t stride =
    axis == 0 ? 1 : GetLength(box, 0) * (axis == 1 ? 1 : GetLength(box, 1));
  tbb::parallel_for(std::size_t(0), squares.size() / size,
    [&](std::size_t number)
    {
      thread_local std::vector<std::int32_t> line, spread;
      const std::size_t first = number / stride * stride * size + number % stride;
      line.resize(size);
      for (std::size_t i = 0; i < size; ++i)
      {
        line[i] = squares[first + stride * i];
      }
      if (std::all_of(line.begin(), line.end(), [](std::int32_t n) { return n == Unknown; }))
      {
        return;
      }
      SpreadSquares(line, spread);
      for (std::size_t i = 0; i < size; ++i)
      {
        squares[first + stride * i] = spread[i];
      }
    });
}

// For each marked pixel, writes sign * (distance to the nearest unmarked pixel - 1/2) [pixels]. The
// squared distances are exact integers, spread axis by axis.
void WriteDistances(
  const Box& box, const std::vector<unsigned char>& marks, double sign, float* distances)
{
  std::vector<std::int32_t> squares(marks.size());
  std::transform(marks.begin(), marks.end(), squares.begin(),
    [](unsigned char mark) { return mark ? Unknown : 0; });
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    SpreadAlong(axis, box, squares);
  }
  for (std::size_t i = 0; i < marks.size(); ++i)
  {
    distances[i] =
      marks[i] ? static_cast<float>(sign * (std::sqrt(double(squares[i])) - .5)) : distances[i];
  }
}

// Returns an image of the signed distances in a box around the label.
vtkSmartPointer<vtkImageData> MakeDistances(vtkImageData* image, const FindLabel& label)
{
  Box box = label.Bounds;
  for (std::size_t side = 0; side < 6; ++side)
  {
    box[side] += side % 2 == 0 ? -LabelMargin : LabelMargin;
  }
  std::vector<unsigned char> inside(CountPixels(box)), outside(inside.size(), 1);
  const Box& all = label.Extent;
  const std::size_t row = GetLength(all, 0), slice = row * GetLength(all, 1);
  ForEachPixel(box,
    [&](int x, int y, int z, std::size_t i)
    {
      const bool isKnown =
        x >= all[0] && x <= all[1] && y >= all[2] && y <= all[3] && z >= all[4] && z <= all[5];
      if (isKnown)
      {
        inside[i] = label.Inside[slice * static_cast<std::size_t>(z - all[4]) +
          row * static_cast<std::size_t>(y - all[2]) + static_cast<std::size_t>(x - all[0])];
        outside[i] = 1 - inside[i];
      }
    });
  auto result = vtkSmartPointer<vtkImageData>::New();
  result->SetExtent(box[0], box[1], box[2], box[3], box[4], box[5]);
  result->SetOrigin(image->GetOrigin());
  result->SetSpacing(image->GetSpacing());
  result->SetDirectionMatrix(image->GetDirectionMatrix());
  result->AllocateScalars(VTK_FLOAT, 1);
  auto* distances = static_cast<float*>(result->GetScalarPointer());
  WriteDistances(box, inside, -1.0, distances);
  WriteDistances(box, outside, 1.0, distances);
  return result;
}

}

std::shared_ptr<const GridSamples> MakeLabelSamples(
  vtkImageData* image, double level, LabelFacts& facts)
{
  const ImageSamples check(image, { "", level, true }); // throws for an unusable image
  const double* spacing = image->GetSpacing();
  const auto [least, largest] =
    std::minmax({ std::fabs(spacing[0]), std::fabs(spacing[1]), std::fabs(spacing[2]) });
  facts.LeastPixel = least;
  facts.LargestPixel = largest;
  FindLabel label;
  image->GetExtent(label.Extent.data());
  label.Level = level;
  vtkDataArray* values = image->GetPointData()->GetScalars();
  if (!vtkArrayDispatch::Dispatch::Execute(values, label))
  {
    label(values);
  }
  facts.Volume = static_cast<double>(label.Count) * std::fabs(spacing[0] * spacing[1] * spacing[2]);
  if (label.Count == 0)
  {
    return nullptr;
  }
  ImageLevel surface;
  surface.Beyond = LabelMargin - .5;
  return std::make_shared<ImageSamples>(MakeDistances(image, label), surface);
}

}
