// Points and segments, and the sum of their contributions (see SkeletonKernel.h) at any point.
//
// Contributions are added by ascending index: points in order of insertion, then segments. A sum
// therefore does not depend, to the last bit, on the cells of the index, the batch or the thread.

#ifndef Skeleton_h
#define Skeleton_h

#include "Index/ElementIndex.h"
#include "Index/SkeletonKernel.h"
#include "vtkActiveParticlesModule.h"

namespace activesurface
{

struct VTKACTIVEPARTICLES_EXPORT SkeletonVertex
{
  double Position[3];
  double Radius;
  double Strength;

  // Returns true if no number is NaN or exceeds 1e100 in magnitude, and the radius is at least
  // 1e-100, so that squares and quotients are finite.
  bool IsUsable() const;
};

// Contribution of a point of the skeleton to the sum at a position.
struct SkeletonWeight
{
  std::uint32_t Point;
  double Weight;
};

// Returns the distance [support radii] at which the kernel equals `level` (between 0 and 1). With
// the threshold `level`, the surface of an isolated element of strength 1 has this radius.
VTKACTIVEPARTICLES_EXPORT double FindRadiusOfLevel(SkeletonKernel kernel, double level);

class VTKACTIVEPARTICLES_EXPORT Skeleton
{
public:
  // Removes all elements; keeps the capacity.
  void Clear();

  // Add all points before the first segment. Vertices have to be usable.
  void AddPoint(const SkeletonVertex& vertex);
  void AddSegment(const SkeletonVertex& start, const SkeletonVertex& end);

  // Call after the last element is added and before the first evaluation. Throws like
  // ElementIndex::Build.
  void Build() { this->Near.Build(); }

  // Evaluates threshold - sum at points (x y z each), and the gradients unless `gradients` is null.
  // Values and gradients are NaN at a point that is not finite. Thread-safe.
  void Evaluate(SkeletonKernel kernel, double threshold, std::size_t count, const double* points,
    double* values, double* gradients) const;

  // Finds the nonzero contributions of points (not segments) to the sum at x, in the order of the
  // points. Thread-safe.
  void FindWeights(
    SkeletonKernel kernel, const double x[3], std::vector<SkeletonWeight>& weights) const;

  std::size_t GetNumberOfElements() const { return this->Near.Size(); }
  bool HasSegments() const { return !this->Segments.empty(); }

  // Returns the points in order of insertion.
  std::vector<SkeletonVertex> ListPoints() const;

  // Bounding box of all supports: xmin xmax ymin ... Undefined without elements.
  const double* GetBounds() const { return this->Near.GetBounds(); }

private:
  using Index = ElementIndex::Index;

  template <class Kernel>
  struct Evaluation;
  template <class Kernel>
  void AddWeights(const double x[3], std::vector<SkeletonWeight>& weights) const;
  template <class Kernel, class Sums>
  ACTIVE_ALWAYS_INLINE void AddAll(const ElementIndex::Place& place, Sums& sums) const;
  template <class Kernel, class Sums>
  ACTIVE_ALWAYS_INLINE void AddHits(const Index* hits, std::size_t count, Sums& sums) const;

  std::vector<SkeletonPoint> Points;
  std::vector<SkeletonSegment> Segments;
  ElementIndex Near; // the points, then the segments
};

}

#endif
