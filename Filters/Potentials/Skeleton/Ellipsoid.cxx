#include "Skeleton/Ellipsoid.h"

#include "PortableMath.h"
#include "Skeleton/SmoothStep.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{
namespace
{

// Fraction by which a centre moves to the mean of its neighbours. Larger values are smoother; 1
// would let clusters collapse.
constexpr double ShareOfMean = 0.9;

// Sum of the near neighbours' weights, including the particle's own (1), above which there is a
// shape. Two neighbours make 2.1, a sheet of one layer 4.2, a body's surface 5.8. Far neighbours
// are ignored: they would draw a drop's centre out of the drop.
constexpr double FewestNeighbours = 2.2;
constexpr double EnoughNeighbours = 4.2;

// Ratio of the shortest half-axis to the middle one: 0 for a sheet of one layer, about 1 for a
// body.
constexpr double ThinRatio = 0.25;
constexpr double ThickRatio = 0.6;

// Ratio of the longest half-axis to the support radius: 0 for coincident particles, 0.15 for a pair
// of neighbours, 0.33 for a body.
constexpr double TinySize = 0.05;
constexpr double SmallSize = 0.12;

constexpr int Places[3][3] = { { 0, 1, 2 }, { 1, 3, 4 }, { 2, 4, 5 } };

// Half-axes in the proportions of the shape, scaled to the volume of a ball of radius 1, largest
// first.
void FindAxes(const NeighbourhoodShape& shape, double anisotropy, double axes[3])
{
  double volume = 1.0;
  for (int i = 0; i < 3; ++i)
  {
    axes[i] = std::max(shape.Axes[i], shape.Axes[0] / anisotropy);
    volume *= axes[i];
  }
  const double root = CubeRoot(volume);
  for (int i = 0; i < 3; ++i)
  {
    axes[i] /= root;
  }
}
}

NeighbourhoodShape::NeighbourhoodShape(const NeighbourMoments& sums)
{
  if (!(sums.Weight > 0.0))
  {
    return;
  }
  for (int i = 0; i < 3; ++i)
  {
    this->Mean[i] = sums.First[i] / sums.Weight;
  }
  double rows[3][3];
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      rows[i][k] = sums.Second[Places[i][k]] / sums.Weight - this->Mean[i] * this->Mean[k];
    }
  }
  double* matrix[3] = { rows[0], rows[1], rows[2] };
  double* frame[3] = { this->Frame[0], this->Frame[1], this->Frame[2] };
  double squares[3];
  vtkMath::Jacobi(matrix, squares, frame);
  for (int i = 0; i < 3; ++i)
  {
    this->Axes[i] = std::sqrt(std::max(squares[i], 0.0));
  }
}

double NeighbourhoodShape::GetThinness(double reach) const
{
  const double size = this->Axes[0] / reach;
  const double small = SmoothStep(SmallSize, TinySize, size);
  // Both shorter axes of a thread are close to 0.
  const double middle = std::max(this->Axes[1], ThinRatio * this->Axes[0]);
  const double ratio = middle > 0.0 ? this->Axes[2] / middle : 0.0;
  return std::max(small, SmoothStep(ThickRatio, ThinRatio, ratio));
}

double GetShapeShare(double near)
{
  return SmoothStep(FewestNeighbours, EnoughNeighbours, near);
}

void FitEllipsoid(
  const NeighbourhoodShape& shape, const EllipsoidOptions& options, ParticleFit& fit)
{
  const double share = shape.Axes[0] > 0.0 ? options.ShapeShare : 0.0;
  double axes[3] = { 1.0, 1.0, 1.0 };
  if (share > 0.0)
  {
    FindAxes(shape, options.Anisotropy, axes);
  }
  const double round = 1.0 / (options.Reach * options.Reach);
  std::fill_n(fit.Metric, 6, 0.0);
  for (int i = 0; i < 3; ++i)
  {
    fit.Offset[i] = ShareOfMean * share * shape.Mean[i];
    fit.Metric[Places[i][i]] += (1.0 - share) * round;
    for (int k = i; k < 3; ++k)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        fit.Metric[Places[i][k]] +=
          share * round * shape.Frame[i][axis] * shape.Frame[k][axis] / (axes[axis] * axes[axis]);
      }
    }
  }
  fit.Reach = options.Reach * std::max(axes[0], 1.0);
}

}
