// A surface by points that stand for its area.

#ifndef SurfaceSample_h
#define SurfaceSample_h

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace activesurface
{

struct MeshTriangles;

struct SurfacePoint
{
  std::array<double, 3> Place;
  std::array<double, 3> Normal; // of length 1, to either side
  double Area;                  // that it stands for
};

// A surface by points that stand for it. A share s that they tell is off by sqrt(s (1 - s) / n) of
// n points, as if they were at random: by .6 % at the most of 8192, by .08 % at s = .5 %.
struct SurfaceSample
{
  static constexpr std::size_t Most = 8192;

  std::vector<SurfacePoint> Points;
  double Detail = std::numeric_limits<double>::infinity(); // the function is even within [length]
  bool IsMiddle = false; // of a shell: the points are half of its thickness below its surface
};

// Points evenly over the area of a mesh.
SurfaceSample SampleSurface(const MeshTriangles& mesh);

// Gathers points of which nobody knows how many there will be: all, or each second, or fourth ...
class SurfaceGatherer
{
public:
  // Whether the next point is one of those. For each point, and then Add if it is.
  bool WantsNext() { return this->Offered++ % this->Stride == 0; }
  void Add(const SurfacePoint& point);

  std::vector<SurfacePoint> Points;

private:
  std::size_t Offered = 0;
  std::size_t Stride = 1;
};

}

#endif
