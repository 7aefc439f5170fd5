// Fits of particles of strength 1 and one radius, by all pairs and in double precision: the
// reference for Nodes/NodeFits.h, which has the formulas' sources.
#ifndef FitsOfDoubles_h
#define FitsOfDoubles_h

#include "Support/Point.h"

#include <vector>

namespace activesurface
{

class FitsOfDoubles
{
public:
  // own: own radius of the particles; reach: largest support radius of their kernels; loss: added
  // to the own radius for the ball of an isolated particle.
  FitsOfDoubles(const std::vector<Point>& particles, double own, double reach, double loss);

  // Sum of strength * (1 - d^2)^3 over the ellipsoids, where d is 1 at the boundary of the
  // ellipsoid. The sum is 1 at the surface.
  double SumAt(const Point& x) const;

private:
  struct Fit
  {
    Point Centre;
    double Metric[3][3];
    double Strength = 1.0;
    double Shape, Deep, Thin, Lone;
    Point Away, Across; // where the surface should be
    double Share = 0.0, Lack = 0.0;
  };

  void FindShape(const Point& x, Fit& fit) const;
  static void FindMetric(const double (&axes)[3], const double (&frame)[3][3], double shape,
    double reach, double (&metric)[3][3]);

  std::vector<Point> Particles;
  std::vector<Fit> Fits;
  double Own, Reach, Wide, Loss;
};

}

#endif
