#include "Support/FitsOfDoubles.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

double Step(double low, double high, double x)
{
  const double t = std::min(std::max((x - low) / (high - low), 0.0), 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double Weigh(const Point& a, const Point& b, double radius)
{
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    square += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  }
  const double rest = std::max(1.0 - square / radius / radius, 0.0);
  return rest * rest;
}

}

FitsOfDoubles::FitsOfDoubles(
  const std::vector<Point>& particles, double own, double reach, double loss)
  : Particles(particles)
  , Own(own)
  , Reach(reach)
  , Wide(7.25 / 4.5 * reach)
  , Loss(loss)
{
  std::vector<Fit> fits(particles.size());
  for (std::size_t i = 0; i < fits.size(); ++i)
  {
    this->FindShape(particles[i], fits[i]);
  }
  this->Fits = fits; // of strength 1
  for (Fit& fit : fits)
  {
    if (fit.Deep + fit.Thin > 0.0)
    {
      const double value = (fit.Deep * this->SumAt(fit.Away) + fit.Thin * this->SumAt(fit.Across)) /
        (fit.Deep + fit.Thin);
      fit.Share = 1.0 - (1.0 - fit.Deep) * (1.0 - fit.Thin);
      fit.Lack = value - fit.Lone;
    }
  }
  for (std::size_t i = 0; i < fits.size(); ++i)
  {
    double shares = 0.0, lacks = 0.0;
    for (std::size_t k = 0; k < fits.size(); ++k)
    {
      const double share = Weigh(particles[i], particles[k], this->Wide) * fits[k].Share;
      shares += share;
      lacks += share * fits[k].Lack;
    }
    const Fit& fit = fits[i];
    const double mean = shares > 0.0 ? lacks / shares : 0.0;
    const double value = fit.Lone + fit.Shape * mean * std::min(shares, 1.0) +
      (1.0 - fit.Shape) * fit.Share * fit.Lack;
    this->Fits[i].Strength = 1.0 / std::max(value, 0.1 * fit.Lone);
  }
}

void FitsOfDoubles::FindShape(const Point& x, Fit& fit) const
{
  double weight = 0.0, near = 0.0, first[3] = {}, second[3][3] = {};
  for (const Point& other : this->Particles)
  {
    const double w = Weigh(x, other, this->Wide);
    weight += w;
    near += Weigh(x, other, 0.55 * this->Wide);
    for (int i = 0; i < 3; ++i)
    {
      first[i] += w * (other[i] - x[i]);
      for (int k = 0; k < 3; ++k)
      {
        second[i][k] += w * (other[i] - x[i]) * (other[k] - x[k]);
      }
    }
  }
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      second[i][k] = second[i][k] / weight - first[i] * first[k] / weight / weight;
    }
  }
  double *matrix[3] = { second[0], second[1], second[2] }, squares[3], frame[3][3];
  double* vectors[3] = { frame[0], frame[1], frame[2] };
  vtkMath::Jacobi(matrix, squares, vectors);
  double axes[3];
  std::transform(squares, squares + 3, axes, [](double s) { return std::sqrt(std::max(s, 0.0)); });
  const double cells = this->Wide / (2.0 * this->Own);
  const double density = (weight - 1.0) / (32.0 * vtkMath::Pi() / 105.0 * cells * cells * cells);
  const double depth = std::hypot(first[0], first[1], first[2]) / weight;
  const double bulk = Step(0.3, 0.8, density);
  fit.Shape = axes[0] > 0.0 ? Step(2.2, 4.2, near) : 0.0;
  fit.Deep = Step(0.1, 0.22, depth / this->Wide);
  const double middle = std::max(axes[1], 0.25 * axes[0]);
  fit.Thin = std::max(1.0 - Step(0.05, 0.12, axes[0] / this->Wide),
    1.0 - Step(0.25, 0.6, middle > 0.0 ? axes[2] / middle : 0.0));
  const double far = this->Reach * (0.7 + 0.3 * Step(0.05, 0.2, density));
  const double ball = this->Own + this->Loss * (1.0 - fit.Shape);
  fit.Lone = std::pow(1.0 - ball * ball / far / far, 3.0);
  const double offset = ball + 0.1 * this->Own * bulk;
  double inward = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    inward += frame[i][2] * first[i];
  }
  for (int i = 0; i < 3; ++i)
  {
    const double mean = first[i] / weight;
    fit.Centre[i] = x[i] + 0.9 * fit.Shape * mean;
    fit.Away[i] = x[i] - (depth > 0.0 ? offset * mean / depth : 0.0);
    fit.Across[i] = x[i] + offset * (inward > 0.0 ? -frame[i][2] : frame[i][2]);
  }
  FindMetric(axes, frame, fit.Shape, far, fit.Metric);
}

void FitsOfDoubles::FindMetric(const double (&axes)[3], const double (&frame)[3][3], double shape,
  double reach, double (&metric)[3][3])
{
  constexpr double anisotropy = 4.0;
  double length[3] = { 1.0, 1.0, 1.0 }, volume = 1.0;
  for (int e = 0; e < 3 && shape > 0.0; ++e)
  {
    length[e] = std::max(axes[e], axes[0] / anisotropy);
    volume *= length[e];
  }
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      metric[i][k] = i == k ? (1.0 - shape) / reach / reach : 0.0;
      for (int e = 0; e < 3; ++e)
      {
        const double own = length[e] / std::cbrt(volume) * reach;
        metric[i][k] += shape * frame[i][e] * frame[k][e] / own / own;
      }
    }
  }
}

double FitsOfDoubles::SumAt(const Point& x) const
{
  double sum = 0.0;
  for (const Fit& fit : this->Fits)
  {
    double square = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        square += (x[i] - fit.Centre[i]) * fit.Metric[i][k] * (x[k] - fit.Centre[k]);
      }
    }
    const double rest = std::max(1.0 - square, 0.0);
    sum += fit.Strength * rest * rest * rest;
  }
  return sum;
}

}
