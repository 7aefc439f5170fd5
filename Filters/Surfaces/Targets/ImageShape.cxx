#include "Targets/ImageShape.h"

#include "Input/AttachedData.h"
#include "Targets/GridFunction.h"
#include "Targets/LabelTarget.h"
#include "Targets/MovingTarget.h"
#include "Targets/TargetOptions.h"
#include "Targets/Warnings.h"

#include "vtkArrayDispatch.h"
#include "vtkBoundingBox.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkGridPotential.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace activesurface
{

namespace
{

/** Level and side of an image of a mask or of volume fractions. */
struct ImageLevel
{
  double IsoValue;
  bool Invert; //< inside is above the level
  bool IsOfMask = false;
  bool IsBlank = false; //< all values are equal and not negative
};

/**
 * Returns the level that suits the values; inside is above:
 *
 * - mask (only two different values, none negative): midway between the two values
 * - volume fractions (all > -0.1, the largest within 0.1 of 1, more than half within 0.001 of 0 or
 *   1): 0.5
 *
 * Returns `given` for other values, and if all values are equal. Ignores values that are not
 * finite.
 */
ImageLevel FindUsualLevel(vtkDataArray* values, const ImageLevel& given);

constexpr double Beyond = 0.1; // overshoot of fractions below 0 or above 1

constexpr double NearEnds = 1e-3;

// Range of the finite values, and the number of values of empty or full voxels.
struct ValueCounts
{
  double Low = HUGE_VAL, High = -HUGE_VAL;
  std::size_t AtEnds = 0; // values close to 0 or 1
  std::size_t All = 0;

  template <class Array>
  void operator()(Array* array)
  {
    for (const auto value : vtk::DataArrayValueRange<1>(array))
    {
      const auto number = static_cast<double>(value);
      if (std::isfinite(number))
      {
        this->Low = std::fmin(this->Low, number);
        this->High = std::fmax(this->High, number);
        this->AtEnds += std::fabs(number) < NearEnds || std::fabs(number - 1.0) < NearEnds ? 1 : 0;
        ++this->All;
      }
    }
  }
};

struct IsOfTwo
{
  double Low, High;
  bool Result = true;

  template <class Array>
  void operator()(Array* array)
  {
    for (const auto value : vtk::DataArrayValueRange<1>(array))
    {
      const auto number = static_cast<double>(value);
      if (std::isfinite(number) && number != this->Low && number != this->High)
      {
        this->Result = false;
        return;
      }
    }
  }
};

template <class Worker>
void Run(vtkDataArray* values, Worker& worker)
{
  if (!vtkArrayDispatch::Dispatch::Execute(values, worker))
  {
    worker(values);
  }
}

ImageLevel FindUsualLevel(vtkDataArray* values, const ImageLevel& given)
{
  ValueCounts counts;
  Run(values, counts);
  if (!(counts.Low < counts.High))
  {
    return { given.IsoValue, given.Invert, false, counts.Low == counts.High && counts.Low >= 0.0 };
  }
  IsOfTwo isMask{ counts.Low, counts.High };
  if (counts.Low >= 0.0)
  {
    Run(values, isMask);
    if (isMask.Result)
    {
      return { 0.5 * counts.Low + 0.5 * counts.High, true, true };
    }
  }
  const bool areFractions =
    counts.Low > -Beyond && std::fabs(counts.High - 1.0) < Beyond && 2 * counts.AtEnds > counts.All;
  return areFractions ? ImageLevel{ 0.5, true } : given;
}

std::string DescribeNotFinite(vtkDataArray* values)
{
  if (values->GetDataType() != VTK_FLOAT && values->GetDataType() != VTK_DOUBLE)
  {
    return "";
  }
  ValueCounts counts;
  Run(values, counts);
  const auto all = static_cast<std::size_t>(values->GetNumberOfTuples());
  const std::size_t bad = all - counts.All;
  if (bad == 0)
  {
    return "";
  }
  return std::to_string(bad) + " of its " + std::to_string(all) + " values " +
    (bad == 1 ? "is" : "are") +
    " not finite (NaN or infinity). NaN counts as outside in the first skin, in new parts and in "
    "smoothed masks, where hollows may appear; elsewhere NaN does not attract the skin. Infinity "
    "counts by its sign. Replace such values by finite values.";
}

std::string DescribeLevel(vtkDataArray* values, const ImageLevel& level)
{
  ValueCounts counts;
  Run(values, counts);
  const bool hasInside = level.Invert ? counts.High > level.IsoValue : counts.Low < level.IsoValue;
  if (hasInside || !(counts.Low < counts.High))
  {
    return "";
  }
  std::ostringstream text;
  text << "Its values are from " << counts.Low << " to " << counts.High << ", and inside is "
       << (level.Invert ? "above " : "below ") << level.IsoValue
       << ", so nothing is inside; set TargetIsoValue, and turn InvertTarget on if inside is above "
       << "it, else off. If the values are labels, choose one label by vtkImageThreshold.";
  return text.str();
}

vtkDataArray* AsSamples(vtkAbstractArray* values, vtkDataSet* image)
{
  vtkDataArray* numbers = vtkDataArray::SafeDownCast(values);
  if (!numbers || numbers->GetNumberOfComponents() != 1 ||
    numbers->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    const std::string name = values->GetName() ? values->GetName() : "";
    throw std::invalid_argument("The array \"" + name +
      "\" cannot be used as the image's values, which need one number for each point; choose "
      "another array by SetInputArrayToProcess(3, ...), at input port 1 (4, ...).");
  }
  return numbers;
}

// Returns a copy with only the lattice and the samples or the attached grid.
vtkSmartPointer<vtkDataSet> ReadImage(const InputData& input)
{
  vtkAbstractArray* values = input.Chosen.FindValues();
  vtkSmartPointer<vtkDataSet> image;
  image.TakeReference(input.Data->NewInstance());
  image->CopyStructure(input.Data);
  if (values)
  {
    // Shares the array. VTK's algorithms do not overwrite an image's array while another object
    // refers to it.
    image->GetPointData()->SetScalars(AsSamples(values, input.Data));
  }
  else
  {
    CopyAttachedGrid(input.Data->GetInformation(), image->GetInformation());
  }
  return image;
}

}

bool ImageShape::Fits(vtkDataSet* data)
{
  return vtkImageData::SafeDownCast(data) != nullptr;
}

ImageShape::ImageShape(const InputData& input)
  : FunctionShape(ReadImage(input))
{
}

// Makes the function of a mask that is smoothed as a label; inside is above the level. Returns
// false if no pixel is above the level.
bool ImageShape::PrepareLabel(double level)
{
  const auto samples = MakeLabelSamples(vtkImageData::SafeDownCast(this->Data), level, this->Label);
  this->IsLabel = true;
  if (samples)
  {
    vtkNew<vtkGridPotential> grid;
    grid->SetSamples(samples);
    this->Function = grid;
  }
  return samples != nullptr;
}

std::string ImageShape::Prepare(const TargetOptions& options, const Warnings& messages)
{
  if (this->Function || !options.IsDomainKnown)
  {
    return "";
  }
  vtkDataArray* values = this->Data->GetPointData()->GetScalars();
  const std::string flaw = values ? DescribeNotFinite(values) : "";
  if (!flaw.empty())
  {
    messages.Say("values not finite", "The image " + options.When + ": " + flaw);
  }
  ImageLevel level{ options.IsoValue, options.Invert };
  if (level.IsoValue == 0.0 && values)
  {
    level = FindUsualLevel(values, level);
  }
  const bool mayBeLabel = options.SmoothsLabels && !options.Invert;
  if (mayBeLabel && (level.IsOfMask || level.IsBlank) &&
    this->PrepareLabel(level.IsBlank ? std::numeric_limits<double>::max() : level.IsoValue))
  {
    return "";
  }
  vtkNew<vtkGridPotential> grid;
  grid->SetIsoValue(level.IsoValue);
  grid->SetInvertInside(level.Invert);
  ReadGrid(grid, this->Data);
  this->Function = grid;
  return values ? DescribeLevel(values, level) : "";
}

std::string ImageShape::DescribeThinParts(const TargetOptions& options) const
{
  return activesurface::DescribeThinParts(this->Function, options.VoxelSize);
}

void ImageShape::AddBounds(const TargetOptions&, vtkBoundingBox&, vtkBoundingBox& images) const
{
  double bounds[6];
  this->Data->GetBounds(bounds);
  images.AddBounds(bounds);
}

double ImageShape::GetPixel() const
{
  double least = 0.0;
  auto image = vtkImageData::SafeDownCast(this->Data);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double spacing = std::fabs(image->GetSpacing()[axis]);
    if (image->GetDimensions()[axis] > 1 && spacing > 0.0)
    {
      least = least > 0.0 ? std::min(least, spacing) : spacing;
    }
  }
  return least;
}

std::unique_ptr<MovingTarget> ImageShape::MakeTarget(
  const TargetFrames& frames, const TargetOptions& options) const
{
  TargetOptions level = options;
  level.IsoValue = 0.0; // already applied by the function
  level.Invert = false;
  if (options.SmoothsLabels)
  {
    return std::make_unique<LabelTarget>(frames, level.Reach, true, level);
  }
  return MakeBlend(frames, level.Reach, level);
}

}
