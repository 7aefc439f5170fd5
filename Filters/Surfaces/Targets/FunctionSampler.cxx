#include "Targets/FunctionSampler.h"

#include "vtkGridPotential.h"
#include "vtkImplicitBoolean.h"
#include "vtkImplicitFunction.h"
#include "vtkImplicitFunctionCollection.h"
#include "vtkImplicitSum.h"
#include "vtkSkeletonPotential.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

namespace activesurface
{

namespace
{

// Returns true for objects of these classes, which evaluation does not change. Subclasses have
// other names, and are excluded.
bool OnlyReadsItself(vtkImplicitFunction* function)
{
  constexpr std::array<const char*, 10> known = { "vtkBox", "vtkCone", "vtkCylinder",
    "vtkGridPotential", "vtkPlane", "vtkPlanes", "vtkQuadric", "vtkSkeletonPotential", "vtkSphere",
    "vtkSuperquadric" };
  const char* name = function->GetClassName();
  return std::any_of(
    known.begin(), known.end(), [name](const char* other) { return !std::strcmp(name, other); });
}

// Returns true if VTK's gradient is correct.
bool HasGradient(vtkImplicitFunction* function)
{
  return !vtkImplicitBoolean::SafeDownCast(function) && // wrong for a union
    !vtkImplicitSum::SafeDownCast(function) &&          // may have a union as a term
    !function->IsA("vtkSuperquadric"); // always 0 in VTK; not all builds have the class
}

using Batch =
  std::function<void(vtkIdType count, const double* points, double* values, double* gradients)>;

// Returns EvaluateBatch for the function's current properties; empty for a function of another
// class.
template <class Potential>
Batch FindBatch(vtkImplicitFunction* function)
{
  Potential* potential = Potential::SafeDownCast(function);
  if (!potential)
  {
    return {};
  }
  potential->Build();
  return [potential](vtkIdType count, const double* points, double* values, double* gradients)
  { potential->EvaluateBatch(count, points, values, gradients); };
}

}

// A function and the functions that it is composed of.
struct FunctionSampler::Node
{
  Node(vtkImplicitFunction* function, double step);

  double ValueAt(const double x[3]) const;
  double SampleAt(const double x[3], double gradient[3]) const;

  bool ThreadSafe = false;
  Batch InBatches; // EvaluateBatch, if the function has it

private:
  double SampleBoolean(const double x[3], double gradient[3]) const;
  void FindDifferences(const double x[3], double gradient[3]) const;

  vtkSmartPointer<vtkImplicitFunction> Function;
  vtkImplicitBoolean* Boolean = nullptr;
  bool GradientTrusted = true;
  double Step;
  std::vector<Node> Terms;
};

FunctionSampler::Node::Node(vtkImplicitFunction* function, double step)
  : Function(function)
  , GradientTrusted(HasGradient(function))
  , Step(step)
{
  if (function->GetTransform())
  {
    return;
  }
  this->ThreadSafe = OnlyReadsItself(function);
  this->InBatches = FindBatch<vtkSkeletonPotential>(function);
  if (!this->InBatches)
  {
    this->InBatches = FindBatch<vtkGridPotential>(function);
  }
  if (std::strcmp(function->GetClassName(), "vtkImplicitBoolean") != 0)
  {
    return;
  }
  auto boolean = static_cast<vtkImplicitBoolean*>(function);
  this->ThreadSafe = true;
  vtkCollectionSimpleIterator at;
  boolean->GetFunction()->InitTraversal(at);
  while (vtkImplicitFunction* term = boolean->GetFunction()->GetNextImplicitFunction(at))
  {
    this->Terms.emplace_back(term, step);
    this->ThreadSafe = this->ThreadSafe && this->Terms.back().ThreadSafe;
  }
  this->Boolean = this->Terms.empty() ? nullptr : boolean;
}

double FunctionSampler::Node::ValueAt(const double x[3]) const
{
  if (this->InBatches)
  {
    double value;
    this->InBatches(1, x, &value, nullptr);
    return value;
  }
  return this->Function->FunctionValue(x);
}

double FunctionSampler::Node::SampleAt(const double x[3], double gradient[3]) const
{
  if (this->InBatches)
  {
    double value;
    this->InBatches(1, x, &value, gradient);
    return value;
  }
  if (this->Boolean)
  {
    return this->SampleBoolean(x, gradient);
  }
  if (this->GradientTrusted)
  {
    std::fill_n(gradient, 3, 0.0);
    this->Function->FunctionGradient(x, gradient);
  }
  else
  {
    this->FindDifferences(x, gradient);
  }
  return this->ValueAt(x);
}

// Returns the value of the vtkImplicitBoolean, and the gradient of the term that determines this
// value.
double FunctionSampler::Node::SampleBoolean(const double x[3], double gradient[3]) const
{
  const int operation = this->Boolean->GetOperationType();
  const Node* decides = nullptr;
  double least = 0.0;
  double sign = 1.0;
  for (const Node& term : this->Terms)
  {
    const double value = term.ValueAt(x);
    // The term with the lowest rank determines the result.
    double rank = value;
    if (operation == vtkImplicitBoolean::VTK_UNION_OF_MAGNITUDES)
    {
      rank = std::fabs(value);
    }
    else if (operation == vtkImplicitBoolean::VTK_INTERSECTION ||
      (operation == vtkImplicitBoolean::VTK_DIFFERENCE && &term == &this->Terms.front()))
    {
      rank = -value;
    }
    if (!decides || rank < least || std::isnan(rank))
    {
      decides = &term;
      least = rank;
      sign = operation == vtkImplicitBoolean::VTK_DIFFERENCE ||
          operation == vtkImplicitBoolean::VTK_INTERSECTION
        ? -1.0
        : 1.0;
    }
  }
  decides->SampleAt(x, gradient); // users need only its length, so the sign is not corrected
  return sign * least;
}

void FunctionSampler::Node::FindDifferences(const double x[3], double gradient[3]) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    double low[3] = { x[0], x[1], x[2] };
    double high[3] = { x[0], x[1], x[2] };
    low[axis] -= this->Step;
    high[axis] += this->Step;
    gradient[axis] = (this->ValueAt(high) - this->ValueAt(low)) / (high[axis] - low[axis]);
  }
}

FunctionSampler::FunctionSampler(
  vtkImplicitFunction* function, double step, const std::array<double, 3>& origin)
  : Root(std::make_unique<Node>(function, step))
  , Origin(origin)
{
}

FunctionSampler::~FunctionSampler() = default;

bool FunctionSampler::IsThreadSafe() const
{
  return this->Root->ThreadSafe;
}

void FunctionSampler::Sample(
  std::size_t count, const double* points, double* values, double* gradients) const
{
  if (this->Origin == std::array<double, 3>{})
  {
    this->SampleWorld(count, points, values, gradients);
    return;
  }
  std::vector<double> world(points, points + 3 * count);
  for (std::size_t i = 0; i < world.size(); ++i)
  {
    world[i] += this->Origin[i % 3];
  }
  this->SampleWorld(count, world.data(), values, gradients);
}

void FunctionSampler::SampleWorld(
  std::size_t count, const double* points, double* values, double* gradients) const
{
  if (this->Root->InBatches)
  {
    this->Root->InBatches(static_cast<vtkIdType>(count), points, values, gradients);
    return;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const double* x = points + 3 * i;
    values[i] = gradients ? this->Root->SampleAt(x, gradients + 3 * i) : this->Root->ValueAt(x);
  }
}

}
