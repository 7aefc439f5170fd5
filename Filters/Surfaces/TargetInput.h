// What comes through the input port: times, particles, and whether something upstream has changed.

#ifndef TargetInput_h
#define TargetInput_h

#include "ParticleFrames.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkAlgorithm;
class vtkInformation;
class vtkPointSet;

namespace activesurface
{

class TargetInput
{
public:
  explicit TargetInput(vtkAlgorithm* filter);

  bool IsConnected() const;

  // Changes whenever an algorithm or data upstream is modified, not when another time is read.
  std::uint64_t GetStamp() const;

  // The time steps that the input offers, if two at least; else none.
  static std::vector<double> GetTimeSteps(vtkInformation* information);
  // Whether the input offers any time in a range, without steps.
  static bool IsContinuous(vtkInformation* information);

  // Which arrays were chosen for radii, ids and strengths; empty where none was.
  std::array<std::string, 3> DescribeArrays() const;

  // True before a request for data only: then the pipeline hands over one block after the other, as
  // if each were the input.
  static bool IsComposite(vtkInformation* information);

  // Throws std::invalid_argument for data that are no particles, and for arrays that are missing or
  // unfit.
  ParticleFrame Read(vtkInformation* information) const;

  // All of it, whatever piece of the skin is asked for.
  static void AskForWhole(vtkInformation* information);

  // Brings the input up to date at a time; false if it fails.
  bool Update(vtkInformation* information, double time) const;

private:
  bool IsArrayChosen(int index) const;
  vtkAbstractArray* FindArray(int index, vtkPointSet* points) const;

  vtkAlgorithm* Filter;
};

}

#endif
