// Which part of a surface belongs to sheets, rods and crumbs that are thinner than a length.
//
// At a point of the surface the body is thin if the function is positive, and rises on the way, on
// both sides of it, somewhere within that length along the normal: outside, and behind the other
// side of the body. That needs no distances, no resolution of the part and no oriented normals. On
// the way in, the function has to rise along the way to within 45 degrees: the other side faces the
// point. So the edges of a cube, or of any wedge of more than 45 degrees, are not thin: they are
// rounded off, but not lost.

#ifndef ThinParts_h
#define ThinParts_h

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace activesurface
{

class GridSamples;
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

// The share of the area, 0 to 1, of parts that are thinner than `thickness`; 0 without points.
double FindThinShare(const GridSamples& function, const SurfaceSample& surface, double thickness);

}

#endif
