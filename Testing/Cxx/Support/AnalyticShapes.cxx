#include "Support/AnalyticShapes.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{
namespace
{
Point Minus(const Point& a, const Point& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

double Length(const Point& a)
{
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

double Distance(const Point& a, const Point& b)
{
  return Length(Minus(a, b));
}

double SlopeAt(const Shape& shape, const Point& point)
{
  return shape.Slope ? shape.Slope(point) : 1.0;
}

}

Shape MakeBalls(const std::vector<Ball>& balls)
{
  return { [balls](const Point& point)
    {
      double nearest = 1e30;
      for (const Ball& ball : balls)
      {
        nearest = std::min(nearest, Distance(point, ball.Centre) - ball.Radius);
      }
      return nearest;
    },
    {} };
}

Shape MakeBall(const Point& centre, double radius)
{
  return { [centre, radius](const Point& point) { return Distance(point, centre) - radius; }, {} };
}

Shape MakeTorus(const Point& centre, double ringRadius, double tubeRadius)
{
  return { [centre, ringRadius, tubeRadius](const Point& point)
    {
      const Point d = Minus(point, centre);
      return std::hypot(std::hypot(d[0], d[1]) - ringRadius, d[2]) - tubeRadius;
    },
    {} };
}

Shape MakeMetaballs(const std::vector<Point>& centres, double radius, double threshold)
{
  const double square = radius * radius;
  const auto value = [centres, square, threshold](const Point& point)
  {
    double sum = 0.0;
    for (const Point& centre : centres)
    {
      const double distance = Distance(point, centre);
      sum += std::pow(std::max(0.0, 1.0 - distance * distance / square), 3);
    }
    return threshold - sum;
  };
  const auto slope = [centres, square](const Point& point)
  {
    Point gradient = { 0.0, 0.0, 0.0 };
    for (const Point& centre : centres)
    {
      const Point d = Minus(point, centre);
      const double t = std::max(0.0, 1.0 - Length(d) * Length(d) / square);
      for (int axis = 0; axis < 3; ++axis)
      {
        gradient[axis] += 6.0 * t * t * d[axis] / square;
      }
    }
    return Length(gradient);
  };
  return { value, slope };
}

Shape MakeSixMetaballs()
{
  std::vector<Point> centres;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double offset : { -0.35, 0.35 })
    {
      Point centre = { 0.01, 0.02, -0.013 };
      centre[axis] += offset;
      centres.push_back(centre);
    }
  }
  return MakeMetaballs(centres, 0.45, 0.2);
}

Shape MakeDumbbell(const Dumbbell& dumbbell)
{
  return { [dumbbell](const Point& point)
    {
      const Point d = Minus(point, dumbbell.Centre);
      const Point& u = dumbbell.Direction;
      const double along = d[0] * u[0] + d[1] * u[1] + d[2] * u[2];
      const double across = std::sqrt(std::max(0.0, Length(d) * Length(d) - along * along));
      const double end = dumbbell.HalfLength;
      const double beyond = along - std::clamp(along, -end, end);
      const double toBall = std::hypot(across, std::abs(along) - end) - dumbbell.BallRadius;
      return std::min(toBall, std::hypot(across, beyond) - dumbbell.NeckRadius);
    },
    {} };
}

Shape MakeShell(double outerRadius, double innerRadius)
{
  return { [outerRadius, innerRadius](const Point& point)
    { return std::max(Length(point) - outerRadius, innerRadius - Length(point)); },
    {} };
}

Shape MakeBallInShell(double outerRadius, double innerRadius, double ballRadius)
{
  const Shape shell = MakeShell(outerRadius, innerRadius);
  return { [shell, ballRadius](const Point& point)
    { return std::min(shell.Value(point), Length(point) - ballRadius); },
    {} };
}

Shape MakeAlgebraicBall(const Point& centre, double radius)
{
  const auto value = [centre, radius](const Point& point)
  {
    const double distance = Distance(point, centre);
    return (distance * distance - radius * radius) / (2.0 * radius);
  };
  const auto slope = [centre, radius](const Point& point)
  { return Distance(point, centre) / radius; };
  return { value, slope };
}

Shape MakeEllipsoid(const Point& semiAxes)
{
  const double shortest = *std::min_element(semiAxes.begin(), semiAxes.end());
  const auto scaled = [semiAxes](const Point& point, int power)
  {
    Point result = point;
    for (int axis = 0; axis < 3; ++axis)
    {
      result[axis] /= std::pow(semiAxes[axis], power);
    }
    return Length(result);
  };
  const auto value = [scaled, shortest](const Point& point)
  { return shortest * (scaled(point, 1) - 1.0); };
  const auto slope = [scaled, shortest](const Point& point)
  { return shortest * scaled(point, 2) / std::max(scaled(point, 1), 1e-30); };
  return { value, slope };
}

Shape MakeSlab(double height, double thickness, double radius)
{
  return { [height, thickness, radius](const Point& point)
    {
      return std::max(
        std::abs(point[2] - height) - 0.5 * thickness, std::hypot(point[0], point[1]) - radius);
    },
    {} };
}

Shape MakeConstant(double value)
{
  return { [value](const Point&) { return value; }, [](const Point&) { return 0.0; } };
}

Shape Normalise(const Shape& shape, double reach)
{
  return { [shape, reach](const Point& point)
    {
      const double slope = std::max(SlopeAt(shape, point), 1e-30);
      return std::clamp(shape.Value(point) / slope, -reach, reach);
    },
    [shape, reach](const Point& point)
    {
      const double slope = std::max(SlopeAt(shape, point), 1e-30);
      return std::fabs(shape.Value(point)) / slope < reach ? 1.0 : 0.0;
    } };
}

Shape Scale(const Shape& shape, double factor)
{
  const auto shrunk = [factor](const Point& point) {
    return Point{ point[0] / factor, point[1] / factor, point[2] / factor };
  };
  return { [shape, factor, shrunk](const Point& point)
    { return factor * shape.Value(shrunk(point)); },
    [shape, shrunk](const Point& point) { return SlopeAt(shape, shrunk(point)); } };
}

Shape Move(const Shape& shape, const Point& to)
{
  return { [shape, to](const Point& point) { return shape.Value(Minus(point, to)); },
    [shape, to](const Point& point) { return SlopeAt(shape, Minus(point, to)); } };
}

Point GetGradient(const Shape& shape, const Point& point)
{
  constexpr double step = 1e-5;
  Point gradient;
  for (int axis = 0; axis < 3; ++axis)
  {
    Point before = point;
    Point after = point;
    before[axis] -= step;
    after[axis] += step;
    gradient[axis] = (shape.Value(after) - shape.Value(before)) / (2.0 * step);
  }
  return gradient;
}

InitialFunction MakeInitialFunction(const Shape& shape)
{
  InitialFunction function;
  function.Evaluate = [shape](std::size_t count, const double* points, double* values)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      values[i] = shape.Value({ points[3 * i], points[3 * i + 1], points[3 * i + 2] });
    }
  };
  return function;
}

ShapeTarget::ShapeTarget(const Shape& shape)
  : Current(shape)
{
}

ShapeTarget::ShapeTarget(const Trajectory& trajectory)
  : Current(trajectory(0.0))
  , Path(trajectory)
{
}

void ShapeTarget::MoveTo(double time)
{
  if (this->Path)
  {
    this->Current = this->Path(time);
  }
}

void ShapeTarget::Evaluate(
  std::size_t count, const double* points, const TargetResults& results) const
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const Point point = { points[3 * i], points[3 * i + 1], points[3 * i + 2] };
    results.Values[i] = this->Current.Value(point);
    results.Slopes[i] = SlopeAt(this->Current, point);
  }
}

void StartOn(NarrowBand& band, const Shape& shape)
{
  const double nodesAlongSide = 2.0 / band.GetVoxelSize();
  band.SetMaximumNumberOfActiveVoxels(
    static_cast<std::size_t>(100.0 * nodesAlongSide * nodesAlongSide));
  band.Start(0.0, Box, MakeInitialFunction(shape));
}
}
