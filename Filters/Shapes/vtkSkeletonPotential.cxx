#include "vtkSkeletonPotential.h"

#include "Base/ErrorText.h"
#include "Frames/ParticleData.h"
#include "Index/Skeleton.h"
#include "Input/BatchEvaluation.h"
#include "Input/FunctionInput.h"
#include "Input/SkeletonInput.h"
#include "ParticlePotential.h"

#include "vtkDataArray.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkSkeletonPotential);

struct vtkSkeletonPotential::Internals
{
  activesurface::FunctionInput Input;

  // Elements of SetElements, in place of an input.
  std::vector<activesurface::SkeletonVertex> OwnElements;
  bool HasOwnElements = false;
  bool OwnElementsHaveRadii = false;

  // Results of Build.
  activesurface::Skeleton Skeleton;
  activesurface::ParticlePotential Body; // in place of Skeleton, unless ParticleModel is SUM
  vtkIdType IgnoredElements = 0;
  double Level = 0.5; // with SUM, F far from all elements: Threshold, or 1/2 after an error
};

vtkSkeletonPotential::vtkSkeletonPotential()
  : Internal(new Internals)
{
}

vtkSkeletonPotential::~vtkSkeletonPotential() = default;

void vtkSkeletonPotential::SetInput(vtkPointSet* input)
{
  Internals& own = *this->Internal;
  if (own.Input.SetData(input) || own.HasOwnElements)
  {
    own.HasOwnElements = false;
    this->Modified();
  }
}

void vtkSkeletonPotential::SetInputConnection(vtkAlgorithmOutput* output)
{
  Internals& own = *this->Internal;
  if (own.Input.Connect(output) || own.HasOwnElements)
  {
    own.HasOwnElements = false;
    this->Modified();
  }
}

vtkAlgorithmOutput* vtkSkeletonPotential::GetInputConnection()
{
  return this->Internal->Input.GetConnection();
}

vtkPointSet* vtkSkeletonPotential::GetInput()
{
  return vtkPointSet::SafeDownCast(this->Internal->Input.GetData());
}

void vtkSkeletonPotential::SetElements(
  vtkIdType count, const double* positions, const double* radii, const double* strengths)
{
  Internals& own = *this->Internal;
  own.Input.SetData(nullptr);
  own.HasOwnElements = true;
  own.OwnElementsHaveRadii = radii != nullptr;
  own.OwnElements.resize(static_cast<std::size_t>(std::max<vtkIdType>(count, 0)));
  for (std::size_t i = 0; i < own.OwnElements.size(); ++i)
  {
    activesurface::SkeletonVertex& vertex = own.OwnElements[i];
    std::copy(positions + 3 * i, positions + 3 * i + 3, vertex.Position);
    vertex.Radius = radii ? radii[i] : 0.0;
    vertex.Strength = strengths ? strengths[i] : 1.0;
  }
  this->Modified();
}

void vtkSkeletonPotential::SetRadiusArrayName(const char* name)
{
  this->SetName(this->RadiusArrayName, name);
}

void vtkSkeletonPotential::SetStrengthArrayName(const char* name)
{
  this->SetName(this->StrengthArrayName, name);
}

void vtkSkeletonPotential::SetName(std::string& member, const char* name)
{
  const std::string wanted = name ? name : "";
  if (member != wanted)
  {
    member = wanted;
    this->Modified();
  }
}

vtkMTimeType vtkSkeletonPotential::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->Internal->Input.FindMTime());
}

void vtkSkeletonPotential::Build()
{
  // GetMTime() would include changes of the transform, which do not affect the elements.
  const vtkMTimeType changed = this->vtkObject::GetMTime(); // NOLINT(bugprone-parent-virtual-call)
  this->Internal->Input.ReadIfChanged(changed, [this] { this->ReadElements(); });
}

void vtkSkeletonPotential::ReadElements()
{
  Internals& own = *this->Internal;
  own.IgnoredElements = 0;
  own.Skeleton.Clear();
  own.Level = this->Threshold;
  try
  {
    if (!std::isfinite(this->Threshold) || this->Threshold <= 0.0)
    {
      throw std::invalid_argument(
        "Threshold has to be a finite number > 0, so that the function is positive away from all "
        "elements.");
    }
    own.Input.Update();
    const vtkSmartPointer<vtkDataSet> data = activesurface::AsDataSet(own.Input.GetData());
    vtkPointSet* points = vtkPointSet::SafeDownCast(data);
    if (own.Input.GetData() && !points)
    {
      throw std::invalid_argument(std::string("A ") + own.Input.GetData()->GetClassName() +
        " is no skeleton; connect points or lines: a vtkPointSet, a vtkTable or blocks of these.");
    }
    if (own.HasOwnElements)
    {
      own.IgnoredElements = this->AddOwnElements();
    }
    else
    {
      own.IgnoredElements = static_cast<vtkIdType>(activesurface::AddElements(
        points, { this->RadiusArrayName, this->StrengthArrayName, this->Radius }, own.Skeleton));
    }
    own.Skeleton.Build();
    this->FitBody();
  }
  catch (const std::exception& error)
  {
    own.Skeleton.Clear();
    own.Skeleton.Build();
    own.Body.Build({}, {});
    own.Level = 0.5;
    vtkErrorMacro(<< activesurface::TextOf(error)
                  << " The function is 1/2 everywhere: all space is outside.");
  }
  if (own.IgnoredElements > 0 && !own.HasOwnElements)
  {
    const bool isOne = own.IgnoredElements == 1;
    vtkWarningMacro(<< own.IgnoredElements
                    << (isOne ? " point or segment is" : " points or segments are")
                    << " ignored: a coordinate, a radius or a strength "
                       "is not finite, a radius is not positive, a number is too large or too "
                       "small, or a cell has a point that does not exist. Correct or remove these "
                       "elements.");
  }
}

void vtkSkeletonPotential::FitBody()
{
  Internals& own = *this->Internal;
  if (this->ParticleModel == SUM)
  {
    return;
  }
  if (own.Skeleton.HasSegments())
  {
    throw std::invalid_argument("Lines need ParticleModel SUM, but another model is set; set "
                                "ParticleModel to SUM, or remove the lines.");
  }
  constexpr double automatic = -1.0;
  constexpr double shortest = 1e-100, longest = 1e100;
  const bool isLength = this->ParticleSpacing >= shortest && this->ParticleSpacing <= longest;
  if (this->ParticleSpacing != automatic && !isLength)
  {
    std::ostringstream text;
    text << "ParticleSpacing is " << this->ParticleSpacing << ", but has to be between " << shortest
         << " and " << longest << ", or -1, automatic.";
    throw std::invalid_argument(text.str());
  }
  activesurface::NodeParticleOptions options;
  options.OwnRadius = isLength ? 0.5 * this->ParticleSpacing : 0.0;
  options.ReachPerRadius = 2.0 * GetReachPerSpacing(options.Model);
  options.Anisotropy = this->Anisotropy;
  own.Body.Build(own.Skeleton.ListPoints(), options);
}

vtkIdType vtkSkeletonPotential::AddOwnElements()
{
  Internals& own = *this->Internal;
  vtkIdType ignored = 0;
  for (activesurface::SkeletonVertex vertex : own.OwnElements)
  {
    vertex.Radius = own.OwnElementsHaveRadii ? vertex.Radius : this->Radius;
    if (vertex.IsUsable())
    {
      own.Skeleton.AddPoint(vertex);
    }
    else
    {
      ++ignored;
    }
  }
  return ignored;
}

bool vtkSkeletonPotential::GetSkeletonBounds(double bounds[6])
{
  this->Build();
  const Internals& own = *this->Internal;
  double found[6];
  const bool isSum = this->ParticleModel == SUM;
  if (isSum ? own.Skeleton.GetNumberOfElements() == 0 : !own.Body.FindBounds(found))
  {
    vtkMath::UninitializeBounds(bounds);
    return false;
  }
  std::copy_n(isSum ? own.Skeleton.GetBounds() : found, 6, bounds);
  return true;
}

vtkIdType vtkSkeletonPotential::GetNumberOfIgnoredElements()
{
  this->Build();
  return this->Internal->IgnoredElements;
}

void vtkSkeletonPotential::EvaluateBatch(
  vtkIdType count, const double* points, double* values, double* gradients) const
{
  const Internals& own = *this->Internal;
  const auto size = static_cast<std::size_t>(std::max<vtkIdType>(count, 0));
  if (this->ParticleModel == SUM)
  {
    own.Skeleton.Evaluate(static_cast<activesurface::SkeletonKernel>(this->Kernel), own.Level, size,
      points, values, gradients);
  }
  else
  {
    own.Body.Evaluate(size, points, values, gradients);
  }
}

double vtkSkeletonPotential::EvaluateFunction(double x[3])
{
  this->Build();
  double value;
  this->EvaluateBatch(1, x, &value, nullptr);
  return value;
}

void vtkSkeletonPotential::EvaluateGradient(double x[3], double g[3])
{
  this->Build();
  double value;
  double gradient[3]; // x and g may be the same array
  this->EvaluateBatch(1, x, &value, gradient);
  std::copy_n(gradient, 3, g);
}

void vtkSkeletonPotential::EvaluateFunction(vtkDataArray* input, vtkDataArray* output)
{
  if (!input || !output || input->GetNumberOfComponents() != 3)
  {
    vtkErrorMacro("EvaluateFunction needs an input array of 3 components, and an output array.");
    return;
  }
  this->Build();
  activesurface::EvaluateArray(*this, input, output);
}

void vtkSkeletonPotential::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* kernels[] = { "Wyvill", "CubicSpline", "Metaball" };
  os << indent << "Input: " << this->GetInput() << "\n";
  os << indent << "InputConnection: " << this->GetInputConnection() << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "RadiusArrayName: " << this->RadiusArrayName << "\n";
  os << indent << "StrengthArrayName: " << this->StrengthArrayName << "\n";
  os << indent << "Kernel: " << kernels[this->Kernel] << "\n";
  os << indent << "Threshold: " << this->Threshold << "\n";
  const char* models[] = { "Sum", "Anisotropic" };
  os << indent << "ParticleModel: " << models[this->ParticleModel] << "\n";
  os << indent << "ParticleSpacing: " << this->ParticleSpacing << "\n";
  os << indent << "Anisotropy: " << this->Anisotropy << "\n";
}
