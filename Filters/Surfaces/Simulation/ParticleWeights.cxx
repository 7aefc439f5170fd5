#include "Simulation/ParticleWeights.h"

#include "vtkPoints.h"

#include <cmath>

namespace activesurface
{

ParticleWeights::ParticleWeights(
  const std::vector<SkeletonVertex>& particles, SkeletonKernel kernel)
  : Kernel(kernel)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(particles.size()));
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), particles[i].Position);
    this->Elements.AddPoint(particles[i]);
  }
  this->Elements.Build();
  this->Cloud->SetPoints(points);
  this->Locator->SetDataSet(this->Cloud);
  this->Locator->BuildLocator();
}

void ParticleWeights::Find(const double x[3], std::vector<SkeletonWeight>& weights) const
{
  this->Elements.FindWeights(this->Kernel, x, weights);
  double sum = 0.0;
  for (SkeletonWeight& weight : weights)
  {
    weight.Weight = std::fabs(weight.Weight);
    sum += weight.Weight;
  }
  if (!(sum > 0.0))
  {
    const vtkIdType nearest =
      const_cast<vtkStaticPointLocator*>(this->Locator.Get())->FindClosestPoint(x);
    weights.assign(1, { static_cast<std::uint32_t>(nearest), 1.0 });
    return;
  }
  for (SkeletonWeight& weight : weights)
  {
    weight.Weight /= sum;
  }
}

}
