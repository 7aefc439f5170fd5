// Reads the elements of a skeleton from a VTK data set. vtkSkeletonPotential.h describes the
// elements and the treatment of joints.

#ifndef SkeletonInput_h
#define SkeletonInput_h

#include <cstddef>
#include <string>

class vtkPointSet;

namespace activesurface
{

class Skeleton;

struct SkeletonArrays
{
  std::string RadiusName;   // empty: Radius for all
  std::string StrengthName; // empty: 1 for all
  double Radius;
};

// Adds the elements to a cleared skeleton. Returns the number of elements that are ignored because
// of unusable numbers or missing points. Throws std::invalid_argument for an array that cannot be
// read.
std::size_t AddElements(vtkPointSet* input, const SkeletonArrays& arrays, Skeleton& skeleton);

}

#endif
