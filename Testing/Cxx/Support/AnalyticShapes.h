/**
 * Shapes with a formula, as starts and as targets of the exact tests. All values are negative
 * inside.
 */
#ifndef AnalyticShapes_h
#define AnalyticShapes_h

#include "Support/Point.h"
#include "Support/UnitBox.h"

#include "Base/Target.h"
#include "NarrowBand.h"

#include <functional>
#include <vector>

namespace activesurface
{
struct Shape
{
  std::function<double(const Point&)> Value;
  /** Norm of the gradient of Value; empty if Value is a distance. */
  std::function<double(const Point&)> Slope;
};

struct Ball
{
  Point Centre;
  double Radius;
};

/** Distance to the nearest of several balls. */
Shape MakeBalls(const std::vector<Ball>& balls);
Shape MakeBall(const Point& centre, double radius);

/** Torus around an axis parallel to z. */
Shape MakeTorus(const Point& centre, double ringRadius, double tubeRadius);

/** Threshold - sum of (1 - r^2/radius^2)^3: not a distance, and constant far away. */
Shape MakeMetaballs(const std::vector<Point>& centres, double radius, double threshold);

/** Six metaballs, two near each axis, that overlap and form one body. */
Shape MakeSixMetaballs();

/** Two balls joined by a capsule. */
struct Dumbbell
{
  Point Centre;
  Point Direction; //< unit length
  double HalfLength;
  double BallRadius;
  double NeckRadius;
};
Shape MakeDumbbell(const Dumbbell& dumbbell);

/** A ball at the origin with a concentric void. */
Shape MakeShell(double outerRadius, double innerRadius);
Shape MakeBallInShell(double outerRadius, double innerRadius, double ballRadius);

/** (|x - c|^2 - r^2) / 2 r: a sphere whose slope is 1 only at the surface. */
Shape MakeAlgebraicBall(const Point& centre, double radius);

/** Ellipsoid at the origin. Its value is not a distance: the slope is 1 or less, depending on the
 * direction. */
Shape MakeEllipsoid(const Point& semiAxes);

/** Disk around the z axis; `height` is the z coordinate of its middle plane. */
Shape MakeSlab(double height, double thickness, double radius);

/** Constant value: as a target, it moves the surface with a uniform speed. */
Shape MakeConstant(double value);

/** Value / slope, clamped to +-reach: first-order distance to a shape whose value is no
 * distance. */
Shape Normalise(const Shape& shape, double reach);

/** Scales a shape about the origin. */
Shape Scale(const Shape& shape, double factor);

/** Translates a shape by a vector. */
Shape Move(const Shape& shape, const Point& to);

/** Gradient by central differences of step 1e-5, for shapes of size about 1. */
Point GetGradient(const Shape& shape, const Point& point);

InitialFunction MakeInitialFunction(const Shape& shape);

/** A static shape, or one that follows a trajectory. */
class ShapeTarget : public Target
{
public:
  using Trajectory = std::function<Shape(double)>;

  explicit ShapeTarget(const Shape& shape);
  explicit ShapeTarget(const Trajectory& trajectory);

  void MoveTo(double time) override;
  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override;

private:
  Shape Current;
  Trajectory Path;
};

/**
 * Starts the surface on a shape within Box, at time 0. The limit of active voxels is far above the
 * need of a smooth surface, so that a surface full of noise throws instead of exhausting the
 * memory.
 */
void StartOn(NarrowBand& band, const Shape& shape);

/** Arbitrary centres, so that shapes are not symmetric with respect to the lattice. */
constexpr Point CentreA = { 0.013, 0.007, -0.021 };
constexpr Point CentreB = { -0.027, 0.041, 0.009 };
}

#endif
