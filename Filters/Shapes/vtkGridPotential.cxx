#include "vtkGridPotential.h"

#include "Base/ErrorText.h"
#include "Base/LatticeShape.h"
#include "Grid/GridSamples.h"
#include "Grid/ImageSamples.h"
#include "Grid/LevelSetSamples.h"
#include "Grid/MeshSamples.h"
#include "Grid/SurfaceSample.h"
#include "Input/AttachedGrid.h"
#include "Input/BatchEvaluation.h"
#include "Input/FunctionInput.h"
#include "Input/MeshTriangles.h"
#include "Surface/LatticeParts.h"
#include "Surface/LatticeSurface.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <tbb/parallel_for.h>
#include <utility>

namespace activesurface
{

namespace
{

// Finds the fraction of a surface that belongs to sheets, rods and balls thinner than a length.
//
// The body is thin at a surface point if, within that length, the function is positive at two
// points of the normal's line, one on either side. One of the two points is outside near the
// surface point, the other behind the opposite side of the body. The test needs neither distances,
// nor voxels that resolve the part, nor oriented normals. At the two points the gradient has to
// point away from the surface point, within 45 degrees of the line. Edges of a cube, or of any
// wedge of more than 45 degrees, are therefore not thin: the lattice rounds these edges off, but
// does not lose them.

// Equidistant points along a normal.
struct RayPoints
{
  double Step;
  int Count;
};

RayPoints MakeRayPoints(const SurfaceSample& surface, double thickness)
{
  constexpr double within = 0.99; // tolerance, so that parts of exactly this thickness are not thin
  constexpr double part = 0.25;   // step / smaller of thickness and Detail
  constexpr double mostSteps = 256.0;
  const double length = (surface.IsMiddle ? 0.5 : 1.0) * within * thickness;
  const double step = part * std::min(thickness, surface.Detail);
  const double count = std::min(std::ceil(length / step), mostSteps);
  return { length / count, static_cast<int>(count) };
}

// Returns true if, at a point of the ray along the normal, the function is positive and its
// gradient is within 45 degrees of the ray's direction.
bool LeadsOut(
  const GridSamples& function, const SurfacePoint& from, double sense, const RayPoints& ray)
{
  constexpr double steepest = 0.70710678118654752440; // the cosine of 45 degrees
  for (int i = 1; i <= ray.Count; ++i)
  {
    double x[3], gradient[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis] = from.Place[axis] + sense * (i * ray.Step) * from.Normal[axis];
    }
    const double value = function.Evaluate(x, gradient);
    const double rise = sense * vtkMath::Dot(gradient, from.Normal.data());
    if (value > 0.0 && rise > 0.0 && rise >= steepest * vtkMath::Norm(gradient))
    {
      return true;
    }
  }
  return false;
}

// Returns the fraction of the area, 0 to 1, of parts thinner than `thickness`; 0 without points.
double FindThinShare(const GridSamples& function, const SurfaceSample& surface, double thickness)
{
  const RayPoints ray = MakeRayPoints(surface, thickness);
  const std::vector<SurfacePoint>& points = surface.Points;
  std::vector<char> isThin(points.size());
  constexpr std::size_t grain = 64;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), grain),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        isThin[i] =
          LeadsOut(function, points[i], 1.0, ray) && LeadsOut(function, points[i], -1.0, ray);
      }
    });
  double whole = 0.0, thin = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    whole += points[i].Area;
    thin += isThin[i] ? points[i].Area : 0.0;
  }
  return whole > 0.0 ? thin / whole : 0.0;
}

}
}

vtkStandardNewMacro(vtkGridPotential);

namespace
{
constexpr double Outside = 1.0; // F without samples
}

struct vtkGridPotential::Internals
{
  activesurface::FunctionInput Input;
  std::shared_ptr<const activesurface::GridSamples> Given; // from SetSamples, in place of an input

  // Results of Build.
  std::shared_ptr<const activesurface::GridSamples> Samples;
  std::string Defects;
  std::string Error;

  // Results of FindParts.
  std::shared_ptr<const activesurface::LatticeParts> Parts;
  double LevelOfParts = 0.0;
  std::mutex Finding;
};

vtkGridPotential::vtkGridPotential()
  : Internal(new Internals)
{
}

vtkGridPotential::~vtkGridPotential() = default;

void vtkGridPotential::SetInput(vtkDataSet* input)
{
  Internals& own = *this->Internal;
  if (own.Input.SetData(input) || own.Given)
  {
    own.Given = nullptr;
    this->Modified();
  }
}

void vtkGridPotential::SetInputConnection(vtkAlgorithmOutput* output)
{
  Internals& own = *this->Internal;
  if (own.Input.Connect(output) || own.Given)
  {
    own.Given = nullptr;
    this->Modified();
  }
}

vtkAlgorithmOutput* vtkGridPotential::GetInputConnection()
{
  return this->Internal->Input.GetConnection();
}

vtkDataSet* vtkGridPotential::GetInput()
{
  return vtkDataSet::SafeDownCast(this->Internal->Input.GetData());
}

void vtkGridPotential::SetSamples(std::shared_ptr<const activesurface::GridSamples> samples)
{
  this->Internal->Input.SetData(nullptr);
  this->Internal->Given = std::move(samples);
  this->Modified();
}

void vtkGridPotential::SetScalarArrayName(const char* name)
{
  const std::string wanted = name ? name : "";
  if (this->ScalarArrayName != wanted)
  {
    this->ScalarArrayName = wanted;
    this->Modified();
  }
}

vtkMTimeType vtkGridPotential::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->Internal->Input.FindMTime());
}

void vtkGridPotential::Build()
{
  // GetMTime() would include changes of the transform, which do not affect the samples.
  const vtkMTimeType changed = this->vtkObject::GetMTime(); // NOLINT(bugprone-parent-virtual-call)
  this->Internal->Input.ReadIfChanged(changed, [this] { this->ReadSamples(); });
}

void vtkGridPotential::ReadSamples()
{
  Internals& own = *this->Internal;
  own.Samples = nullptr;
  own.Parts = nullptr;
  own.Defects.clear();
  own.Error.clear();
  try
  {
    own.Samples = this->MakeSamples();
    own.Error = own.Samples ? "" : "There is no input; connect an image or a closed mesh.";
  }
  catch (const std::exception& error)
  {
    own.Error = activesurface::TextOf(error);
    if (this->ReportErrors)
    {
      vtkErrorMacro(<< own.Error << " The function is " << Outside << " (outside) everywhere.");
    }
  }
  if (own.Samples && !own.Defects.empty() && this->WarnOfDefects)
  {
    vtkWarningMacro(<< own.Defects
                    << " Correct the mesh. With MeshThickness > 0 an open mesh becomes a shell; "
                    << "with 0 its holes are closed by winding numbers.");
  }
}

std::shared_ptr<const activesurface::GridSamples> vtkGridPotential::MakeSamples()
{
  Internals& own = *this->Internal;
  own.Input.Update();
  vtkDataObject* input = own.Input.GetData();
  if (own.Given || !input)
  {
    return own.Given;
  }
  if (auto image = vtkImageData::SafeDownCast(input))
  {
    const activesurface::ImageLevel level{ this->ScalarArrayName, this->IsoValue,
      this->InvertInside != 0 };
    const auto grid = activesurface::GetAttachedGrid(image->GetInformation());
    if (grid && image->GetPointData()->GetNumberOfArrays() == 0)
    {
      return std::make_shared<activesurface::LevelSetSamples>(grid, level);
    }
    return std::make_shared<activesurface::ImageSamples>(image, level);
  }
  if (auto polyData = vtkPolyData::SafeDownCast(input))
  {
    const activesurface::MeshTriangles mesh = activesurface::ReadTriangles(polyData);
    own.Defects = mesh.Defects.Describe();
    return std::make_shared<activesurface::MeshSamples>(mesh,
      activesurface::MeshMeasure{ this->VoxelSize, this->Reach, this->MeshThickness,
        static_cast<double>(this->MaximumNumberOfVoxels) });
  }
  throw std::invalid_argument(std::string("A ") + input->GetClassName() +
    " is neither an image nor a mesh; connect a vtkImageData, or a vtkPolyData of polygons.");
}

bool vtkGridPotential::GetGridBounds(double bounds[6])
{
  this->Build();
  vtkMath::UninitializeBounds(bounds);
  return this->Internal->Samples && this->Internal->Samples->GetBounds(bounds);
}

const char* vtkGridPotential::GetDefects()
{
  this->Build();
  return this->Internal->Defects.c_str();
}

const char* vtkGridPotential::GetError()
{
  this->Build();
  return this->Internal->Error.c_str();
}

double vtkGridPotential::FindThinShare(double thickness)
{
  this->Build();
  const activesurface::GridSamples* samples = this->Internal->Samples.get();
  return samples ? activesurface::FindThinShare(*samples, samples->SampleSurface(), thickness)
                 : 0.0;
}

std::shared_ptr<const activesurface::LatticeParts> vtkGridPotential::FindParts(double level)
{
  this->Build();
  Internals& own = *this->Internal;
  const std::lock_guard<std::mutex> lock(own.Finding);
  if (!own.Parts || own.LevelOfParts != level)
  {
    activesurface::LatticeShape shape;
    own.Parts = own.Samples && own.Samples->FindShape(level, shape)
      ? std::make_shared<activesurface::LatticeParts>(shape)
      : nullptr;
    own.LevelOfParts = level;
  }
  return own.Parts;
}

activesurface::SurfacePoints vtkGridPotential::FindSurface(double level)
{
  this->Build();
  activesurface::LatticeShape shape;
  const activesurface::GridSamples* samples = this->Internal->Samples.get();
  return samples && samples->FindShape(level, shape) ? activesurface::FindSurfacePoints(shape)
                                                     : activesurface::SurfacePoints();
}

void vtkGridPotential::EvaluateBatch(
  vtkIdType count, const double* points, double* values, double* gradients) const
{
  const activesurface::GridSamples* samples = this->Internal->Samples.get();
  for (vtkIdType i = 0; i < count; ++i)
  {
    double* gradient = gradients ? gradients + 3 * i : nullptr;
    if (samples)
    {
      values[i] = samples->Evaluate(points + 3 * i, gradient);
      continue;
    }
    values[i] = Outside;
    std::fill_n(gradient, gradient ? 3 : 0, 0.0);
  }
}

double vtkGridPotential::EvaluateFunction(double x[3])
{
  this->Build();
  double value;
  this->EvaluateBatch(1, x, &value, nullptr);
  return value;
}

void vtkGridPotential::EvaluateGradient(double x[3], double g[3])
{
  this->Build();
  double value;
  double gradient[3]; // x and g may be the same array
  this->EvaluateBatch(1, x, &value, gradient);
  std::copy_n(gradient, 3, g);
}

void vtkGridPotential::EvaluateFunction(vtkDataArray* input, vtkDataArray* output)
{
  if (!input || !output || input->GetNumberOfComponents() != 3)
  {
    vtkErrorMacro("EvaluateFunction needs an input array of 3 components, and an output array.");
    return;
  }
  this->Build();
  activesurface::EvaluateArray(*this, input, output);
}

void vtkGridPotential::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Input: " << this->GetInput() << "\n";
  os << indent << "InputConnection: " << this->GetInputConnection() << "\n";
  os << indent << "ScalarArrayName: " << this->ScalarArrayName << "\n";
  os << indent << "IsoValue: " << this->IsoValue << "\n";
  os << indent << "InvertInside: " << (this->InvertInside ? "On" : "Off") << "\n";
  os << indent << "VoxelSize: " << this->VoxelSize << "\n";
  os << indent << "Reach: " << this->Reach << "\n";
  os << indent << "MeshThickness: " << this->MeshThickness << "\n";
  os << indent << "MaximumNumberOfVoxels: " << this->MaximumNumberOfVoxels << "\n";
}
