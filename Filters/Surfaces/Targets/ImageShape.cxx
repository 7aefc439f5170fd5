#include "Targets/ImageShape.h"

#include "Input/AttachedData.h"
#include "Targets/GridFunction.h"
#include "Targets/ImageLevel.h"
#include "Targets/MovingTarget.h"
#include "Targets/ShapePreparation.h"

#include "vtkBoundingBox.h"
#include "vtkDataArray.h"
#include "vtkGridPotential.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace activesurface
{

namespace
{

vtkDataArray* AsSamples(vtkAbstractArray* values, vtkDataSet* image)
{
  vtkDataArray* numbers = vtkDataArray::SafeDownCast(values);
  if (!numbers || numbers->GetNumberOfComponents() != 1 ||
    numbers->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    const std::string name = values->GetName() ? values->GetName() : "";
    throw std::invalid_argument("The array \"" + name +
      "\" cannot give an image's values: it has to hold one number for each point.");
  }
  return numbers;
}

// Returns the lattice with only the samples or the attached grid.
vtkSmartPointer<vtkDataSet> ReadImage(const InputData& input)
{
  vtkAbstractArray* values = input.Chosen.FindValues();
  vtkSmartPointer<vtkDataSet> image;
  image.TakeReference(input.Data->NewInstance());
  image->CopyStructure(input.Data);
  if (values)
  {
    // Shares the array. VTK does not overwrite an image's array while another object refers to it.
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

std::string ImageShape::Prepare(ShapePreparation& preparation)
{
  if (!this->Function && preparation.IsDomainKnown)
  {
    vtkNew<vtkGridPotential> grid;
    const TargetOptions& options = preparation.Options.Level;
    ImageLevel level{ options.IsoValue, options.Invert };
    vtkDataArray* values = this->Data->GetPointData()->GetScalars();
    if (level.IsoValue == 0.0 && values)
    {
      level = FindUsualLevel(values, level);
    }
    grid->SetIsoValue(level.IsoValue);
    grid->SetInvertInside(level.Invert);
    ReadGrid(grid, this->Data);
    this->Function = grid;
    const std::string flaw = values ? DescribeNotFinite(values) : "";
    if (!flaw.empty())
    {
      preparation.Report("values not finite", "The image " + preparation.When + ": " + flaw);
    }
    return values ? DescribeLevel(values, level) : "";
  }
  return "";
}

std::string ImageShape::DescribeThinParts(const ShapeOptions& options) const
{
  return activesurface::DescribeThinParts(this->Function, options.VoxelSize);
}

void ImageShape::AddBounds(const ShapeOptions&, vtkBoundingBox&, vtkBoundingBox& images) const
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
  const TargetFrames& frames, const ShapeOptions& options) const
{
  TargetOptions level = options.Level;
  level.IsoValue = 0.0; // already applied by the function
  level.Invert = false;
  return MakeBlend(frames, options, level.Reach, level);
}

}
