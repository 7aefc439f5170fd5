#include "Targets/ImageLevel.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>

namespace activesurface
{

namespace
{

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

}

ImageLevel FindUsualLevel(vtkDataArray* values, const ImageLevel& given)
{
  ValueCounts counts;
  Run(values, counts);
  if (!(counts.Low < counts.High))
  {
    return given;
  }
  IsOfTwo isMask{ counts.Low, counts.High };
  if (counts.Low >= 0.0)
  {
    Run(values, isMask);
    if (isMask.Result)
    {
      return { 0.5 * counts.Low + 0.5 * counts.High, true };
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
  if (counts.All == all)
  {
    return "";
  }
  return std::to_string(all - counts.All) + " of its " + std::to_string(all) +
    " values are not finite (NaN or infinity): voxels that touch them have no surface. Replace "
    "them by a value inside or outside.";
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
       << ", so nothing is inside; set TargetIsoValue, and InvertTarget if inside is above it. Of "
       << "several labels choose one, by a threshold (vtkImageThreshold).";
  return text.str();
}

}
