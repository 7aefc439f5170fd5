// What the input is at one of its time steps, and so as which kind of target it acts.

#ifndef TargetFrame_h
#define TargetFrame_h

#include "Targets/ParticleFrame.h"

#include "vtkDataSet.h"
#include "vtkImplicitFunction.h"
#include "vtkSmartPointer.h"

#include <string>

namespace activesurface
{

// What Data's point arrays are called.
constexpr const char* RadiusName = "Radius";
constexpr const char* StrengthName = "Strength";

enum class TargetKind
{
  Nothing, // no points: there is no target at that step
  Particles,
  Skeleton,
  Mesh,
  Image
};

// As it is called in messages.
const char* GetName(TargetKind kind);

struct TargetFrame
{
  TargetKind Kind = TargetKind::Nothing;
  bool HasCells = true;                          // else points alone
  ParticleFrame Particles;                       // or the points of a skeleton
  std::string Extras;                            // which arrays besides were read of particles
  vtkSmartPointer<vtkDataSet> Data;              // of the other kinds: what of the input is needed
  vtkSmartPointer<vtkImplicitFunction> Function; // of the other kinds, once it is made

  bool IsEmpty() const; // without points that can be used
};

// Throws std::invalid_argument for data that cannot be a target.
TargetKind FindKind(vtkDataSet* data);

// The frames of each kind. They throw std::invalid_argument for arrays that are unfit; arrays may
// be null, an image's where it carries a level set.
TargetFrame MakeParticles(vtkPointSet* points, const ParticleArrays& arrays);
TargetFrame MakeSkeleton(vtkPointSet* lines, vtkAbstractArray* radii, vtkAbstractArray* strengths);
TargetFrame MakeMesh(vtkDataSet* mesh);
TargetFrame MakeImage(vtkDataSet* image, vtkAbstractArray* values);

}

#endif
