// The elements of a skeleton, taken from a VTK data set: see vtkSkeletonPotential.h for which they
// are, and how the joints of its lines are treated.

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

// Adds the elements to a cleared skeleton and returns the number of those that are ignored because
// a number of theirs is of no use. Throws std::invalid_argument for an array that cannot be read.
std::size_t AddElements(vtkPointSet* input, const SkeletonArrays& arrays, Skeleton& skeleton);

}

#endif
